// Contact by the shell where the mesh's query has no time: against the exact query, and against
// every face of the shell in double.
#include <cmath>
#include <vector>

#include "bake/mesh/bake_mesh.hpp"
#include "firmtouch/hull/vertices.hpp"
#include "firmtouch/hull/view.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/mesh_contact.hpp"
#include "firmtouch/scene/mesh_touched.hpp"
#include "firmtouch/scene/proxy.hpp"
#include "harness/test.hpp"
#include "hull/add_hull.hpp"
#include "mesh/brute_force.hpp"
#include "surface/make/make_part.hpp"

using namespace firmtouch;  // NOLINT: a test file
namespace {

constexpr float kRadius_m = 0.002f;

struct HullRig {
  tools::Surface surface = tools::make_part(1, 3000), of_base_hull;
  std::vector<tools::Section> sections;
  mesh::View view;
  hull::View hull_view;
  scene::MeshObject object;
  explicit HullRig(uint32_t faces = 400) {
    tools::MeshReport report;
    sections = tools::bake_mesh(surface, "part", {}, report);
    CHECK(report.problem.empty());
    hull_test::add_hull(sections, faces);
    CHECK(tools::open_baked(sections, "part", view).ok());
    CHECK(tools::open_baked(sections, "part", hull_view).ok());
    const hull::BaseHull& base_hull = hull_view.base_hull();
    for (uint32_t i = 0; i < base_hull.face_count(); ++i) {
      for (uint32_t k = 0; k < 3; ++k)
        of_base_hull.vertices.push_back(hull::vertex(base_hull, base_hull.vertex_of(i, k)));
      of_base_hull.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    object.mesh = &view;
    object.base_hull = &base_hull;
    object.material = {1000.0f, 0.0f};
  }
};

const HullRig& hull_rig() {
  static const HullRig made;
  return made;
}

// Along the surface, into it and off it again.
std::vector<math::Vec3> way(int count) {
  std::vector<math::Vec3> points;
  const mesh::View& view = hull_rig().view;
  for (int i = 0; i < count; ++i) {
    const uint32_t at = static_cast<uint32_t>(i / 40) * 211u % view.vertices().size();
    const math::Vec3 v = view.vertex(at);
    const float lift = 0.006f * std::sin(0.11f * static_cast<float>(i));
    points.push_back({v.x + 0.2f * lift, v.y - 0.1f * lift, v.z + lift});
  }
  return points;
}

// A floor. With little work only a point of a base hull is known.
struct FloorUnderAHull {
  math::Vec3 hull_m;
  static float size_m() { return 1; }
  scene::Near near(math::Vec3 x_m, query::Budget budget, float) const {
    scene::Near near;
    near.work = near.steps = 1;
    near.sign = 1;
    near.has_inside = true;
    near.is_of_base_hull = near.feature.is_of_base_hull = budget.work <= 20;
    near.is_exact = !near.is_of_base_hull;
    near.distance_m = near.lower_m = near.is_exact ? x_m.z : math::length(x_m - hull_m);
    near.feature.kind =
        near.is_exact ? scene::Feature::Kind::kHalfSpace : scene::Feature::Kind::kBall;
    if (near.is_exact)
      near.feature.corner[1] = {0, 0, 1};
    else
      near.feature.corner[0] = hull_m;
    return near;
  }
};

}  // namespace

TEST(BudgetExhausted_BaseHullContactIsEarlyNeverLate) {
  uint32_t of_base_hull = 0, touched = 0, early = 0, max_steps = 0;
  for (const uint32_t steps : {1u, 2u, 4u, 8u, 16u, 64u}) {
    scene::MeshTouch touch;
    int i = 0;
    for (const math::Vec3 p_m : way(1200)) {
      firmtouch::test::note("point", ++i);
      mesh::Hint none;
      const mesh::Closest truth =
          mesh::closest_point(hull_rig().view, p_m, query::kUnlimited, none);
      servo::LocalModel model;
      scene::begin_model(model, p_m, 0, 3);
      scene::touch_mesh<false, true>(hull_rig().object, kRadius_m, p_m, {steps}, touch, model);
      const float depth_m = kRadius_m - truth.distance_m;
      if (depth_m > 1e-6f) CHECK_LE(depth_m - 2e-6f, touch.penetration_m);
      touched += depth_m > 0 ? 1u : 0u;
      if (touch.base_hull_steps > max_steps) max_steps = touch.base_hull_steps;
      if (!touch.is_of_base_hull) {
        CHECK_LE(touch.penetration_m, (depth_m > 0 ? depth_m : 0.0f) + 2e-6f);
        continue;
      }
      ++of_base_hull;
      early += touch.penetration_m > 0 && depth_m <= 0 ? 1u : 0u;
      const mesh_test::Truth to_base_hull =
          mesh_test::brute_force(hull_rig().of_base_hull, mesh_test::wide(p_m));
      const double off_m = to_base_hull.inside ? -to_base_hull.distance : to_base_hull.distance;
      CHECK_LE(double{touch.penetration_m}, std::max(0.0, double{kRadius_m} - off_m) + 2e-6);
      if (model.plane_count == 0) continue;
      const math::Vec3 n = model.plane[0].normal;
      CHECK_LE(std::fabs(n.x * n.x + n.y * n.y + n.z * n.z - 1.0f), 1e-4f);
    }
  }
  CHECK_LT(2000u, of_base_hull);
  CHECK_LT(1000u, touched);
  CHECK_LT(10u, early);
  CHECK_LT(max_steps, 512u);
}

TEST(WithTimeForTheMeshABaseHullChangesNothing) {
  scene::MeshObject alone = hull_rig().object;
  alone.base_hull = nullptr;
  scene::MeshTouch with_it, without;
  int i = 0;
  for (const math::Vec3 p_m : way(800)) {
    if (i++ % 40 == 0) with_it = without = {};  // a hand does not jump
    servo::LocalModel a, b;
    scene::begin_model(a, p_m, 0, 3);
    scene::begin_model(b, p_m, 0, 3);
    scene::touch_mesh<false, true>(hull_rig().object, kRadius_m, p_m, query::kUnlimited, with_it,
                                   a);
    scene::touch_mesh<false, true>(alone, kRadius_m, p_m, query::kUnlimited, without, b);
    CHECK(!with_it.is_of_base_hull);
    CHECK_EQ(with_it.penetration_m, without.penetration_m);
    CHECK_EQ(a.plane_count, b.plane_count);
  }
}

// With 20 work units a tick: a tool that neither follows its hand nor says so would be stuck.
TEST(LeavingHand_WithBaseHullAndLittleWork_IsLetGoOrUncertain) {
  static const HullRig coarse(100);
  const mesh::View& view = coarse.view;
  uint32_t let_go = 0, uncertain = 0;
  for (uint32_t i = 0; i < 600; ++i) {
    firmtouch::test::note("vertex", static_cast<int>(i));
    const math::Vec3 v_m = view.vertex(i * 211u % view.vertices().size());
    mesh::Hint hint;
    scene::HulledMeshTouched shape{coarse.object, hint};
    scene::Proxy proxy;
    scene::ProxySettings settings;
    settings.radius_m = 0.003f;
    const math::Vec3 off_m{0.0012f, -0.0006f, i % 2 == 0 ? 0.006f : -0.006f};
    math::Vec3 hand_m;
    for (int k = 10; k >= -2; --k) {
      hand_m = v_m + off_m * (0.1f * static_cast<float>(k));
      (void)scene::move_proxy(settings, hand_m, shape, proxy);
    }
    if (proxy.phase != scene::Proxy::Phase::kFree || !proxy.is_loaded) continue;
    settings.budget.work = 20;
    const math::Vec3 out_m = proxy.position_m - hand_m;
    uint32_t ticks = 0, in_a_row = 0;
    bool is_settled = false;
    while (proxy.is_loaded && in_a_row < 10 && !is_settled && ticks < 30) {
      const float away = 0.1f * static_cast<float>(++ticks < 15 ? ticks : 15u);
      const scene::ProxyMoved moved =
          scene::move_proxy(settings, hand_m + out_m * away, shape, proxy);
      in_a_row = moved.is_starved ? in_a_row + 1 : 0;
      is_settled = moved.is_optimal && ticks >= 15;  // it touches elsewhere
    }
    CHECK_LT(ticks, 30u);
    (in_a_row < 10 ? let_go : uncertain) += 1;
  }
  CHECK_LT(200u, let_go);
  CHECK_LT(0u, uncertain);
}

// The hull's point is a little nearer to the tool than the radius, and a little ahead of it.
TEST(BaseHull_NearerThanTheRadius_LeavingHandIsNotHeldWithoutAFault) {
  scene::ProxySettings settings;
  settings.radius_m = 0.05f;
  FloorUnderAHull floor{{0.049f, 0, 0.053f}};
  scene::Proxy proxy;
  for (const float z_m : {0.2f, 0.03f, 0.03f})
    (void)scene::move_proxy(settings, {0, 0, z_m}, floor, proxy);
  CHECK_LE(std::fabs(proxy.position_m.z - 0.05f), 1e-5f);
  settings.budget.work = 20;
  uint32_t starved = 0;
  for (int tick = 0; tick < 20; ++tick)
    starved += scene::move_proxy(settings, {0, 0, 0.03f}, floor, proxy).is_starved ? 1u : 0u;
  CHECK_EQ(starved, 0u);
  for (int tick = 0; tick < 20; ++tick)
    starved += scene::move_proxy(settings, {0, 0, 0.055f}, floor, proxy).is_starved ? 1u : 0u;
  CHECK(proxy.is_loaded);
  CHECK_EQ(starved, 20u);
}
