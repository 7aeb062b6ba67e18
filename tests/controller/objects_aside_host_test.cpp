// Objects that are some sizes of their scene away from the middle of the device, by the scene's
// place: as on a linkage, whose tip is far from its base.
#include <cmath>

#include "controller/placed.hpp"
#include "firmtouch/controller/objects_controller.hpp"
#include "firmtouch/scene/objects_layout.hpp"

namespace firmtouch::controller_test {
namespace {

constexpr float kRadius_m = 0.003f;

scene::ObjectLayout box_at(const char* name, float x_m, float z_m) {
  scene::ObjectLayout layout = {};
  std::strcpy(layout.name, name);
  std::strcpy(layout.mesh, "box");
  layout.rotation[0] = layout.rotation[4] = layout.rotation[8] = 1;
  layout.at_m[0] = x_m;
  layout.at_m[2] = z_m;
  layout.stiffness_N_per_m = 1e30f;
  return layout;
}

// A floor, whose top is at 0, and a wall at x = 20 mm.
std::vector<uint8_t> corner() {
  std::vector<tools::Section> sections = box_sections("box");
  const std::vector<scene::ObjectLayout> objects = {box_at("floor", 0, -kHalf_m),
                                                    box_at("wall", 2 * kHalf_m, 0)};
  sections.push_back(tools::make_section(scene::kObjectsSection, "room", objects));
  return file_of(std::move(sections));
}

struct Aside : Placed<ObjectsController> {
  uint32_t uncertain = 0;
  explicit Aside(float aside_m) : Placed(corner()) {
    begin();
    for (const params::Index at : {params::kOriginX, params::kOriginY, params::kOriginZ})
      set(at, aside_m);
    for (const params::Index at : {params::kSceneX, params::kSceneY, params::kSceneZ})
      set(at, aside_m);
  }
  void ticked(const record::TickOutput&) override {
    uncertain += tick_number > 20 && (output.state & record::kStateUncertain) != 0 ? 1u : 0u;
  }
};

}  // namespace

TEST(ObjectsSomeSizesAside_ContactWithTwoIsCertain) {
  for (const float aside_m : {0.0f, 0.1f, 0.15f, 0.3f, 1.0f}) {
    test::note("aside, mm", static_cast<uint32_t>(1000 * wide(aside_m)));
    Aside scene(aside_m);
    scene.go({0.01f, -0.01f, 0.02f}, 100);
    scene.go({0.018f, -0.01f, 0.002f}, 100);  // 1 mm into both
    scene.go({0.019f, 0.01f, 0.001f}, 200);
    scene.stay(50);
    CHECK_EQ(scene.uncertain, 0u);
    CHECK_EQ(scene.output.faults, 0u);
    const double at_m[] = {wide(kHalf_m) - wide(kRadius_m), 0.01, wide(kRadius_m)};
    for (int k = 0; k < 3; ++k)
      CHECK_LE(std::fabs(wide(scene.output.proxy_m[k]) - wide(aside_m) - at_m[k]), 3e-6);
  }
}

}  // namespace firmtouch::controller_test
