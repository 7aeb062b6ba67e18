#include "host_sim/trace/csv.hpp"

#include <cstdio>

#include "host_sim/trace/fields.hpp"

namespace firmtouch::host_sim {
namespace {

void add(std::string& row, double value) {
  char text[32];
  std::snprintf(text, sizeof text, ",%.9g", value);
  row += text;
}

}  // namespace

std::string csv_of(const Trace& trace) {
  std::string text = "time_s";
  for (const Field& field : fields()) text += "," + field.name.substr(field.name.find('.') + 1);
  for (const char* name : {"device_m", "hand_target_m", "hand_N"})
    for (int axis = 0; axis < 3; ++axis)
      text += std::string(",") + name + "[" + std::to_string(axis) + "]";
  text += ",instructions\n";
  for (size_t i = 0; i < trace.records.size(); ++i) {
    char time[32];
    std::snprintf(time, sizeof time, "%.9g", static_cast<double>(i) / trace.rate_Hz);
    text += time;
    for (const Field& field : fields()) text += "," + text_of(field, trace.records[i]);
    for (const Vec& v : {trace.device_m[i], trace.target_m[i], trace.hand_N[i]}) {
      add(text, v.x);
      add(text, v.y);
      add(text, v.z);
    }
    text += "," + (trace.instructions.empty() ? "" : std::to_string(trace.instructions[i])) + "\n";
  }
  return text;
}

}  // namespace firmtouch::host_sim
