#include <cstdio>

#include "firmtouch/device/homing.hpp"
#include "host_sim/report/summary.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kDegrees = 57.29577951308232;

std::string walls_text(const Summary& s) {
  char text[384], texture[128] = "";
  if (s.stable_texture_N > 0)
    std::snprintf(texture, sizeof texture,
                  ", and the texture, which only device_damping damps, to a force_limit of %.2f N",
                  s.stable_texture_N);
  std::snprintf(
      text, sizeof text,
      "%s in %zu ticks: stable are contact to %.0f N/m and the guide to %.0f N/m, together to "
      "%.0f N/m%s; lower the stiffness or raise the damping%s",
      s.refused_wall_ticks > 0 ? "REFUSED, motors off," : "forced",
      s.refused_wall_ticks + s.forced_wall_ticks, s.stable_contact_N_per_m, s.stable_guide_N_per_m,
      s.stable_both_N_per_m, texture,
      s.refused_wall_ticks > 0 ? "; or bake the device with `walls forced`" : "");
  return text;
}

// "homed at 0.52 s"; empty where nothing was homed.
std::string homing_text(const Summary& s) {
  char text[160] = "";
  const uint32_t failed = s.homing >> record::kStateHomingFaultShift;
  const char* name = device::fault_name(static_cast<device::HomingFault>(failed & 15u));
  if (failed != 0)
    std::snprintf(text, sizeof text, "failed: joint %u: %s", failed >> 4 & 3u, name);
  else if (s.homing != 0)
    std::snprintf(text, sizeof text, "not homed at the end");
  else if (s.homed_s >= 0)
    std::snprintf(text, sizeof text, "homed at %.3f s", s.homed_s);
  return text;
}

std::string windings_text(const RunFacts& facts) {
  char text[128] = "";
  if (facts.hottest.share > 0)
    std::snprintf(text, sizeof text,
                  "  windings       hottest %.3f of its rated rise, %.1f K, joint %u, from cold\n",
                  facts.hottest.share, facts.hottest.rise_K, facts.hottest.joint);
  return text;
}

// What a hand would feel is marked where it is more than `firmtouch-sim score` allows.
std::string quality_text(const Summary& s) {
  char limit[64] = "", depth[64] = "", chatter[80] = "", turn[64] = "";
  if (s.is_saturated())
    std::snprintf(limit, sizeof limit, " (BAD: more than %.0f %% of all)", kMaxLimit_percent);
  if (s.is_deep()) std::snprintf(depth, sizeof depth, " (BAD: more than %.0f)", kMaxDepth_radii);
  if (s.chatters())
    std::snprintf(chatter, sizeof chatter, " (BAD: for %.2f s more than %.2f N)", s.chatter_s,
                  s.chatter_limit_N());
  if (s.turns()) std::snprintf(turn, sizeof turn, " (BAD: more than %.0f)", kMaxTurn_deg);
  char text[512];
  std::snprintf(text, sizeof text,
                "%zu ticks at the force limit%s; deepest %.2f tool radii%s; chatter %.3f N above "
                "50 Hz%s; largest turn of contact %.1f degrees a tick%s",
                s.limit_ticks, limit, s.deepest_radii(), depth, s.chatter_N, chatter,
                s.worst_turn_rad * kDegrees, turn);
  return text;
}

}  // namespace

std::string load_text(const Summary& s) {
  char text[64];
  std::snprintf(text, sizeof text, "mean %.0f %%, worst %.0f %% of the period", s.mean_load * 100,
                s.worst_load * 100);
  return s.worst_load > 0 ? text : "not measured (lock-step)";
}

std::string text_of(const Summary& s, const RunFacts& trace) {
  std::string text;
  const auto line = [&](const char* format, auto... values) {
    const size_t at = text.size();
    text.resize(at + static_cast<size_t>(std::snprintf(nullptr, 0, format, values...)));
    std::snprintf(&text[at], text.size() - at + 1, format, values...);
  };
  line("  ticks          %zu at %g Hz (%.4g s), controller: %s\n", s.ticks, s.rate_Hz, s.seconds,
       trace.controller.c_str());
  line(
      "  contact        %zu ticks with the motors on; peak force %.2f N (limit %.2f N); deepest "
      "penetration %.2f mm\n",
      s.contact_ticks, s.peak_force_N, s.force_limit_N, s.worst_penetration_m * 1e3);
  if (s.peak_torque_Nm > 0)
    line("  torque         of the spheres, at most %.4f N m; no motor renders it\n",
         s.peak_torque_Nm);
  if (s.has_guide)
    line(
        "  guide          %zu ticks on it; mean deviation %.2f mm, worst %.2f mm; largest step of "
        "its force %.2f N a tick\n",
        s.guide_ticks, s.mean_guide_deviation_m * 1e3, s.worst_guide_deviation_m * 1e3,
        s.guide_step_N);
  line(
      "  visits a tick  mean %.1f, worst %u (tree nodes read); work of at most %u units, base "
      "hulls apart\n",
      s.mean_visits, s.worst_visits, s.budget_units);
  if (s.has_surface)
    line(
        "  certificate    lower <= true distance <= upper bound: %zu of %zu checked ticks (oracle "
        "in double)\n",
        s.checked_ticks - s.wrong_bounds, s.checked_ticks);
  if (s.worst_instructions > 0)
    line("  instructions   mean %.0f a tick, worst %u; stack %u bytes\n", s.mean_instructions,
         s.worst_instructions, s.stack_high_bytes);
  if (s.worst_late_s > 0)
    line("  output delay   mean %.4f ms for the controller's time, worst %.4f ms%s\n",
         s.mean_late_s * 1e3, s.worst_late_s * 1e3,
         s.worst_instructions > 0 ? "" : ": the bound of tick_work");
  if (s.contact_ticks + s.guide_ticks > 0) line("  feel           %s\n", quality_text(s).c_str());
  if (!homing_text(s).empty()) line("  homing         %s\n", homing_text(s).c_str());
  if (s.refused_wall_ticks + s.forced_wall_ticks > 0)
    line("  walls          %s\n", walls_text(s).c_str());
  if (!s.peak_joints_rad.empty()) {
    line(
        "  walls by pose  stable to %.0f N/m and passive to %.0f where the force was largest, "
        "joints",
        s.peak_walls.stable_N_per_m, s.peak_walls.passive_N_per_m);
    for (const double angle_rad : s.peak_joints_rad) line(" %.1f", angle_rad * kDegrees);
    line(" deg; at the worst pose to %.0f and %.0f; contact is enabled to %.0f\n",
         s.worst_walls.stable_N_per_m, s.worst_walls.passive_N_per_m, s.enabled_contact_N_per_m);
  }
  text += windings_text(trace);
  line("  load           %s\n", load_text(s).c_str());
  if (trace.compared)
    text += trace.difference ? "  same bits      NO: see below\n"
                             : "  same bits      yes: every output bit of every tick is equal to "
                               "the in-process controller's\n";
  for (const LatchedFault& fault : s.latched)
    line("  fault          %s, latched at %.3f s%s\n", fault.name, fault.time_s,
         fault.is_scripted ? " (part of the scenario)" : "");
  return text;
}

}  // namespace firmtouch::host_sim
