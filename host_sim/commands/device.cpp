#include <cmath>
#include <cstdio>
#include <string>

#include "device/device_file.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/device/workspace.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kDegrees = 57.295779513082323;
constexpr uint32_t kSteps[] = {0, 0, 400, 40};  // of a joint, by the number of joints

double percent(uint32_t part, const Workspace& of) { return 100.0 * part / of.poses; }

int print_device(const Options& options) {
  const std::string path = options.operand("one device file");
  const LinkageDevice device = tools::read_device(path, read_file(path));
  const Workspace space = workspace_of(device, kSteps[device.joints.joints]);
  const uint32_t none = space.poses - space.with_whole_force - space.with_faded_force;
  std::printf("poses on a grid over the joints' ranges    %u\n", space.poses);
  std::printf("not reachable                              %.2f %%\n",
              percent(space.poses - space.reachable, space));
  std::printf("whole, faded and no force                  %.2f, %.2f, %.2f %%\n",
              percent(space.with_whole_force, space), percent(space.with_faded_force, space),
              percent(none, space));
  if (space.reachable > 0)
    std::printf("tip, x y z from and to, mm                 %.1f %.1f %.1f   %.1f %.1f %.1f\n",
                space.low_m.x * 1e3, space.low_m.y * 1e3, space.low_m.z * 1e3, space.high_m.x * 1e3,
                space.high_m.y * 1e3, space.high_m.z * 1e3);
  if (space.with_whole_force > 0)
    std::printf(
        "force in every direction, with whole force %.3g N\n"
        "longest motion of the tip by a count       %.3g um\n",
        space.least_force_N, space.count_m * 1e6);
  std::printf("least reciprocal condition                 %.4f at", space.worst_condition);
  for (uint32_t k = 0; k < device.joints.joints; ++k)
    std::printf(" %.1f", space.worst_at_rad[k] * kDegrees);
  const bool is_free = is_free_of_singularities(space);
  std::printf(" deg\n%s\n", is_free ? "no singularity within the ranges"
                                    : "the ranges contain a singularity, or poses that the links "
                                      "do not reach: narrow low_ and high_");
  return is_free ? 0 : 1;
}

}  // namespace

const Command& device_command_line() {
  static const Command command = {
      "device",
      "FILE",
      "checks a linkage's file and prints its workspace",
      "FILE begins with `linkage five_bar`, `linkage serial_arm [2|3]` or `linkage delta`; then "
      "lines KEY VALUE UNIT.\nLengths: as in firmware/firmtouch/device. Joints: counts_K, zero_K, "
      "low_K, high_K, max_torque_K; max_speed.\nFade by the reciprocal condition: full_from, "
      "gone_at.\nExit code 1: a pose of the ranges is not reachable, singular, or beyond the "
      "fade.\n",
      {},
      print_device};
  return command;
}

}  // namespace firmtouch::host_sim
