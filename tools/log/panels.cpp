#include "log/panels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace firmtouch::log {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double length(const Field& field, const uint8_t* record) {
  double square = 0;
  for (uint32_t k = 0; k < field.count; ++k)
    square += value(field, k, record) * value(field, k, record);
  return std::sqrt(square);
}

Value scaled(const Field* field, uint32_t index, double factor) {
  return [=](const uint8_t* record, double) { return value(*field, index, record) * factor; };
}

Value magnitude(const Field* field, double factor) {
  return [=](const uint8_t* record, double) { return length(*field, record) * factor; };
}

// What the device has given to the hand, less what it took: force times velocity, summed up.
Value energy_mJ(const Field* force, const Field* velocity) {
  return [=, sum_J = 0.0](const uint8_t* record, double dt_s) mutable {
    double power_W = 0;
    for (uint32_t k = 0; k < std::min(force->count, velocity->count); ++k)
      power_W += value(*force, k, record) * value(*velocity, k, record);
    if (std::isfinite(power_W * dt_s)) sum_J += power_W * dt_s;
    return sum_J * 1e3;
  };
}

// Distance found and certified lower bound. The distance of a query that was not exact is only an
// upper bound, up to the size of the model; drawn, it would hide all else.
Panel distances(const Header& header, const Field* reported, const Field* lower) {
  Value exact = scaled(reported, 0, 1e3);
  std::string label = "found, negative inside";
  for (const Bit& bit : header.bits) {
    const Field* state = header.find(bit.field);
    if (bit.field != "output.state" || bit.what != "exact" || state == nullptr) continue;
    exact = [=](const uint8_t* record, double) {
      return (word(record, state->offset) >> bit.bit & 1u) != 0 ? value(*reported, 0, record) * 1e3
                                                                : kNone;
    };
    label = "exact, negative inside";
  }
  return {"Distance to the surface",
          "mm",
          {{"certified lower bound",
            [=](const uint8_t* record, double) {
              return std::copysign(value(*lower, 0, record), value(*reported, 0, record)) * 1e3;
            }},
           {label, exact}}};  // the last is drawn over the others
}

}  // namespace

std::vector<Panel> usual_panels(const Header& header) {
  std::vector<Panel> panels;
  const auto find = [&](const char* name) { return header.find(name); };
  const Field *force = find("output.force_N"), *position = find("output.position_m"),
              *velocity = find("output.velocity_mps"), *distance = find("output.distance_m"),
              *lower = find("output.distance_lower_m"),
              *deviation = find("output.guide_deviation_m"), *steps = find("output.steps");
  if (force != nullptr)
    panels.push_back({"Force at the tool", "N", {{"", magnitude(force, 1), true}}});
  if (position != nullptr && position->count == 3)
    panels.push_back({"Position of the tool",
                      "mm",
                      {{"x", scaled(position, 0, 1e3)},
                       {"y", scaled(position, 1, 1e3)},
                       {"z", scaled(position, 2, 1e3)}}});
  if (distance != nullptr && lower != nullptr) panels.push_back(distances(header, distance, lower));
  if (deviation != nullptr)
    panels.push_back({"Deviation from the guide", "mm", {{"", scaled(deviation, 0, 1e3), true}}});
  if (force != nullptr && velocity != nullptr)
    panels.push_back({"Energy given to the hand", "mJ", {{"", energy_mJ(force, velocity)}}});
  if (steps != nullptr)
    panels.push_back({"Steps a tick", "", {{"", scaled(steps, 0, 1), true}}, true});
  if (velocity != nullptr) panels.push_back({"Speed", "mm/s", {{"", magnitude(velocity, 1e3)}}});
  if (find("input.clock_us") != nullptr)
    panels.push_back(
        {"Period of the ticks", "us", {{"", [n = header.decimation](const uint8_t*, double dt_s) {
                                          return dt_s * 1e6 / n;
                                        }}}});
  return panels;
}

std::vector<Panel> chosen_panels(const std::string& path, const Header& header,
                                 const std::vector<std::string>& names) {
  std::vector<Panel> panels;
  const std::vector<Column> columns = header.columns();
  for (const std::string& name : names) {
    Panel panel{name, "", {}};
    bool is_there = false;
    for (const Column& column : columns) {
      if (column.name != name && column.field->name != name) continue;
      is_there = true;
      if (column.field->unit == "bits") continue;
      const uint32_t index = (column.offset - column.field->offset) / 4;
      if (column.field->unit != "1") panel.unit = column.field->unit;
      panel.curves.push_back(
          {column.field->count > 1 && column.name != name ? std::to_string(index) : "",
           scaled(column.field, index, 1)});
    }
    if (!is_there)
      throw std::runtime_error(path + ": its records have no field " + name +
                               "; `firmtouch log LOG info` lists them");
    if (!panel.curves.empty()) panels.push_back(std::move(panel));
  }
  return panels;
}

}  // namespace firmtouch::log
