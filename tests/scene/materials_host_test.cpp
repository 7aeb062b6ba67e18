// Contact with triangles of several materials, against closed forms.
#include "scene/materials_rig.hpp"

#include "firmtouch/math/vec3_ops.hpp"

using namespace firmtouch;              // NOLINT: a test file
using namespace firmtouch::scene_test;  // NOLINT

namespace {

constexpr float kTop_m = 0.003f;  // of the tool's centre above a plate
constexpr double kTool_N_per_m = 1000;

uint8_t left_or_right(Vec3 at_m) { return at_m.x < 0 ? 1 : 2; }

double series(double a, double b) { return a * b / (a + b); }
double wide(float a) { return static_cast<double>(a); }

MaterialsRig plates(const scene::MaterialLayout& left, const scene::MaterialLayout& right) {
  return MaterialsRig(two_plates(), {left, right}, left_or_right);
}

}  // namespace

TEST(Materials_StiffnessIsInSeriesWithTheTools) {
  for (const double own : {100.0, 500.0, 2000.0, 1e9}) {
    MaterialsRig rig = plates(material("m", static_cast<float>(own)), material("other", 1));
    const Vec3 force_N = rig.go({-0.02f, 0.001f, 0.01f}, {-0.02f, 0.001f, kTop_m - 0.002f}, 100);
    const double wanted_N = series(kTool_N_per_m, own) * 0.002;
    CHECK_LE(std::fabs(wide(force_N.z) - wanted_N), 0.002 * wanted_N);
    CHECK_EQ(rig.state.material, 1u);
  }
}

// Over a joint of coplanar triangles of one material the force stays.
TEST(Materials_CoplanarTrianglesOfOneMaterial_ShareIt) {
  MaterialsRig rig = plates(material("m", 800), material("same", 800));
  rig.go({-0.01f, 0, 0.01f}, {-0.01f, 0.002f, kTop_m - 0.002f}, 100);
  const double wanted_N = series(kTool_N_per_m, 800) * 0.002;
  for (int i = 0; i < 400; ++i) {
    const float x = -0.01f + 5e-5f * static_cast<float>(i);
    const Vec3 force_N = rig.tick({x, 0.002f, kTop_m - 0.002f});
    CHECK_LE(std::fabs(wide(force_N.z) - wanted_N), 0.002 * wanted_N);
    CHECK_LE(std::fabs(wide(force_N.x)), 1e-5);
  }
  CHECK_EQ(rig.state.material, 2u);
}

TEST(Materials_FrictionOfEach_IsTheRatioOfTheForces) {
  for (const float x : {-0.02f, 0.01f}) {
    MaterialsRig rig =
        plates(material("rough", 1000, 0.6f, 0.4f), material("slick", 1000, 0.1f, 0.05f));
    rig.go({x, 0, 0.01f}, {x, 0, kTop_m - 0.002f}, 100);
    const Vec3 force_N =
        rig.go({x, 0, kTop_m - 0.002f}, {x, 0.02f, kTop_m - 0.002f}, 200);  // 100 mm/s
    const double ratio = -wide(force_N.y) / wide(force_N.z);
    CHECK_LE(std::fabs(ratio - (x < 0 ? 0.4 : 0.05)), 0.002);
  }
}

TEST(Materials_ViscousFriction_IsThatOfTheMaterial) {
  MaterialsRig rig = plates(material("oil", 1000, 0, 0, 5), material("dry", 1000));
  for (const float x : {-0.02f, 0.02f}) {
    rig.go({x, -0.02f, 0.01f}, {x, -0.02f, kTop_m - 0.002f}, 100);
    const Vec3 force_N =
        rig.go({x, -0.02f, kTop_m - 0.002f}, {x, 0.02f, kTop_m - 0.002f}, 400);  // 100 mm/s
    CHECK_LE(std::fabs(wide(force_N.y) + (x < 0 ? 0.5 : 0)), 0.01);
    rig.go({x, 0.02f, kTop_m - 0.002f}, {x, 0.02f, 0.01f}, 100);
  }
}

// Slides over the border under load, either way, and back: no step beyond 20 N/s.
TEST(Materials_BorderUnderLoad_MakesNoStepOfTheForce) {
  MaterialsRig rig = plates(material("hard", 4000), material("soft", 250));
  for (const float from : {-0.02f, 0.02f}) {
    const float deep = kTop_m - 0.002f;
    Vec3 before_N = rig.go({from, 0, 0.01f}, {from, 0.001f, deep}, 100);
    CHECK_GE(before_N.z, 0.3f);
    double worst_N = 0;
    for (int i = 1; i <= 800; ++i) {
      const Vec3 force_N = rig.tick({from - from * static_cast<float>(i) / 400.0f, 0.001f, deep});
      worst_N = std::max(worst_N, wide(math::length(force_N - before_N)));
      before_N = force_N;
    }
    CHECK_LE(worst_N, 0.0201);
    CHECK_LE(worst_N > 0.019 ? 0.0 : 1.0, from < 0 ? 0.0 : 1.0);  // onto the soft one it falls
    rig.go({-from, 0.001f, deep}, {-from, 0, 0.01f}, 100);
    const Vec3 again_N = rig.go({-from, 0, 0.01f}, {-from, 0.001f, deep}, 100);
    const double wanted_N = series(kTool_N_per_m, from < 0 ? 250 : 4000) * 0.002;
    CHECK_LE(std::fabs(wide(again_N.z) - wanted_N), 0.002 * wanted_N);
    rig.go({-from, 0.001f, deep}, {-from, 0, 0.01f}, 100);
  }
}

TEST(Materials_BorderOfFrictionUnderLoad_MakesNoStepOfTheForce) {
  MaterialsRig rig = plates(material("rough", 1e9f, 1, 1), material("ice", 1e9f));
  const float deep = kTop_m - 0.002f;
  Vec3 before_N = rig.go({-0.01f, 0, 0.01f}, {-0.01f, 0, deep}, 100);
  for (int i = 1; i <= 400; ++i) {
    const Vec3 force_N = rig.tick({-0.01f + 5e-5f * static_cast<float>(i), 0, deep});
    // The stick of the first millimetres follows the hand: 1000 N/m times 50 um.
    CHECK_LE(wide(math::length(force_N - before_N)), 0.0505);
    if (i > 200) CHECK_LE(wide(math::length(force_N - before_N)), 0.0205);
    before_N = force_N;
  }
  CHECK_LE(std::fabs(wide(before_N.x)), 0.02);
}

TEST(Materials_BehindABorderUnderLoad_FrictionIsThatOfTheMaterial) {
  MaterialsRig rig =
      plates(material("slick", 1000, 0.1f, 0.05f), material("rough", 1000, 0.6f, 0.4f));
  const float deep = kTop_m - 0.002f;
  rig.go({-0.01f, 0, 0.01f}, {-0.01f, 0, deep}, 100);
  for (const float to : {0.01f, -0.01f}) {
    rig.go({-to, 0, deep}, {to, 0, deep}, 400);
    CHECK_EQ(rig.state.response.friction_static, to > 0 ? 0.6f : 0.1f);
    CHECK_EQ(rig.state.response.friction_dynamic, to > 0 ? 0.4f : 0.05f);
  }
}

// Where the base hull alone holds the tool, the response stays as it was.
TEST(Materials_HeldByTheBaseHull_StayAsTheyWere) {
  MaterialsRig rig = plates(material("rough", 1000, 0.6f, 0.4f), material("slick", 1000));
  const Vec3 deep_m{-0.01f, 0, kTop_m - 0.002f};
  const Vec3 before_N = rig.go({-0.01f, 0, 0.01f}, deep_m, 100);
  for (scene::Feature& feature : rig.touch.proxy.feature) feature.is_of_base_hull = true;
  rig.contact.settings.budget.work = 1;
  const Vec3 force_N = rig.tick(deep_m);
  CHECK_LE(std::fabs(wide(force_N.z) - wide(before_N.z)), 1e-6);
  CHECK_EQ(rig.state.response.friction_static, 0.6f);
}

// A corner of two materials: each bears its own, and their mean where both hold the tool. The hand
// comes in the direction of the load, so that the shares stay.
TEST(Materials_Corner_HasTheMeanByShareOfLoad) {
  MaterialsRig rig(two_walls(), {material("floor", 500), material("wall", 2000)}, [](Vec3 at_m) {
    return at_m.x > -1e-4f && at_m.z > 1e-4f ? uint8_t{2} : uint8_t{1};
  });
  const Vec3 corner_m{-0.003f, 0.001f, 0.003f};
  for (const Vec3 deep_m : {Vec3{0, 0, -0.002f}, Vec3{0.002f, 0, 0}, Vec3{0.001f, 0, -0.003f}}) {
    rig.touch = {}, rig.state = {};
    const Vec3 force_N = rig.go(corner_m - deep_m * 3.0f, corner_m + deep_m, 2000);
    const double x = wide(deep_m.x), z = -wide(deep_m.z);
    const double compliance = 1 / kTool_N_per_m + (z / 500 + x / 2000) / (x + z);
    CHECK_LE(std::fabs(wide(force_N.z) - z / compliance), 0.02);
    CHECK_LE(std::fabs(wide(force_N.x) + x / compliance), 0.02);
    CHECK_EQ(rig.state.material, x > z ? 2u : 1u);
  }
}

TEST(Materials_None_AreTheBitsOfAPlainContact) {
  MaterialsRig rig = plates(material("a", 100), material("b", 200));
  const scene::StoredMaterials none;
  rig.object.materials = &none;
  rig.materials = none;
  mesh::Hint hint;
  scene::ProxyTouch touch;
  servo::LocalModel model;
  for (int i = 0; i < 500; ++i) {
    rig.tick({-0.01f + 4e-5f * static_cast<float>(i), 0, 0.008f - 2e-5f * static_cast<float>(i)});
    scene::ProxyContact contact = rig.contact;
    contact.proxy_m = touch.proxy.position_m;
    model = {};
    const scene::MeshObject& plain = rig.object;
    scene::MeshTouched shape{plain, hint};
    scene::touch_by_proxy(contact, shape, touch, model);
    CHECK_EQ(model.spring.stiffness_N_per_m, rig.model.spring.stiffness_N_per_m);
    CHECK_EQ(model.spring.anchor_m.z, rig.model.spring.anchor_m.z);
    CHECK_EQ(model.spring.anchor_m.x, rig.model.spring.anchor_m.x);
  }
  CHECK(model.spring.is_held);
}

// A working set of any bits reads no table beyond its end, and the model stays sound.
TEST(Materials_AnyBitsInTheWorkingSet_MakeASoundModel) {
  MaterialsRig rig = plates(material("a", 100, 1), material("b", 2000));
  for (uint32_t i = 0; i < 2000; ++i) {
    for (uint32_t k = 0; k < scene::kMaxFeatures; ++k)
      rig.touch.proxy.feature[k].material = static_cast<uint8_t>(i * 7 + k * 31);
    const float z = kTop_m + 0.002f * static_cast<float>(static_cast<int>(i % 5) - 3);
    const Vec3 force_N = rig.tick({-0.02f + 2e-5f * static_cast<float>(i), 0, z});
    CHECK(math::is_finite(force_N));
    CHECK_GE(force_N.z, -1e-6f);
    CHECK_LE(rig.model.spring.stiffness_N_per_m, 1000.001f);
  }
}
