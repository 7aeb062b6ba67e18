// An asset whose coordinates count from an origin: the part stands where its file and the scene's
// place say, whatever the origin.
#include "bake/asset/origin.hpp"
#include "controller/placed.hpp"
#include "firmtouch/controller/material_mesh.hpp"
#include "firmtouch/controller/tool_controller.hpp"
#include "firmtouch/scene/objects_layout.hpp"
#include "firmtouch/scene/tool_layout.hpp"

namespace firmtouch::controller_test {
namespace {

using tools::Point;

constexpr Point kOrigin_m{5.25, -3.5, 2.125};
constexpr float kMoved_m = 0x1p-11f;  // a place of the scene, exact in every sum here

// The commands that place the scene at `at_m`, in ticks 1 to 3.
record::TickInput placed(record::TickInput input, math::Vec3 at_m) {
  const float at[3] = {at_m.x, at_m.y, at_m.z};
  if (input.tick < 1 || input.tick > 3) return input;
  input.command = 1 + params::kSceneX + input.tick - 1;
  input.command_value = at[input.tick - 1];
  return input;
}

// Of ticks after that.
struct Difference {
  uint32_t ticks = 0, contacts = 0;
  double force_N = 0;  // sum
};

// A ride on `near` with the scene at kMoved_m, and on `far`, which the scene brings there.
template <class Controller>
Difference difference(const Asset& near, const Asset& far, math::Vec3 back_m) {
  Ride ride;  // for its inputs
  Controller controller, moved;
  CHECK_EQ(controller.open(near.bytes()).rule, 0u);
  CHECK_EQ(moved.open(far.bytes()).rule, 0u);
  Difference found;
  for (uint32_t tick = 0; tick < 4000; ++tick) {
    ride.fill(tick);
    record::TickOutput a, b;
    const math::Vec3 at_m{kMoved_m, -kMoved_m, kMoved_m};
    controller.tick(placed(ride.input, at_m), a);
    moved.tick(placed(ride.input, at_m - back_m), b);
    if (tick < 4) continue;  // not yet in place
    found.ticks += std::memcmp(&a, &b, sizeof a) != 0;
    found.contacts += (a.state & record::kStateContact) != 0;
    for (int k = 0; k < 3; ++k) found.force_N += std::fabs(wide(a.force_N[k]) - wide(b.force_N[k]));
  }
  return found;
}

// The same stored coordinates, counted from 0 and from kOrigin_m: every bit is the same.
template <class Controller>
void check_same_bits(std::vector<tools::Section> sections) {
  const Asset near(file_of(sections));
  sections.push_back(tools::origin_section(kOrigin_m));
  const Difference found =
      difference<Controller>(near, Asset(file_of(sections)), tools::to_vec3(kOrigin_m));
  CHECK_EQ(found.ticks, 0u);
  CHECK_GE(found.contacts, 500u);
}

std::vector<tools::Section> with(tools::Section section) {
  std::vector<tools::Section> sections = part_sections();
  sections.push_back(std::move(section));
  return sections;
}

scene::ObjectLayout standing() {
  scene::ObjectLayout object{};
  std::memcpy(object.name, "one", 3);
  std::memcpy(object.mesh, "part", 4);
  object.rotation[0] = object.rotation[4] = object.rotation[8] = 1;
  object.stiffness_N_per_m = FLT_MAX;
  return object;
}

}  // namespace

TEST(FarAsset_BroughtBackByTheScene_HasEveryBitOfTheNearOne) {
  check_same_bits<FullController>(both_sections());
  check_same_bits<ToolController>(both_sections());
}

TEST(FarObjects_BroughtBackByTheScene_HaveEveryBitOfTheNearOnes) {
  const scene::ObjectLayout object = standing();
  check_same_bits<ToolController>(
      with(tools::make_section(scene::kObjectsSection, "scene", &object, 1)));
}

TEST(FarTool_BroughtBackByTheScene_HasEveryBitOfTheNearOne) {
  const scene::SphereLayout sphere{{0, 0, 0}, 0.003f};
  check_same_bits<ToolController>(
      with(tools::make_section(scene::kToolSection, "tool", &sphere, 1)));
}

// Baked from places that the scene's float32 does not meet: as if its rounding moved the near part.
TEST(FarPart_BroughtBackByTheScene_GivesTheForceOfTheNearOne) {
  const Point shift_m{5.1234567, -3.4567891, 2.3456789}, origin_m{5.125, -3.5, 2.375};
  tools::Surface surface = tools::make_part(1, 4000);
  for (math::Vec3& v : surface.vertices)
    v = tools::to_vec3(tools::to_point(v) + shift_m - origin_m);
  std::vector<tools::Section> sections = mesh_sections(surface, "part");
  sections.push_back(tools::origin_section(origin_m));
  const Asset near(file_of(part_sections())), far(file_of(sections));
  const Difference found = difference<FullController>(near, far, tools::to_vec3(shift_m));
  constexpr float kHalfUnit_m = 0x1p-22f;  // of the scene's place on x
  const Difference moved =
      difference<FullController>(near, near, {kHalfUnit_m, kHalfUnit_m, kHalfUnit_m});
  CHECK_GE(found.contacts, 500u);
  CHECK_GE(found.force_N, 1e-9);
  CHECK_LE(found.force_N, moved.force_N);
}

}  // namespace firmtouch::controller_test
