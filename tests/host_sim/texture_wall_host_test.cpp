// A texture as a wall along the surface: what the firmware says of its stiffness against a closed
// form, against motion in a trough that grows or decays, and against what `enable` refuses.
#include <float.h>

#include <cmath>

#include "controller/ride.hpp"
#include "firmtouch/controller/any_device.hpp"
#include "firmtouch/controller/controller.hpp"
#include "firmtouch/controller/curve_guide.hpp"
#include "firmtouch/controller/material_mesh.hpp"
#include "firmtouch/device/stable_wall.hpp"
#include "host_sim/plant/device.hpp"
#include "scene/materials_rig.hpp"

using namespace firmtouch;  // NOLINT: a test file
using host_sim::Vec;

namespace {

constexpr double kPi = 3.14159265358979;
constexpr double kHigh_m = 0.1e-3, kEvery_m = 2e-3;
constexpr double kMass_kg = 0.1, kDamping_N_s_per_m = 1, kPeriod_s = 1e-3;

scene::TextureLayout grooves(double high_m = kHigh_m, double every_m = kEvery_m) {
  return {{{{static_cast<float>(1 / every_m), 0, 0}, static_cast<float>(high_m)}, {}}};
}

scene_test::MaterialsRig plate(const scene::TextureLayout& texture) {
  return scene_test::MaterialsRig(scene_test::two_plates(), {scene_test::material("a", FLT_MAX)},
                                  [](math::Vec3) { return uint8_t{1}; }, {texture});
}

double stable_N_per_m() {
  return static_cast<double>(device::stiffest_stable_N_per_m(static_cast<float>(kMass_kg),
                                                             static_cast<float>(kDamping_N_s_per_m),
                                                             static_cast<float>(kPeriod_s)));
}

// A device that is free along the surface, pressed into a trough with a force that makes the
// texture `share` times as stiff as is stable.
// Result: its largest excursion at the end over that of the beginning.
double growth(double share) {
  scene_test::MaterialsRig rig = plate(grooves());
  const double per_m = static_cast<double>(scene::stiffening_of(rig.materials.textures()).per_m);
  const double deep_m = share * stable_N_per_m() / per_m / 1000 + kHigh_m;  // on 1,000 N/m
  const double trough_m = -0.02 - kEvery_m / 2, off_m = 2e-5;
  rig.go({static_cast<float>(trough_m + off_m), 0, 0.01f},
         {static_cast<float>(trough_m + off_m), 0, static_cast<float>(0.003 - deep_m)}, 100);
  host_sim::DeviceModel model;
  model.mass_kg = kMass_kg, model.viscous_N_s_per_m = kDamping_N_s_per_m, model.coulomb_N = 0;
  host_sim::Device device(model, {trough_m + off_m, 0, 0});
  double first_m = 0, last_m = 0;
  constexpr int kTicks = 8000;
  for (int i = 0; i < kTicks; ++i) {
    const double x_m = device.position_m().x;
    double& most_m = i < kTicks / 4 ? first_m : last_m;
    if (i < kTicks / 4 || i >= 3 * kTicks / 4)
      most_m = std::fmax(most_m, std::fabs(x_m - trough_m));
    const math::Vec3 force_N =
        rig.tick({static_cast<float>(x_m), 0, static_cast<float>(0.003 - deep_m)});
    device.command({static_cast<double>(force_N.x), 0, 0});
    device.advance({}, kPeriod_s);
  }
  return last_m / first_m;
}

using ArmWithMaterials = Controller<Surfaces<MaterialMesh>, CurveGuide, AnyDevice>;

void set(params::Index number, double value, record::TickInput& input) {
  input.command_value = static_cast<float>(value);
  for (uint32_t row = 0; row < ArmWithMaterials::kTable.size(); ++row)
    if (ArmWithMaterials::kTable[row].number == number) input.command = 1 + row;
}

// The walls that the record says while the operator enables.
uint32_t wall_of(const scene::TextureLayout& texture, double force_limit_N,
                 double contact_N_per_m = 800, double guide_N_per_m = 0) {
  std::vector<tools::Section> sections = plate(texture).sections;
  mesh::View view;
  CHECK(tools::open_baked(sections, "shape", view).ok());
  sections.push_back(tools::mesh_probes(view, "shape"));
  device::LinkageLayout arm = {};
  arm.kind = device::kSerialArm, arm.joints = 3;
  arm.length_m[0] = 0.3f, arm.length_m[1] = 0.25f;
  for (uint32_t k = 0; k < 3; ++k) arm.joint[k] = {1e6f, 0, -3, 3}, arm.max_torque_Nm[k] = 20;
  arm.torque_rise_s = 0.002f, arm.max_speed_rad_per_s = 50;
  arm.full_from = 0.1f, arm.gone_at = 0.05f;
  arm.least_mass_kg = static_cast<float>(kMass_kg);
  sections.push_back(tools::make_section(device::kLinkageSection, "arm", &arm, 1));
  const controller_test::Asset asset(controller_test::file_of(std::move(sections)));
  ArmWithMaterials controller;
  CHECK_EQ(controller.open(asset.bytes()).rule, 0u);
  record::TickOutput output{};
  for (uint32_t tick = 0; tick < 20; ++tick) {
    record::TickInput input{};
    input.tick = tick, input.clock_us = tick * 1000;
    input.encoder_counts[1] = 500000, input.encoder_counts[2] = -1000000;
    if (tick == 2) set(params::kForceLimit, force_limit_N, input);
    if (tick == 3) set(params::kDeviceDamping, kDamping_N_s_per_m, input);
    if (tick == 4) set(params::kContactStiffness, contact_N_per_m, input);
    if (tick == 5) set(params::kGuideStiffness, guide_N_per_m, input);
    if (tick >= 10) input.flags = record::kFlagEnable;
    controller.tick(input, output);
    if (tick >= 2 && tick <= 5) CHECK((output.state & record::kStateCommandTaken) != 0);
  }
  return output.state & (record::kStateWallRefused | record::kStateWallForced);
}

}  // namespace

// 2 height (pi / length)^2, of two waves the sum; and (1 + pi height / length)^2.
TEST(TextureWall_Stiffening_IsTheClosedForm) {
  const auto check = [](const scene::Stiffening& by, double share, double per_m) {
    CHECK_LE(std::fabs(static_cast<double>(by.share) / share - 1), 1e-6);
    CHECK_LE(std::fabs(static_cast<double>(by.per_m) - per_m), 1e-6 * per_m);
  };
  const double slope = kPi * kHigh_m / kEvery_m, per_m = 2 * kHigh_m * std::pow(kPi / kEvery_m, 2);
  scene::TextureLayout one[2] = {{}, grooves()};
  check(scene::stiffening_of({one, 2}), (1 + slope) * (1 + slope), per_m);
  one[0] = grooves();
  one[0].wave[1] = {{0, static_cast<float>(1 / kEvery_m), 0}, static_cast<float>(kHigh_m)};
  check(scene::stiffening_of({one, 2}), (1 + 2 * slope) * (1 + 2 * slope), 2 * per_m);
  check(scene::stiffening_of({}), 1, 0);
}

TEST(TextureWall_InATrough_DecaysBelowTheStableStiffnessAndGrowsAboveIt) {
  CHECK_LE(growth(0.95), 0.8);
  CHECK_GE(growth(1.07), 1.25);
}

TEST(TextureWall_StifferThanStable_IsRefused) {
  const double most_N = stable_N_per_m() / (2 * kHigh_m * std::pow(kPi / kEvery_m, 2));
  CHECK_EQ(wall_of(grooves(), 0.99 * most_N), 0u);
  CHECK_EQ(wall_of(grooves(), 1.01 * most_N), uint32_t{record::kStateWallRefused});
  CHECK_EQ(wall_of({}, 1.01 * most_N), 0u);
  // Steep: 800 N/m and 1.73^2 are above 2,000 N/m, flat along the surface or not.
  CHECK_EQ(wall_of(grooves(2e-3 * 0.99, 8.5e-3), 0.1), uint32_t{record::kStateWallRefused});
}

// Each is stable to 1,980 N/m, both to 3,921. The texture makes contact 1,950 N/m stiff.
TEST(TextureWall_OfAGuideThatPullsIntoIt_IsRefusedWhereBothAreTooStiff) {
  const double share = std::pow(1 + kPi * kHigh_m / 9.3e-3, 2), smooth_N_per_m = 1950 / share;
  const scene::TextureLayout texture = grooves(kHigh_m, 9.3e-3);
  CHECK_EQ(wall_of(texture, 0.1, smooth_N_per_m, 1940), 0u);
  CHECK_EQ(wall_of(texture, 0.1, smooth_N_per_m, 1975), uint32_t{record::kStateWallRefused});
  CHECK_EQ(wall_of({}, 0.1, smooth_N_per_m, 1975), 0u);
}
