#pragma once
#include <cstddef>
#include <vector>

#include "firmtouch/record/tick.hpp"
#include "host_sim/report/contact_quality.hpp"

namespace firmtouch::host_sim {

/// What a score needs of a tick.
struct ScoredTick {
  Vec force_N;
  Vec contact_N;                 // the part of it that is contact (contact_quality.hpp)
  double turn_rad = 0;           // of that since the tick before, without what a texture states
  Vec device_m;                  // true, or as the encoders have it
  double depth_m = 0;            // hand to proxy, or penetration
  double stiffness_N_per_m = 0;  // of the spring that is pressed
  bool is_on = false;            // the motors
  bool is_ramping = false;       // the force is not whole yet
  bool is_guided = false;
  bool has_proxy = false;
};

struct ScoreSettings {
  double rate_Hz = 1000, force_limit_N = 8, tool_radius_m = 0.003, stiffness_N_per_m = 800;
  double damping_N_s_per_m = 1;
};

/// `device_m`: the device's position, as the encoders have it or the true one. `turn`: of this run
/// in the environment.
ScoredTick scored(const record::TickOutput& output, Vec device_m, const ScoreSettings& settings,
                  const Environment& environment, ContactTurn& turn);

// Bars of any run.
constexpr double kMaxTurn_deg = 20;      // of the force in a tick
constexpr double kMaxGiven_mJ = 1.5;     // of a tool of 75 g at 0.2 m/s
constexpr double kMaxDepth_radii = 1;    // deeper, penalty contact finds no way out
constexpr double kMaxLimit_percent = 1;  // of the ticks at the force limit

/// How contact is rendered: figures of a run, while the motors are on.
struct Score {
  double buzz_N = 0;  // worst 2 s in contact without a break (buzz.hpp)
  // Of contact between two ticks with more than 0.2 N each; as let_go, where the spring changed by
  // more than the tool's own motion stretches it.
  double turn_rad = 0;
  // Largest gain, without a guide, of: work of the force, plus what the contact's spring holds.
  double given_J = 0;
  double deepest_radii = 0;  // without a proxy, which has a way out at any depth
  size_t limit_ticks = 0;    // at the force limit
  size_t let_go = 0;         // contact, from more than 0.3 N to less than 0.05 N in a tick
  size_t ticks = 0;
};

/// Energy of a spring that is stretched by `depth_m`, with a force that is limited.
double stored_J(double stiffness_N_per_m, double depth_m, double limit_N);
/// The same of a tick. The limit is that of the settings, or of the motors: more than the contact's
/// damper takes from the spring, they do not render.
double stored_J(const ScoreSettings& settings, const ScoredTick& before, const ScoredTick& now);

/// Angle between two forces; 0 where one is too small to have a direction.
double turn_rad(Vec a_N, Vec b_N);
/// Turn of contact between two ticks, or 0 as above.
double turn_rad(const ScoredTick& before, const ScoredTick& now);

Score score_of(const std::vector<ScoredTick>& ticks, const ScoreSettings& settings);

}  // namespace firmtouch::host_sim
