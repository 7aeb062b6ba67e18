#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/models.hpp"
#include "host_sim/bench/shapes.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/report/score.hpp"

namespace firmtouch::host_sim {

/// A tick of a run on the rig, in the solid's frame.
struct RigTick {
  Vec force_N, motor_N, device_m, position_m, proxy_m, hand_m;
  double depth_m = 0;
  double taken_J = 0;  // of the hand, less motion, stops and the weight that no motor carries
  uint32_t faults = 0;
  bool is_on = false, is_ramped_in = false;
  bool is_guided = false;  // a guide holds the tool
};
using RigRun = std::vector<RigTick>;

/// Settings of a scenario: key, value with its unit.
using Lines = std::vector<std::pair<std::string, std::string>>;

/// The standard rig: 75 g, 0.5 N s/m, no Coulomb friction, encoders of 10 um, a grip of 400 N/m and
/// 4 N s/m, contact of 1,000 N/m and 1 N s/m, 1 kHz, a tool of 3 mm. Seed 0 stands upright. Any
/// other turns the world and draws radius, stiffness, grip and the solids' sizes.
/// On a linkage the start is anywhere in the middle of its ranges, and the solids stand beside it,
/// across the plane of a planar one. It has its own masses and encoders; motor_N are torques, and
/// the controller counts on no friction. It homes only where index pulses need it.
class Rig {
 public:
  /// `machine`: a linkage's name or file; empty: three straight axes. Throws Refused.
  explicit Rig(uint64_t seed, const std::string& machine = "");

  /// The hand goes from `start_m` through the statements of a script, such as hold_s() and to().
  /// Positions are in the solid's frame. The run is that of a controller with `contact`.
  RigRun run(const Solid& solid, Vec start_m, const std::vector<std::string>& script,
             Contact contact = Contact::kProxy, const Lines& settings = {}) const;
  /// The same along a guide through these points, without a solid where none is given.
  RigRun run_guided(const std::vector<Vec>& points_m, Vec start_m,
                    const std::vector<std::string>& script, const Lines& settings = {},
                    const Solid* solid = nullptr) const;
  /// The same by a controller of the caller's.
  RigRun run(const Tick& controller, Vec start_m, const std::vector<std::string>& script,
             const Lines& settings = {}) const;
  /// The scenario of such a run.
  Scenario scenario(Vec start_m, const std::vector<std::string>& script,
                    const Lines& settings = {}) const;
  /// The path of the solid's asset.
  std::string bake(const Solid& solid) const;

  static std::string to(Vec to_m, double speed_mps);
  static std::string hold_s(double time_s);

  /// Of the bounding box of the turned solid.
  double diagonal_m(const Solid& solid) const;
  /// Of contact and grip in series.
  double series_N_per_m() const {
    return stiffness_N_per_m * grip_N_per_m / (stiffness_N_per_m + grip_N_per_m);
  }
  ScoreSettings score_settings() const { return {1000, 8, radius_m, stiffness_N_per_m}; }

  uint64_t seed;
  double radius_m = 0.003, stiffness_N_per_m = 1000, grip_N_per_m = 400;
  double half_angle_rad = 0.78539816339744831, slot_m = 0.004;

 private:
  Vec origin_m(Vec start_m) const;  // of the solid
  std::string statements(Vec start_m, Vec origin_m, const Lines& settings) const;

  Rotation rotation_;
  std::string machine_;
  std::optional<tools::LinkageDevice> linkage_;
  Vec tip_m_;  // of the linkage at the start
  bench::TemporaryFolder folder_;
};

/// "0.003 m"
std::string with_unit(double value, const char* unit);

/// Force, averaged over the last `ticks`.
Vec mean_force_N(const RigRun& run, size_t ticks);
/// Of walls of such a stiffness.
std::vector<ScoredTick> scored(const RigRun& run, double stiffness_N_per_m);

}  // namespace firmtouch::host_sim
