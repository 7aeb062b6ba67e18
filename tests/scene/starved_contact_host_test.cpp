// Contact with a sphere whose depth the budget no longer determines: the force is what the
// certificate proves, neither more nor none.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "firmtouch/scene/mesh_contact.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "harness/test.hpp"
#include "mesh/baked_mesh.hpp"
#include "surface/surface.hpp"

using namespace firmtouch;  // NOLINT: a test file
namespace {

constexpr double kSphere_m = 0.05;
constexpr float kTip_m = 0.003f;
constexpr double kStiffness_N_per_m = 1000;
constexpr query::Budget kDefault{256};

// Rings of latitude: 2 * 116 * 87 = 20,184 triangles.
tools::Surface sphere() {
  constexpr uint32_t kAround = 116, kRings = 87;
  const double pi = std::acos(-1.0);
  tools::Surface surface;
  const auto add = [&surface](double polar, double azimuth) {
    surface.vertices.push_back({static_cast<float>(kSphere_m * std::sin(polar) * std::cos(azimuth)),
                                static_cast<float>(kSphere_m * std::sin(polar) * std::sin(azimuth)),
                                static_cast<float>(kSphere_m * std::cos(polar))});
  };
  add(0, 0);
  for (uint32_t ring = 1; ring <= kRings; ++ring)
    for (uint32_t i = 0; i < kAround; ++i) add(pi * ring / (kRings + 1), 2 * pi * i / kAround);
  add(pi, 0);
  const auto at = [](uint32_t ring, uint32_t i) { return 1 + ring * kAround + i % kAround; };
  const uint32_t south = 1 + kRings * kAround;
  for (uint32_t i = 0; i < kAround; ++i) {
    surface.faces.push_back({0, at(0, i), at(0, i + 1)});
    for (uint32_t ring = 0; ring + 1 < kRings; ++ring) {
      surface.faces.push_back({at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)});
      surface.faces.push_back({at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)});
    }
    surface.faces.push_back({at(kRings - 1, i), south, at(kRings - 1, i + 1)});
  }
  for (uint32_t i = 0; i < surface.faces.size(); ++i) surface.source.push_back(i);
  return surface;
}

struct StarvedRig {
  mesh_test::BakedMesh baked{sphere()};
  scene::MeshObject object;
  scene::MeshTouch touch;
  servo::LocalModel model;
  StarvedRig() {
    CHECK_EQ(baked.surface.faces.size(), 20184u);
    object.mesh = &baked.view;
    object.material = {static_cast<float>(kStiffness_N_per_m), 0.0f};
  }
  math::Vec3 force_N(math::Vec3 p_m, query::Budget budget) {
    scene::begin_model(model, p_m, 0, 3);
    scene::touch_mesh(object, kTip_m, p_m, budget, touch, model);
    return servo::evaluate(model, p_m, {});
  }
};

double size_of(math::Vec3 a) {
  const double x = static_cast<double>(a.x), y = static_cast<double>(a.y),
               z = static_cast<double>(a.z);
  return std::sqrt(x * x + y * y + z * z);
}

}  // namespace

// Pressed in from outside to the middle, 0.3 mm a tick, and held there.
TEST(ShortBudgetInside_RendersAllTheDepthThatIsCertified) {
  uint32_t starved = 0, deep = 0;
  for (const query::Budget budget : {kDefault, query::Budget{16}, query::Budget{2}}) {
    StarvedRig rig;
    for (int tick = 0; tick < 300; ++tick) {
      const double height_m = std::max(0.055 - 0.0003 * tick, 0.001);
      const math::Vec3 p_m{static_cast<float>(0.8 * height_m), 0,
                           static_cast<float>(0.6 * height_m)};
      const double size_N = size_of(rig.force_N(p_m, budget));
      const query::Certificate& certificate = rig.touch.closest.certificate;
      const double lower_m = static_cast<double>(certificate.lower_m);
      firmtouch::test::note("tick", tick);
      if (certificate.sign == 0) CHECK_EQ(size_N, 0.0);
      if (budget.work == kDefault.work && height_m < 0.0498) CHECK_EQ(certificate.sign, -1);
      if (certificate.sign >= 0) continue;
      // The triangles cut up to 0.05 mm off the sphere.
      CHECK_LE(size_N,
               (kSphere_m - height_m + static_cast<double>(kTip_m)) * kStiffness_N_per_m + 1e-3);
      CHECK_GE(size_N, (lower_m + static_cast<double>(kTip_m)) * kStiffness_N_per_m - 1e-3);
      CHECK_GT(rig.touch.penetration_m, 0.0f);
      if (certificate.exact) continue;
      ++starved;
      if (lower_m > 0.01) ++deep;
    }
  }
  CHECK_GE(starved, 80u);
  CHECK_GE(deep, 80u);
}

// The opposite fault: a depth that nothing proves, or a side that nobody knows.
TEST(ShortBudgetInside_AfterAJumpNoSideIsKnownAndNoForceIsMade) {
  for (uint32_t steps = 1; steps <= 64; steps *= 2) {
    StarvedRig rig;
    (void)rig.force_N({0.02f, 0.01f, 0.03f}, query::kUnlimited);
    CHECK_EQ(rig.touch.closest.certificate.sign, -1);
    const math::Vec3 force_N = rig.force_N({-0.001f, 0.0005f, -0.0007f}, {steps});
    CHECK_EQ(rig.touch.closest.certificate.sign, 0);
    CHECK_EQ(size_of(force_N), 0.0);
    CHECK_EQ(rig.model.plane_count, 0u);
  }
}
