// The machines by name: each is a good device file, agrees with its simulation, and says what has
// no source.
#include "device/machines.hpp"

#include <algorithm>
#include <string>

#include "device/device_file.hpp"
#include "harness/long.hpp"
#include "harness/test.hpp"
#include "host_sim/device/firmware_check.hpp"
#include "host_sim/device/workspace.hpp"

using namespace firmtouch;  // NOLINT: a test file
using host_sim::FirmwareCheck;
using tools::LinkageDevice;

TEST(EveryMachine_IsFreeOfSingularities_AndAgreesWithItsSimulation) {
  const uint32_t poses = test::is_long() ? 1000000 : 5000;
  CHECK_GE(tools::machine_names().size(), 6u);
  for (const std::string& name : tools::machine_names()) {
    const LinkageDevice device = tools::read_device(name, tools::machine_text(name));
    test::note(name.c_str(), 0);
    CHECK(host_sim::is_free_of_singularities(host_sim::workspace_of(device, 20)));
    const FirmwareCheck check = host_sim::check_firmware(device, poses);
    CHECK_EQ(check.poses, poses);
    CHECK(host_sim::is_good(check));
    CHECK_GE(check.force, 1e-6);  // encoders are not exact
  }
}

TEST(CoarseEncoder_FailsTheCheckOfForces) {
  LinkageDevice device = tools::read_device("touch_like", tools::machine_text("touch_like"));
  for (device::JointSetting& joint : device.joints.joint) joint.counts_per_rad = 100;
  const FirmwareCheck check = host_sim::check_firmware(device, 1000);
  CHECK_GE(check.force, host_sim::kMaxForceError);
  CHECK(!host_sim::is_good(check));
}

TEST(Machines_NameWhatIsAssumed) {
  const auto is_assumed = [](const char* name, const char* key) {
    const std::vector<std::string> keys = tools::assumed_keys(tools::machine_text(name));
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  };
  CHECK(!is_assumed("haply_pantograph", "distal_1") && is_assumed("haply_pantograph", "rotor_0"));
  CHECK(!is_assumed("pantograph_mk2", "base") && is_assumed("pantograph_mk2", "counts_0"));
  CHECK(!is_assumed("phantom_premium_15", "link_1"));
  CHECK(is_assumed("omega_like", "upper_0") && is_assumed("touch_like", "link_0"));
  CHECK(tools::machine_text("hexapod").empty());
  for (const std::string& name : tools::machine_names()) {  // masses have no source anywhere
    CHECK(is_assumed(name.c_str(), "tip_mass"));
  }
}
