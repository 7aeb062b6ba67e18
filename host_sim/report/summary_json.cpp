#include <sys/resource.h>

#include "host_sim/report/page_data.hpp"
#include "host_sim/report/summary.hpp"

namespace firmtouch::host_sim {
namespace {

// Most memory that this process has had.
size_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<size_t>(usage.ru_maxrss) * 1024;
}

std::string names_of(const std::vector<LatchedFault>& faults) {
  std::string names;
  for (const LatchedFault& fault : faults)
    names += (names.empty() ? "" : ", ") + std::string(fault.name);
  return names;
}

std::string fault_json(const LatchedFault& fault) {
  tools::Json json;
  json.add("name", json_text(fault.name)).add("first_s", fault.time_s);
  return json.add("is_scripted", fault.is_scripted).object();
}

}  // namespace

std::string json_of(const Summary& s, const RunFacts& facts) {
  tools::Json all;
  all.add("controller", json_text(facts.controller)).add("ticks", s.ticks);
  all.add("rate_Hz", s.rate_Hz).add("seconds", s.seconds);
  all.add("contact_ticks", s.contact_ticks).add("guide_ticks", s.guide_ticks);
  all.add("peak_force_N", s.peak_force_N).add("force_limit_N", s.force_limit_N);
  all.add("deepest_penetration_m", s.worst_penetration_m);
  all.add("mean_guide_deviation_m", s.mean_guide_deviation_m);
  all.add("worst_guide_deviation_m", s.worst_guide_deviation_m);
  all.add("mean_steps", s.mean_visits).add("worst_steps", uint64_t{s.worst_visits});
  all.add("budget_units", uint64_t{s.budget_units}).add("exact_ticks", s.exact_ticks);
  all.add("checked_ticks", s.checked_ticks).add("wrong_bounds", s.wrong_bounds);
  all.add("mean_load", s.mean_load).add("worst_load", s.worst_load);
  all.add("ticks_at_force_limit", s.limit_ticks).add("deepest_tool_radii", s.deepest_radii());
  all.add("chatter_N", s.chatter_N).add("chatter_s", s.chatter_s);
  all.add("largest_turn_rad", s.worst_turn_rad).add("guide_step_N", s.guide_step_N);
  all.add("is_bad_contact", s.is_bad_contact());
  if (s.worst_instructions > 0)
    all.add("mean_instructions", s.mean_instructions)
        .add("worst_instructions", uint64_t{s.worst_instructions})
        .add("stack_high_bytes", uint64_t{s.stack_high_bytes});
  if (s.worst_late_s > 0) all.add("mean_late_s", s.mean_late_s).add("worst_late_s", s.worst_late_s);
  if (facts.hottest.share > 0)
    all.add("hottest_winding_share", facts.hottest.share)
        .add("hottest_winding_K", facts.hottest.rise_K)
        .add("hottest_winding_joint", uint64_t{facts.hottest.joint});
  if (facts.compared) all.add("same_bits", !facts.difference);
  if (s.homed_s >= 0) all.add("homed_s", s.homed_s);
  if (s.homing != 0) all.add("homing_state", uint64_t{s.homing >> 20});
  if (s.stable_contact_N_per_m > 0)
    all.add("stable_contact_N_per_m", s.stable_contact_N_per_m)
        .add("stable_guide_N_per_m", s.stable_guide_N_per_m)
        .add("stable_both_N_per_m", s.stable_both_N_per_m)
        .add("stable_texture_N", s.stable_texture_N)
        .add("refused_wall_ticks", s.refused_wall_ticks)
        .add("forced_wall_ticks", s.forced_wall_ticks);
  if (!s.peak_joints_rad.empty())
    all.add("stable_at_worst_pose_N_per_m", s.worst_walls.stable_N_per_m)
        .add("passive_at_worst_pose_N_per_m", s.worst_walls.passive_N_per_m)
        .add("stable_at_largest_force_N_per_m", s.peak_walls.stable_N_per_m)
        .add("passive_at_largest_force_N_per_m", s.peak_walls.passive_N_per_m);
  all.add("faults", uint64_t{s.faults}).add("faults_names", json_text(names_of(s.latched)));
  if (!s.latched.empty())
    all.add("fault_s", s.latched[0].time_s).add("fault_is_scripted", s.latched[0].is_scripted);
  all.add("faults_latched", tools::json_list(s.latched, fault_json));
  return all.add("peak_memory_bytes", uint64_t{peak_memory_bytes()}).object() + "\n";
}

}  // namespace firmtouch::host_sim
