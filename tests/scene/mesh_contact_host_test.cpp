// Contact of a sphere with a baked mesh, checked against closed forms.
#include "firmtouch/scene/mesh_contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "bake/field/bake_field.hpp"
#include "bake/mesh/bake_mesh.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "harness/test.hpp"
#include "surface/surface.hpp"

using namespace firmtouch;  // NOLINT: a test file
namespace {

constexpr float kHalf = 0.05f;  // of the cube's side, m

// A cube about the origin, each face a grid of `n` x `n` squares, outward.
tools::Surface divided_cube(uint32_t n) {
  tools::Surface surface;
  const auto vertex = [&](int x, int y, int z) {  // corners of the grid are shared by search
    const float step = 2 * kHalf / static_cast<float>(n);
    const auto at = [&](int k) {
      return k == static_cast<int>(n) ? kHalf : -kHalf + step * static_cast<float>(k);
    };
    const math::Vec3 p{at(x), at(y), at(z)};
    for (uint32_t i = 0; i < surface.vertices.size(); ++i) {
      const math::Vec3 q = surface.vertices[i];
      if (!(std::fabs(p.x - q.x) + std::fabs(p.y - q.y) + std::fabs(p.z - q.z) > 1e-6f)) return i;
    }
    surface.vertices.push_back(p);
    return static_cast<uint32_t>(surface.vertices.size() - 1);
  };
  const int last = static_cast<int>(n);
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      for (int i = 0; i < last; ++i) {
        for (int j = 0; j < last; ++j) {
          const auto corner = [&](int a, int b) {
            int k[3];
            k[axis] = side * last;
            k[(axis + 1) % 3] = a;
            k[(axis + 2) % 3] = b;
            return vertex(k[0], k[1], k[2]);
          };
          const uint32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                         d = corner(i, j + 1);
          if (side == 1) {
            surface.faces.push_back({a, b, c});
            surface.faces.push_back({a, c, d});
          } else {
            surface.faces.push_back({a, c, b});
            surface.faces.push_back({a, d, c});
          }
        }
      }
    }
  }
  for (uint32_t i = 0; i < surface.faces.size(); ++i) surface.source.push_back(i);
  return surface;
}

struct MeshRig {
  std::vector<tools::Section> sections;
  mesh::View view;
  scene::MeshObject object;
  explicit MeshRig(uint32_t n = 4, bool is_signed = true) {
    tools::MeshOptions options;
    options.is_signed = is_signed;
    tools::MeshReport report;
    sections = tools::bake_mesh(divided_cube(n), "cube", options, report);
    CHECK(report.problem.empty());
    CHECK(tools::open_baked(sections, "cube", view).ok());
    object.mesh = &view;
    object.material = {1000.0f, 0.0f};
  }
};

// The same with a distance field of the cube.
struct FieldRig : MeshRig {
  std::vector<tools::Section> distance_field_sections;
  field::View distance_field;
  explicit FieldRig(uint32_t n, bool is_signed = true) : MeshRig(n, is_signed) {
    tools::FieldReport report;
    distance_field_sections = tools::bake_field(view, "cube", 24, report);
    CHECK(report.problem.empty());
    CHECK(field::open(tools::sections_of<field::Sections>(distance_field_sections, "cube"), view,
                      distance_field)
              .ok());
    object.distance_field = &distance_field;
  }
};

struct Tool {
  scene::MeshTouch touch;
  servo::LocalModel model;
  math::Vec3 force_N(const scene::MeshObject& object, math::Vec3 p_m,
                     query::Budget budget = query::kUnlimited) {
    scene::begin_model(model, p_m, 0, 3);
    scene::touch_mesh<true, false>(object, 0.003f, p_m, budget, touch, model);
    return servo::evaluate(model, p_m, {});
  }
};

double far_from(math::Vec3 a, math::Vec3 b) {
  return std::hypot(static_cast<double>(a.x) - static_cast<double>(b.x),
                    static_cast<double>(a.y) - static_cast<double>(b.y),
                    static_cast<double>(a.z) - static_cast<double>(b.z));
}

}  // namespace

TEST(SphereOnAFaceIsPushedAlongItsNormal) {
  const MeshRig rig;
  Tool tool;
  CHECK_LE(far_from(tool.force_N(rig.object, {0.01f, 0.02f, kHalf + 0.002f}), {0, 0, 1}), 1e-4);
  CHECK_LE(far_from(tool.force_N(rig.object, {0.01f, -kHalf - 0.001f, 0.01f}), {0, -2, 0}), 1e-4);
  CHECK_LE(std::fabs(tool.touch.penetration_m - 0.002f), 1e-7f);
  CHECK_LE(far_from(tool.force_N(rig.object, {0.01f, 0.02f, kHalf + 0.004f}), {0, 0, 0}), 0.0);
  CHECK_LE(far_from(tool.force_N(rig.object, {0.01f, 0.02f, kHalf - 0.002f}), {0, 0, 5}), 1e-4);
}

TEST(SphereOnAnEdgeOrCornerIsPushedAwayFromIt) {
  const MeshRig rig;
  Tool tool;
  const float off = 0.001f;
  const double side = static_cast<double>(0.003f - off * std::sqrt(2.0f)) * 1000 / std::sqrt(2.0);
  const float edge = static_cast<float>(side);
  CHECK_LE(far_from(tool.force_N(rig.object, {kHalf + off, kHalf + off, 0.01f}), {edge, edge, 0}),
           2e-4);
  const float corner = static_cast<float>(static_cast<double>(0.003f - off * std::sqrt(3.0f)) *
                                          1000 / std::sqrt(3.0));
  CHECK_LE(far_from(tool.force_N(rig.object, {kHalf + off, -kHalf - off, kHalf + off}),
                    {corner, -corner, corner}),
           2e-4);
}

TEST(ForceHasNoJumpAlongAScanOverAnEdge) {
  const MeshRig rig;
  Tool tool;
  math::Vec3 before = tool.force_N(rig.object, {kHalf - 0.01f, 0.011f, kHalf + 0.002f});
  double worst = 0;
  for (int i = 1; i <= 2000;
       ++i) {  // along the top, around the edge at the same distance, down the side
    const float t = static_cast<float>(i) * 1e-5f;
    const float angle = (t - 0.01f) / 0.002f;
    math::Vec3 p_m{kHalf - 0.01f + t, 0.011f, kHalf + 0.002f};
    if (t > 0.01f)
      p_m = {kHalf + 0.002f * std::sin(angle), 0.011f, kHalf + 0.002f * std::cos(angle)};
    if (angle > 1.5707963f) p_m = {kHalf + 0.002f, 0.011f, kHalf - (t - 0.01f - 0.0031416f)};
    const math::Vec3 now = tool.force_N(rig.object, p_m);
    worst = std::fmax(worst, far_from(now, before));
    before = now;
  }
  CHECK_LE(worst, 0.006);  // 1 N turned by 10 um / 2 mm
}

TEST(ForceIsContinuousThroughTheSurface) {
  const MeshRig rig;
  Tool tool;
  math::Vec3 before = tool.force_N(rig.object, {0.0131f, 0.0077f, kHalf + 1e-3f});
  double worst = 0;
  for (int i = 1; i <= 4000; ++i) {
    const math::Vec3 now =
        tool.force_N(rig.object, {0.0131f, 0.0077f, kHalf + 1e-3f - 5e-7f * static_cast<float>(i)});
    CHECK_EQ(tool.model.plane_count, 1u);
    worst = std::fmax(worst, far_from(now, before));
    before = now;
  }
  CHECK_LE(worst, 0.002);
}

TEST(Pose_MovesAndTurnsTheContact) {
  MeshRig rig;
  rig.object.pose.translation_m = {1.0f, 2.0f, -0.5f};
  rig.object.pose.rotation.row[0] = {0, -1, 0};  // a quarter turn about z
  rig.object.pose.rotation.row[1] = {1, 0, 0};
  Tool tool;
  CHECK_LE(far_from(tool.force_N(rig.object, {1.0f + kHalf + 0.001f, 2.01f, -0.49f}), {2, 0, 0}),
           1e-3);
}

TEST(UnsignedMeshIsNeverPushedOn) {
  const MeshRig rig(4, false);
  Tool tool;
  for (int i = -40; i <= 40; ++i) {
    const float z = kHalf + 0.0002f * static_cast<float>(i);
    CHECK_LE(far_from(tool.force_N(rig.object, {0.01f, 0.02f, z}), {0, 0, 0}), 0.0);
    CHECK_EQ(tool.touch.closest.certificate.sign, 0);
    CHECK_EQ(tool.model.plane_count, 0u);
  }
}

TEST(ShortBudgetNeverPushesMoreThanTheTruth) {
  const MeshRig rig(12);
  for (uint32_t steps = 1; steps <= 64; steps *= 2) {
    Tool tool;
    for (int i = 0; i < 3000; ++i) {
      const float t = static_cast<float>(i) * 1e-4f;
      const math::Vec3 p_m{0.049f * std::sin(7 * t), 0.049f * std::cos(5 * t),
                           kHalf + 0.01f * std::sin(11 * t)};
      const math::Vec3 force_N = tool.force_N(rig.object, p_m, {steps});
      const double depth_m = 0.003 - (static_cast<double>(p_m.z) - static_cast<double>(kHalf));
      const double size = std::hypot(static_cast<double>(force_N.x), static_cast<double>(force_N.y),
                                     static_cast<double>(force_N.z));
      firmtouch::test::note("steps", steps);
      CHECK_LE(size, (depth_m > 0 ? depth_m * 1000 : 0) + 1e-3);
    }
  }
}

TEST(ShortBudgetInside_RendersTheDepthThatItsCertificateProves) {
  const MeshRig rig(12);
  uint32_t inexact = 0;
  for (uint32_t steps = 1; steps <= 4; ++steps) {
    Tool tool;
    (void)tool.force_N(rig.object,
                       {0.011f, 0.007f, kHalf - 0.02f});  // exact: the side is certain from here on
    for (int i = 0; i < 100; ++i) {
      const math::Vec3 p_m{0.011f - 0.0001f * static_cast<float>(i), 0.007f, kHalf - 0.02f};
      const math::Vec3 force_N = tool.force_N(rig.object, p_m, {steps});
      const query::Certificate& certificate = tool.touch.closest.certificate;
      const double size_N = far_from(force_N, {0, 0, 0});
      CHECK_LE(size_N, 23.0 + 1e-3);  // 20 mm deep, and the radius
      if (certificate.sign == 0) CHECK_EQ(size_N, 0.0);
      if (!(certificate.sign < 0) || certificate.exact) continue;
      ++inexact;
      CHECK_LE(std::fabs(size_N - (static_cast<double>(certificate.lower_m) + 0.003) * 1000), 1e-3);
    }
  }
  CHECK_GE(inexact, 50u);
}

// A tool comes from afar, touches, presses in and leaves: as the depth says on every tick, though
// what lies beyond reach is not looked for.
TEST(InFreeSpaceOnlyWhatMayBeTouchedIsLookedFor) {
  const MeshRig rig(12);
  const float reach_m = 0.003f + 0.02f * rig.view.head().diagonal_m;
  Tool tool;
  uint32_t near_steps = 0, free_ticks = 0;
  for (int i = 0; i <= 4000; ++i) {
    const float height_m = 0.03f + 0.035f * std::cos(static_cast<float>(i) * 3.1416e-3f);
    const math::Vec3 p_m{0.011f, 0.007f, kHalf + height_m};
    const math::Vec3 force_N = tool.force_N(rig.object, p_m);
    const query::Certificate& certificate = tool.touch.closest.certificate;
    const double depth_m = std::max(0.0, 0.003 - static_cast<double>(p_m.z - kHalf));
    CHECK_LE(far_from(force_N, {0, 0, static_cast<float>(depth_m * 1000)}), 1e-3);
    CHECK_LE(tool.touch.closest.certificate.lower_m, std::fabs(height_m) + 1e-6f);
    if (i == 0) continue;  // nothing is known yet: everything is looked at
    if (height_m > reach_m * 1.001f) {
      ++free_ticks;
      CHECK_EQ(tool.model.plane_count, 0u);
      CHECK_EQ(certificate.sign, 1);
      CHECK_LE(reach_m * 0.99f, tool.touch.closest.certificate.lower_m);
      CHECK_LE(certificate.steps, 20u);
    } else if (std::fabs(height_m) < reach_m * 0.999f) {
      CHECK(certificate.exact);
      near_steps = std::max(near_steps, certificate.steps);
    }
  }
  CHECK_GT(free_ticks, 2000u);
  CHECK_GT(near_steps, 0u);
}

// With a distance field a tick in free space is one look-up, from the first on, and contact is the
// same.
TEST(Field_OneLookUpATickInFreeSpace_SameContact) {
  const FieldRig rig(12);
  scene::MeshObject plain = rig.object;
  plain.distance_field = nullptr;
  const float cell_m = rig.distance_field.head().cell_m;
  const float reach_m = 0.003f + 0.02f * rig.view.head().diagonal_m;
  Tool tool, without;
  uint32_t free_ticks = 0, contacts = 0;
  for (int i = 0; i <= 4000; ++i) {
    const float height_m = 0.03f + 0.035f * std::cos(static_cast<float>(i) * 3.1416e-3f);
    const math::Vec3 p_m{0.011f + 0.02f * std::sin(static_cast<float>(i) * 0.01f), 0.007f,
                         kHalf + height_m};
    const math::Vec3 force_N = tool.force_N(rig.object, p_m);
    CHECK_LE(far_from(force_N, without.force_N(plain, p_m)), 1e-4);
    contacts += tool.touch.penetration_m > 0 ? 1 : 0;
    const query::Certificate& certificate = tool.touch.closest.certificate;
    if (certificate.steps == 1) {
      ++free_ticks;
      CHECK_EQ(tool.model.plane_count, 0u);
      CHECK_EQ(certificate.sign, 1);
      CHECK_GT(certificate.lower_m, reach_m);
      CHECK_LE(tool.touch.closest.certificate.lower_m, height_m * 1.00001f);
      CHECK_GE(tool.touch.closest.distance_m, height_m * 0.99999f);
    } else {  // the way to a cell's centre is at most 0.87 cells
      CHECK_LE(height_m, reach_m + 1.8f * cell_m);
    }
  }
  CHECK_GT(free_ticks, 2000u);
  CHECK_GT(contacts, 500u);
}

TEST(Field_DoesNotReplaceTheDepthInside) {
  const FieldRig rig(12);
  Tool tool;
  for (int i = 0; i <= 100; ++i) {
    const float depth_m = 0.0004f * static_cast<float>(i);
    const math::Vec3 force_N = tool.force_N(rig.object, {0.001f, 0.002f, kHalf - depth_m});
    CHECK_LE(far_from(force_N, {0, 0, (0.003f + depth_m) * 1000}), 2e-3);
  }
}

TEST(UnsignedField_BoundsFreeSpaceOnly_NoForce) {
  const FieldRig rig(4, false);
  Tool tool;
  (void)tool.force_N(rig.object, {0, 0, 3 * kHalf});
  CHECK_EQ(tool.touch.closest.certificate.steps, 1u);
  CHECK_GT(tool.touch.closest.certificate.lower_m, 1.9f * kHalf);
  CHECK_LE(far_from(tool.force_N(rig.object, {0, 0, kHalf - 0.001f}), {0, 0, 0}), 0.0);
  CHECK_EQ(tool.touch.closest.certificate.sign, 0);
}

TEST(TwoToolsOnOneObject_DoNotInfluenceEachOther) {
  const MeshRig rig;
  Tool a, b, alone;
  for (int i = 0; i < 500; ++i) {
    const float t = static_cast<float>(i) * 1e-3f;
    const math::Vec3 p_m{0.04f * std::sin(t), 0.01f, kHalf + 0.002f * std::cos(9 * t)};
    const math::Vec3 q_m{-kHalf - 0.001f, 0.04f * std::cos(3 * t), 0.02f * std::sin(t)};
    const math::Vec3 together = a.force_N(rig.object, p_m);
    (void)b.force_N(rig.object, q_m);
    CHECK_EQ(far_from(together, alone.force_N(rig.object, p_m)), 0.0);
    CHECK_EQ(a.touch.closest.certificate.steps, alone.touch.closest.certificate.steps);
  }
}

TEST(HostilePlacesLeaveASoundModel) {
  const MeshRig rig;
  Tool tool;
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity(),
                       std::numeric_limits<float>::max(),
                       1e-40f,
                       1e9f};
  for (const float value : bad) {
    for (int axis = 0; axis < 3; ++axis) {
      math::Vec3 p_m{0.01f, 0.01f, kHalf};
      (axis == 0 ? p_m.x : axis == 1 ? p_m.y : p_m.z) = value;
      const math::Vec3 force_N = tool.force_N(rig.object, p_m);
      if (!(std::fabs(value) <= 1e4f)) CHECK_EQ(tool.touch.penetration_m, 0.0f);
      CHECK(std::isfinite(tool.touch.closest.distance_m));
      if (std::isfinite(value)) CHECK(std::isfinite(force_N.x));
      CHECK_GE(tool.touch.closest.certificate.lower_m, 0.0f);
    }
  }
  mesh::View none;
  scene::MeshObject nothing;
  CHECK_EQ(tool.force_N(nothing, {0, 0, 0}).x, 0.0f);
  nothing.mesh = &none;
  CHECK_EQ(tool.force_N(nothing, {0, 0, 0}).x, 0.0f);
}
