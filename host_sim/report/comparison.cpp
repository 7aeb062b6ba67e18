#include "host_sim/report/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "host_sim/trace/fields.hpp"

namespace firmtouch::host_sim {
namespace {

uint32_t word_of(const Field& field, const record::TickRecord& record) {
  uint32_t word;
  std::memcpy(&word, reinterpret_cast<const char*>(&record) + field.offset, sizeof word);
  return word;
}

double value_of(const Field& field, uint32_t word) {
  if (field.kind == Field::Kind::kUnsigned) return word;
  if (field.kind == Field::Kind::kSigned) return static_cast<int32_t>(word);
  float value;
  std::memcpy(&value, &word, sizeof value);
  return static_cast<double>(value);
}

double length_of(const float (&a)[record::kAxes]) {
  double sum = 0;
  for (const float part : a) sum += static_cast<double>(part) * static_cast<double>(part);
  return std::sqrt(sum);
}

RunFigures figures_of(const Log& log) {
  RunFigures run;
  double force2 = 0, visits = 0;
  for (const record::TickRecord& record : log.records) {
    const record::TickOutput& out = record.output;
    const double force_N = length_of(out.force_N);
    run.contact_ticks += (out.state & record::kStateContact) != 0 ? 1 : 0;
    run.exact_ticks += (out.state & record::kStateExact) != 0 ? 1 : 0;
    run.peak_force_N = std::max(run.peak_force_N, force_N);
    for (const float motor : out.motor_N)
      run.peak_motor = std::max(run.peak_motor, std::fabs(static_cast<double>(motor)));
    run.peak_speed_mps = std::max(run.peak_speed_mps, length_of(out.velocity_mps));
    run.deepest_m = std::max(run.deepest_m, static_cast<double>(out.penetration_m));
    run.worst_visits = std::max(run.worst_visits, out.steps);
    run.faults |= out.faults;
    force2 += force_N * force_N;
    visits += out.steps;
  }
  run.ticks = log.records.size();
  const double count = std::max<double>(1, static_cast<double>(run.ticks));
  run.rms_force_N = std::sqrt(force2 / count);
  run.mean_visits = visits / count;
  return run;
}

// What the header of one has and the other has not, or otherwise.
std::vector<std::string> settings_that_differ(const Log& first, const Log& second) {
  std::set<std::string> keys;
  for (const Log* log : {&first, &second})
    for (const auto& entry : log->text) keys.insert(entry.first);
  std::vector<std::string> lines;
  for (const std::string& key : keys) {
    const auto text = [&](const Log& log) {
      const auto found = log.text.find(key);
      if (found == log.text.end()) return std::string("-");
      return key == "scenario" ? std::to_string(found->second.size()) + " bytes" : found->second;
    };
    const auto a = first.text.find(key), b = second.text.find(key);
    const bool is_same = a != first.text.end() && b != second.text.end() && a->second == b->second;
    if (!is_same) lines.push_back(key + ": " + text(first) + " | " + text(second));
  }
  return lines;
}

}  // namespace

Comparison compare(const Log& first, const Log& second) {
  Comparison result;
  result.first = figures_of(first);
  result.second = figures_of(second);
  result.settings = settings_that_differ(first, second);
  result.ticks = std::min(result.first.ticks, result.second.ticks);
  for (const Field& field : fields()) {
    FieldComparison row{field.name};
    double sum = 0;
    bool differs = false;
    for (size_t i = 0; i < result.ticks; ++i) {
      const uint32_t a = word_of(field, first.records[i]), b = word_of(field, second.records[i]);
      if (a == b) continue;
      const uint32_t tick = first.records[i].input.tick;
      if (!differs) row.first_tick = tick;
      const double off = std::fabs(value_of(field, a) - value_of(field, b));
      const double size = std::isnan(off) ? HUGE_VAL : off;
      if (!differs || size > row.worst) row.worst = size, row.worst_tick = tick;
      differs = true;
      sum += size * size;
    }
    row.rms = std::sqrt(sum / std::max<double>(1, static_cast<double>(result.ticks)));
    if (differs) result.fields.push_back(row);
  }
  return result;
}

}  // namespace firmtouch::host_sim
