#include <sys/resource.h>

#include <cstdio>

#include "host_sim/report/page_data.hpp"
#include "host_sim/report/summary.hpp"

namespace firmtouch::host_sim {
namespace {

class Object {
 public:
  Object& add(const char* name, const std::string& value) {
    text_ += std::string(text_.empty() ? "\"" : ", \"") + name + "\": " + value;
    return *this;
  }
  Object& add(const char* name, double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return add(name, std::string(text));
  }
  Object& add(const char* name, size_t value) { return add(name, std::to_string(value)); }
  Object& add(const char* name, bool value) {
    return add(name, std::string(value ? "true" : "false"));
  }
  std::string text() const { return "{" + text_ + "}\n"; }

 private:
  std::string text_;
};

// Most memory that this process has had.
size_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

std::string json_of(const Summary& s, const RunFacts& facts) {
  Object all;
  all.add("controller", json_text(facts.controller)).add("ticks", s.ticks);
  all.add("rate_Hz", s.rate_Hz).add("seconds", s.seconds);
  all.add("contact_ticks", s.contact_ticks).add("guide_ticks", s.guide_ticks);
  all.add("peak_force_N", s.peak_force_N).add("force_limit_N", s.force_limit_N);
  all.add("deepest_penetration_m", s.worst_penetration_m);
  all.add("mean_guide_deviation_m", s.mean_guide_deviation_m);
  all.add("worst_guide_deviation_m", s.worst_guide_deviation_m);
  all.add("mean_steps", s.mean_visits).add("worst_steps", size_t{s.worst_visits});
  all.add("budget_steps", size_t{s.budget_units}).add("exact_ticks", s.exact_ticks);
  all.add("checked_ticks", s.checked_ticks).add("wrong_bounds", s.wrong_bounds);
  all.add("mean_load", s.mean_load).add("worst_load", s.worst_load);
  all.add("ticks_at_force_limit", s.limit_ticks).add("deepest_tool_radii", s.deepest_radii());
  all.add("chatter_N", s.chatter_N).add("chatter_s", s.chatter_s);
  all.add("largest_turn_rad", s.worst_turn_rad).add("is_bad_contact", s.is_bad_contact());
  if (s.worst_instructions > 0)
    all.add("mean_instructions", s.mean_instructions)
        .add("worst_instructions", size_t{s.worst_instructions})
        .add("stack_high_bytes", size_t{s.stack_high_bytes});
  if (facts.compared) all.add("same_bits", !facts.difference);
  all.add("faults", size_t{s.faults}).add("faults_names", json_text(s.fault_names));
  if (s.fault_s >= 0) all.add("fault_s", s.fault_s).add("fault_is_scripted", s.fault_is_scripted);
  return all.add("peak_memory_bytes", peak_memory_bytes()).text();
}

}  // namespace firmtouch::host_sim
