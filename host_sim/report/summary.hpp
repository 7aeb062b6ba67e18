#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host_sim/plant/brute_force.hpp"
#include "host_sim/plant/environment.hpp"
#include "host_sim/plant/turning_tool.hpp"
#include "host_sim/report/contact_quality.hpp"
#include "host_sim/report/score.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

/// When a fault was latched first.
struct LatchedFault {
  const char* name;
  double time_s;
  bool is_scripted;  // the scenario causes it
};

/// Key figures of a run.
struct Summary {
  size_t ticks = 0, exact_ticks = 0;
  size_t contact_ticks = 0, guide_ticks = 0;  // while the motors were on
  double seconds = 0, rate_Hz = 0;
  double peak_force_N = 0, force_limit_N = 0;
  double peak_torque_Nm = 0;       // of a tool of spheres
  double worst_penetration_m = 0;  // while the motors were on
  double mean_guide_deviation_m = 0, worst_guide_deviation_m = 0;
  double mean_visits = 0;
  uint32_t worst_visits = 0, budget_units = 0;
  // Ticks whose distance was checked against an oracle in double (every triangle; for splines dense
  // samples).
  size_t checked_ticks = 0;
  // Of these: lower bound above the truth, or distance below it, beyond float32 rounding.
  size_t wrong_bounds = 0;
  double worst_gap_m = 0;   // distance - lower bound
  double median_ratio = 0;  // of lower bound to truth
  bool has_surface = false, has_guide = false;
  double mean_instructions = 0;
  uint32_t worst_instructions = 0, stack_high_bytes = 0;
  double mean_late_s = 0, worst_late_s = 0;  // of forces, for `controller_clock`
  // Share of the period that a tick took, where its time was measured.
  double mean_load = 0, worst_load = 0;
  uint32_t faults = 0;
  std::vector<LatchedFault> latched;  // in order of time
  uint32_t homing = 0;  // of the last tick's state: record::kStateNotHomed and above; 0: homed
  double homed_s = -1;  // when it was homed; -1: it was not, or need not be
  // Ticks that enabled beside a wall that is stiffer than stable, and what would have been stable.
  size_t refused_wall_ticks = 0, forced_wall_ticks = 0;
  // Of a linkage; both: their sum; enabled: contact beside the guide as it was set.
  double stable_contact_N_per_m = 0, stable_guide_N_per_m = 0, stable_both_N_per_m = 0;
  double enabled_contact_N_per_m = 0;
  double stable_texture_N = 0;  // the force up to which its textures are; 0: it has none
  // Of contact, with a linkage's own damping: at its worst pose, and where it had the largest
  // force; no joints: it had none.
  struct Walls {
    double stable_N_per_m = 0, passive_N_per_m = 0;
  };
  Walls worst_walls, peak_walls;
  std::vector<double> peak_joints_rad;
  // How it feels (report/contact_quality.hpp), while the motors were on.
  double tool_radius_m = 0;
  bool has_proxy = false;  // which has a way out at any depth
  size_t limit_ticks = 0;  // at the force limit
  double chatter_N = 0, chatter_s = 0;
  double worst_turn_rad = 0;  // of contact between two ticks
  double guide_step_N = 0;    // largest change of a guide's force between two ticks

  double deepest_radii() const;
  double chatter_limit_N() const { return ContactQuality::kChatterShare * force_limit_N; }
  // A hand feels a wall that gives way, goes in to the tool's centre, buzzes or jumps.
  bool is_saturated() const {
    return static_cast<double>(limit_ticks) * 100 > kMaxLimit_percent * static_cast<double>(ticks);
  }
  bool is_deep() const { return !has_proxy && deepest_radii() > kMaxDepth_radii; }
  bool chatters() const { return chatter_s > 0.5; }
  bool turns() const { return worst_turn_rad * 180 > kMaxTurn_deg * 3.14159265358979; }
  bool is_bad_contact() const;
};

/// Computes the figures while a run goes on. Bounded memory.
class Summariser {
 public:
  /// All references outlive this.
  Summariser(const Scenario& scenario, const Environment& environment, const RunFacts& facts);
  void add(const RunTick& tick);
  /// After the last tick.
  Summary finish();

 private:
  struct Made {
    bool is_ready = false;
    Vec position_m;
  };
  void add_oracles();
  void add_faults(uint32_t risen, double time_s);
  void check_certificate(const record::TickOutput& out);
  void add_walls(Summary& summary) const;

  double true_distance_m(Vec at_m);

  const Scenario& scenario_;
  const Environment& environment_;
  std::vector<BruteForce> brute_force_;  // of its different meshes
  std::vector<size_t> oracle_of_;        // of each object: one of these
  std::vector<size_t> nearest_;          // of each object: the triangle of the query before
  MovingMeshes moving_;
  TurningTool tool_;
  double size_m_ = 0;  // that tolerances refer to
  const RunFacts& facts_;
  Summary summary_;
  ContactTurn turn_;
  ContactQuality quality_;
  double stiffness_N_per_m_;
  size_t stride_ = 1;  // ticks from one checked certificate to the next
  Made used_, requested_;
  std::vector<double> ratios_;  // of lower bound to truth, at most 1e5
  uint64_t visits_ = 0, instructions_ = 0;
  double deviation_m_ = 0, load_ = 0, peak_N_ = 0;
  Vec peak_m_;
};

/// The same for a run in memory.
Summary summarise(const Scenario& scenario, const Environment& environment, const Trace& trace);

/// "mean 40 %, worst 61 % of the period".
std::string load_text(const Summary& summary);

/// The figures as text for a terminal.
std::string text_of(const Summary& summary, const RunFacts& trace);

/// The figures as one JSON object, for programs.
std::string json_of(const Summary& summary, const RunFacts& facts);

}  // namespace firmtouch::host_sim
