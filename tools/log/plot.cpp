#include "log/plot.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "chart/chart.hpp"
#include "log/reader.hpp"
#include "log/statistics.hpp"

namespace firmtouch::log {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr size_t kBins = 2400;  // twice the pixels that a line has
constexpr size_t kMostMarks = 12;
constexpr double kWidth = 1160, kHeight = 168, kHead = 30;
constexpr const char* kColours[] = {"var(--force)", "var(--second)", "var(--good)", "var(--third)"};

// A line as it is gathered: of each bin of time the least and the greatest value.
class Line {
 public:
  Line(size_t bins, bool is_fine) : low_(bins, kNone), high_(is_fine ? 0 : bins, kNone) {}
  void add(size_t bin, double value) {
    if (std::isnan(value)) return;
    if (!(low_[bin] <= value)) low_[bin] = value;
    if (!high_.empty() && !(high_[bin] >= value)) high_[bin] = value;
  }
  std::vector<double> values() const {
    if (high_.empty()) return low_;
    std::vector<double> list;
    for (size_t i = 0; i < low_.size(); ++i) {
      list.push_back(low_[i]);
      list.push_back(high_[i]);
    }
    return list;
  }

 private:
  std::vector<double> low_, high_;
};

// What a line shows of a record; `dt_s` since the one before, NaN where that is missing.
using Value = std::function<double(const uint8_t* record, double dt_s)>;

struct Curve {
  std::string label;
  Value value;
  bool is_area = false;
};

struct Panel {
  std::string title, unit;
  std::vector<Curve> curves;
  int decimals = 2;
  bool is_logarithmic = false;
};

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
    if (!std::isnan(dt_s)) sum_J += power_W * dt_s;
    return sum_J * 1e3;
  };
}

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
  if (distance != nullptr && lower != nullptr)
    panels.push_back(
        {"Distance to the surface",
         "mm",
         {{"told, negative inside", scaled(distance, 0, 1e3)},
          {"certified bound", [=](const uint8_t* record, double) {
             return std::copysign(value(*lower, 0, record), value(*distance, 0, record)) * 1e3;
           }}}});
  if (deviation != nullptr)
    panels.push_back({"Deviation from the guide", "mm", {{"", scaled(deviation, 0, 1e3), true}}});
  if (force != nullptr && velocity != nullptr)
    panels.push_back(
        {"Energy given to the hand", "mJ", {{"", energy_mJ(force, velocity), false}}, 3});
  if (steps != nullptr)
    panels.push_back({"Steps a tick", "steps", {{"", scaled(steps, 0, 1), true}}, 0, true});
  if (velocity != nullptr)
    panels.push_back({"Speed", "mm/s", {{"", magnitude(velocity, 1e3), false}}, 1});
  if (find("input.clock_us") != nullptr)
    panels.push_back(
        {"Period of the ticks",
         "us",
         {{"", [n = header.decimation](const uint8_t*, double dt_s) { return dt_s * 1e6 / n; }}},
         1});
  return panels;
}

std::vector<Panel> chosen_panels(const std::string& path, const Header& header,
                                 const std::vector<std::string>& names) {
  std::vector<Panel> panels;
  const std::vector<Column> columns = header.columns();
  for (const std::string& name : names) {
    Panel panel{name, "", {}, 3};
    for (const Column& column : columns) {
      if (column.name != name && column.field->name != name) continue;
      const uint32_t index = (column.offset - column.field->offset) / 4;
      panel.unit = column.field->unit;
      panel.curves.push_back(
          {column.field->count > 1 ? std::to_string(index) : "", scaled(column.field, index, 1)});
    }
    if (panel.curves.empty())
      throw std::runtime_error(path + ": its records have no field " + name +
                               "; `firmtouch log LOG info` lists them");
    panels.push_back(std::move(panel));
  }
  return panels;
}

// Faults as they rise, and where most records are missing.
struct Mark {
  uint64_t number;
  std::string text;
};
std::vector<Mark> marks_of(const Statistics& s) {
  std::vector<Mark> marks;
  for (const Statistics::Fault& fault : s.faults)
    marks.push_back({fault.first_number, "fault: " + fault.what});
  std::vector<Gap> gaps = s.gaps;
  std::stable_sort(gaps.begin(), gaps.end(),
                   [](const Gap& a, const Gap& b) { return a.count > b.count; });
  if (gaps.size() > kMostMarks) gaps.resize(kMostMarks);
  for (const Gap& gap : gaps)
    if (gap.number <= s.last_number)
      marks.push_back({gap.number, std::to_string(gap.count) + " missing"});
  return marks;
}

struct Drawn {
  std::vector<Panel> panels;
  std::vector<std::vector<Line>> lines;
  chart::TimeAxis axis;
};

void gather(Reader& reader, const Statistics& s, Drawn& drawn) {
  const uint64_t decimation = reader.header().decimation;
  const uint64_t slots = (s.last_number - s.first_number) / decimation + 1;
  const bool is_fine = slots <= kBins;
  const size_t bins = is_fine ? static_cast<size_t>(slots) : kBins;
  for (const Panel& panel : drawn.panels)
    drawn.lines.emplace_back(panel.curves.size(), Line(bins, is_fine));
  const Field* clock = reader.header().find("input.clock_us");
  uint64_t before = UINT64_MAX;
  uint32_t last_clock = 0;
  Block block;
  while (reader.next(block)) {
    uint64_t number = block.first_number;
    for (uint32_t i = 0; i < block.count; ++i) {
      const uint8_t* record = block.record(i);
      number += word(record, 0) - static_cast<uint32_t>(number);
      const uint32_t now = clock != nullptr ? word(record, clock->offset) : 0;
      const bool follows = before != UINT64_MAX && number - before == decimation;
      const double dt_s = follows && clock != nullptr ? (now - last_clock) * clock->scale : kNone;
      const uint64_t slot = (number - s.first_number) / decimation;
      const size_t bin = static_cast<size_t>(slot * bins / slots);
      for (size_t p = 0; p < drawn.panels.size(); ++p)
        for (size_t c = 0; c < drawn.panels[p].curves.size(); ++c)
          drawn.lines[p][c].add(bin, drawn.panels[p].curves[c].value(record, dt_s));
      before = number;
      last_clock = now;
    }
  }
}

std::string text_at(double x, double y, const std::string& style, const std::string& text) {
  return "<text x=\"" + chart::fixed(x, 0) + "\" y=\"" + chart::fixed(y, 0) + "\" " + style + ">" +
         chart::html_of(text) + "</text>";
}

std::string svg_of(const Drawn& drawn, const std::string& title, const std::string& note) {
  const double height = 62 + static_cast<double>(drawn.panels.size()) * (kHeight + kHead);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " +
                    chart::fixed(kWidth, 0) + " " + chart::fixed(height, 0) +
                    "\" font-family=\"system-ui,Segoe UI,Roboto,Helvetica,Arial,sans-serif\">"
                    "<rect width=\"100%\" height=\"100%\" fill=\"var(--card)\"/>";
  svg += text_at(20, 30, "font-size=\"18\" font-weight=\"650\" fill=\"var(--ink)\"", title);
  svg += text_at(20, 50, "font-size=\"13\" fill=\"var(--soft)\"", note);
  double top = 62;
  for (size_t p = 0; p < drawn.panels.size(); ++p, top += kHeight + kHead) {
    const Panel& panel = drawn.panels[p];
    chart::Chart chart{panel.title, panel.unit, {}, panel.is_logarithmic, 0, "", panel.decimals};
    svg += text_at(20, top + 20, "font-size=\"14\" font-weight=\"620\" fill=\"var(--ink)\"",
                   panel.title);
    double at = 40 + 9.0 * static_cast<double>(panel.title.size());
    for (size_t c = 0; c < panel.curves.size(); ++c) {
      const char* colour = kColours[c % 4];
      chart.series.push_back({panel.curves[c].label, colour, drawn.lines[p][c].values(),
                              panel.curves[c].is_area, 1.4});
      if (panel.curves[c].label.empty()) continue;
      svg += "<rect x=\"" + chart::fixed(at, 0) + "\" y=\"" + chart::fixed(top + 13, 0) +
             "\" width=\"16\" height=\"4\" rx=\"2\" fill=\"" + colour + "\"/>";
      svg += text_at(at + 22, top + 19, "font-size=\"12\" fill=\"var(--soft)\"",
                     panel.curves[c].label);
      at += 46 + 7.0 * static_cast<double>(panel.curves[c].label.size());
    }
    svg += "<svg x=\"20\" y=\"" + chart::fixed(top + kHead - 6, 0) + "\" width=\"" +
           chart::fixed(kWidth - 40, 0) + "\" height=\"" + chart::fixed(kHeight, 0) + "\">" +
           chart::svg_of(chart, drawn.axis, {kWidth - 40, kHeight}, static_cast<int>(p)) + "</svg>";
  }
  return chart::with_colours(svg + "</svg>\n");
}

std::string file_name(const std::string& path) {
  return path.substr(path.find_last_of('/') == std::string::npos ? 0 : path.find_last_of('/') + 1);
}

}  // namespace

std::string plot(const std::string& path, const std::vector<std::string>& fields, bool as_page) {
  Reader counted(open_file(path), path);
  const Statistics s = statistics_of(counted);
  if (s.records == 0) throw std::runtime_error(path + ": it holds no records to plot");
  Reader reader(open_file(path), path);
  Drawn drawn;
  drawn.panels =
      fields.empty() ? usual_panels(reader.header()) : chosen_panels(path, reader.header(), fields);
  const double slots = static_cast<double>(s.last_number - s.first_number);
  drawn.axis.seconds = s.seconds > 0 ? s.seconds : std::max(slots, 1.0);
  for (const Mark& mark : marks_of(s))
    drawn.axis.events.emplace_back(
        drawn.axis.seconds * static_cast<double>(mark.number - s.first_number) / (slots + 1),
        mark.text);
  gather(reader, s, drawn);
  const auto controller = reader.header().text.find("controller");
  std::string note = chart::grouped(s.records) + " records, " + chart::grouped(s.missing) +
                     " missing, " + chart::fixed(s.seconds, 2) + " s";
  if (controller != reader.header().text.end()) note += ", " + controller->second;
  const std::string svg = svg_of(drawn, file_name(path), note);
  if (!as_page) return svg;
  return "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
         chart::html_of(file_name(path)) +
         "</title><style>body{margin:1.5rem auto;max-width:1160px;padding:0 1rem;background:#fff;"
         "color:#16202e;font-family:system-ui,Segoe UI,Roboto,Helvetica,Arial,sans-serif}pre{"
         "background:#f4f6f9;padding:1rem;overflow-x:auto;border-radius:8px;font-size:13px}"
         "</style></head><body>" +
         svg + "<pre>" + chart::html_of(text_of(s)) + "</pre></body></html>\n";
}

}  // namespace firmtouch::log
