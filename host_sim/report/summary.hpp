#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host_sim/plant/environment.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

/// Key figures of a run.
struct Summary {
  size_t ticks = 0, exact_ticks = 0;
  size_t contact_ticks = 0, guide_ticks = 0;  // while the motors were on
  double seconds = 0, rate_Hz = 0;
  double peak_force_N = 0, force_limit_N = 0;
  double worst_penetration_m = 0;  // while the motors were on
  double mean_guide_deviation_m = 0, worst_guide_deviation_m = 0;
  double mean_visits = 0;
  uint32_t worst_visits = 0, budget_visits = 0;
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
  // Share of the period that a tick took, where its time was measured.
  double mean_load = 0, worst_load = 0;
  uint32_t faults = 0;
  double fault_s = -1;  // time of the first latched fault; -1: none
  std::string fault_names;
};

Summary summarise(const Scenario& scenario, const Environment& environment, const Trace& trace);

/// "mean 40 %, worst 61 % of the period".
std::string load_text(const Summary& summary);

/// The figures as text for a terminal.
std::string text_of(const Summary& summary, const Trace& trace);

}  // namespace firmtouch::host_sim
