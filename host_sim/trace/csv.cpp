#include "host_sim/trace/csv.hpp"

#include <cstdio>

#include "firmtouch/record/ring.hpp"
#include "host_sim/trace/fields.hpp"

namespace firmtouch::host_sim {
namespace {

void add_number(std::string& row, double value) {
  char text[32];
  std::snprintf(text, sizeof text, ",%.9g", value);
  row += text;
}

// As in the log, without "input." and "output.".
std::string short_of(const std::string& name) { return name.substr(name.find('.') + 1); }

}  // namespace

CsvStream::CsvStream(const std::string& path) : out_(path) {
  row_ = "time_s";
  for (const Field& field : fields()) row_ += "," + short_of(field.name);
  for (const char* name : {"device_m", "hand_target_m", "hand_N"})
    for (int axis = 0; axis < 3; ++axis)
      row_ += std::string(",") + name + "[" + std::to_string(axis) + "]";
  row_ += ",instructions";
  for (const log::Field& field : header_.fields)
    if (field.unit == "bits") row_ += "," + short_of(field.name) + "_names";
  out_.add(row_ + "\n");
}

void CsvStream::add(const RunTick& tick, double time_s) {
  row_.clear();
  add_number(row_, time_s);
  row_.erase(0, 1);
  for (const Field& field : fields()) row_ += "," + text_of(field, tick.record);
  for (const Vec& v : {tick.device_m, tick.target_m, tick.hand_N})
    for (const double value : {v.x, v.y, v.z}) add_number(row_, value);
  row_ += "," + (tick.instructions == 0 ? "" : std::to_string(tick.instructions));
  const record::Numbered<record::TickRecord> slot{tick.record.input.tick, tick.record};
  for (const log::Field& field : header_.fields)
    if (field.unit == "bits")
      row_ += "," + header_.names(field.name,
                                  log::word(reinterpret_cast<const uint8_t*>(&slot), field.offset));
  out_.add(row_ + "\n");
}

}  // namespace firmtouch::host_sim
