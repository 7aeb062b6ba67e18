#include "log/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "chart/chart.hpp"
#include "chart/envelope.hpp"
#include "log/lanes.hpp"
#include "log/panels.hpp"
#include "log/plot_page.hpp"
#include "log/reader.hpp"
#include "log/statistics.hpp"

namespace firmtouch::log {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kMax = 1e30;   // of a time
constexpr size_t kBins = 2400;  // twice the pixels that a line has
constexpr double kTop = 66, kHeight = 168, kHead = 30;
constexpr double kMargin = 20;
const chart::ChartSize kSize = {1160 - 2 * kMargin, kHeight};
constexpr const char* kColours[] = {"var(--force)", "var(--second)", "var(--good)", "var(--third)"};

// The records that the log's time has room for, present or missing; at least 1.
class Slots {
 public:
  Slots(const Statistics& s, uint64_t decimation)
      : first_(s.first_number),
        decimation_(decimation),
        count_(static_cast<double>((s.last_number - s.first_number) / decimation) + 1) {}
  double of(uint64_t number) const { return static_cast<double>((number - first_) / decimation_); }
  double count() const { return count_; }
  bool is_fine() const { return count_ <= kBins; }
  size_t bins() const { return is_fine() ? static_cast<size_t>(count_) : kBins; }
  size_t bin(uint64_t number) const {
    const double share = of(number) / count_ * static_cast<double>(bins());
    return std::min(is_fine() ? static_cast<size_t>(of(number)) : static_cast<size_t>(share),
                    bins() - 1);
  }

 private:
  uint64_t first_, decimation_;
  double count_;
};

// Where records are missing, on the axis; what lies closer than a pixel is one.
chart::TimeAxis::Spans missing_spans(const Statistics& s, const Slots& slots, double seconds) {
  chart::TimeAxis::Spans spans;
  const double each_s = seconds / slots.count();
  for (const Gap& gap : s.gaps) {
    if (gap.number > s.last_number) continue;  // behind the last record
    const double to = each_s * slots.of(gap.number);
    const double from = std::max(0.0, to - each_s * static_cast<double>(gap.count));
    if (!spans.empty() && from - spans.back().second < seconds / kSize.width)
      spans.back().second = to;
    else
      spans.emplace_back(from, to);
  }
  return spans;
}

struct Drawn {
  std::vector<Panel> panels;
  std::vector<std::vector<chart::Envelope>> lines;
  Lanes lanes;
  chart::TimeAxis axis;
};

void gather(Reader& reader, const Slots& slots, Drawn& drawn) {
  const uint64_t decimation = reader.header().decimation;
  for (const Panel& panel : drawn.panels)
    drawn.lines.emplace_back(panel.curves.size(), chart::Envelope(slots.bins(), slots.is_fine()));
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
      const size_t bin = slots.bin(number);
      for (size_t p = 0; p < drawn.panels.size(); ++p)
        for (size_t c = 0; c < drawn.panels[p].curves.size(); ++c)
          drawn.lines[p][c].add(bin, drawn.panels[p].curves[c].value(record, dt_s));
      drawn.lanes.add(bin, record);
      before = number;
      last_clock = now;
    }
  }
}

std::string text_at(double x, double y, const std::string& style, const std::string& text) {
  return "<text x=\"" + chart::fixed(x, 0) + "\" y=\"" + chart::fixed(y, 0) + "\" " + style + ">" +
         chart::html_of(text) + "</text>";
}

// An <svg> of the charts' width; `inner` has its own coordinates.
std::string placed(double top, double height, const std::string& inner) {
  return "<svg x=\"" + chart::fixed(kMargin, 0) + "\" y=\"" + chart::fixed(top, 0) + "\" width=\"" +
         chart::fixed(kSize.width, 0) + "\" height=\"" + chart::fixed(height, 0) + "\">" + inner +
         "</svg>";
}

// Title with unit, and of each line its mark, its name and room for the value at a page's pointer.
std::string head_of(const Panel& panel, size_t index, double top) {
  const std::string title = panel.title + (panel.unit.empty() ? "" : ", " + panel.unit);
  std::string svg =
      text_at(kMargin, top + 20, "font-size=\"14\" font-weight=\"620\" fill=\"var(--ink)\"", title);
  double at = 40 + 8.6 * static_cast<double>(title.size());
  for (size_t c = 0; c < panel.curves.size() && at < kSize.width; ++c) {
    const std::string& label = panel.curves[c].label;
    if (!label.empty()) {
      svg += "<rect x=\"" + chart::fixed(at, 0) + "\" y=\"" + chart::fixed(top + 13, 0) +
             "\" width=\"16\" height=\"4\" rx=\"2\" fill=\"" + kColours[c % 4] + "\"/>";
      svg += text_at(at + 22, top + 19, "font-size=\"12\" fill=\"var(--soft)\"", label);
      at += 28 + 6.4 * static_cast<double>(label.size());
    }
    svg += text_at(at, top + 19,
                   "class=\"value" + std::to_string(index) +
                       "\" font-size=\"12\" font-weight=\"620\" fill=\"var(--ink)\"",
                   "");
    at += 70;
  }
  return svg;
}

std::string svg_of(const Drawn& drawn, const std::string& title, const std::string& note) {
  const double lanes = drawn.lanes.height();
  const double height = kTop + lanes + static_cast<double>(drawn.panels.size()) * (kHeight + kHead);
  const double width = kSize.width + 2 * kMargin;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " +
                    chart::fixed(width, 0) + " " + chart::fixed(height, 0) + "\" data-seconds=\"" +
                    chart::fixed(drawn.axis.seconds, 6) +
                    "\" font-family=\"system-ui,Segoe UI,Roboto,Helvetica,Arial,sans-serif\">"
                    "<rect width=\"100%\" height=\"100%\" fill=\"var(--card)\"/>";
  svg += text_at(kMargin, 30, "font-size=\"18\" font-weight=\"650\" fill=\"var(--ink)\"", title);
  svg += text_at(kMargin, 50, "font-size=\"13\" fill=\"var(--soft)\"", note);
  svg += text_at(width - kMargin - kSize.right, 50,
                 "class=\"now\" text-anchor=\"end\" font-size=\"13\" fill=\"var(--ink)\"", "");
  svg += placed(kTop, lanes, drawn.lanes.svg_of(drawn.axis, kSize));
  double top = kTop + lanes;
  for (size_t p = 0; p < drawn.panels.size(); ++p, top += kHeight + kHead) {
    const Panel& panel = drawn.panels[p];
    chart::Chart chart{panel.title, "", {}, panel.is_logarithmic, 0};
    for (size_t c = 0; c < panel.curves.size(); ++c)
      chart.series.push_back({panel.curves[c].label, kColours[c % 4], drawn.lines[p][c].values(),
                              panel.curves[c].is_area, 1.4});
    svg += head_of(panel, p, top);
    svg += placed(top + kHead - 6, kHeight,
                  chart::svg_of(chart, drawn.axis, kSize, static_cast<int>(p)));
  }
  return chart::with_colours(svg + "</svg>\n");
}

bool has_time(const Statistics& s) { return s.seconds > 0 && s.seconds <= kMax; }

std::string note_of(const Statistics& s, const Header& header) {
  std::string note = chart::grouped(s.records) + (s.records == 1 ? " record, " : " records, ") +
                     chart::grouped(s.missing) + " missing";
  if (has_time(s)) note += ", " + chart::fixed(s.seconds, 2) + " s";
  const auto controller = header.text.find("controller");
  if (controller != header.text.end()) note += ", " + controller->second;
  if (header.decimation > 1) note += ", every " + std::to_string(header.decimation) + "th tick";
  if (s.not_finite.records > 0)
    note += ", " + chart::grouped(s.not_finite.records) + " with values that are not finite";
  return note;
}

std::string file_name(const std::string& path) {
  return path.substr(path.find_last_of('/') == std::string::npos ? 0 : path.find_last_of('/') + 1);
}

}  // namespace

std::string plot(const std::string& path, const std::vector<std::string>& fields, bool as_page,
                 std::string* troubles) {
  Reader counted(open_file(path), path);
  const Statistics s = statistics_of(counted);
  if (s.records == 0) throw std::runtime_error(path + ": it holds no records to plot");
  if (troubles != nullptr) *troubles = s.troubles;
  Reader reader(open_file(path), path);
  const Header& header = reader.header();
  const Slots slots(s, header.decimation);
  Drawn drawn = {fields.empty() ? usual_panels(header) : chosen_panels(path, header, fields),
                 {},
                 fields.empty() ? Lanes(header, {"output.faults", "output.state", "input.lines"},
                                        {}, slots.bins())
                                : Lanes(header, fields, fields, slots.bins()),
                 {}};
  drawn.axis.seconds = has_time(s) ? s.seconds : slots.count();
  drawn.axis.missing_s = missing_spans(s, slots, drawn.axis.seconds);
  for (const Statistics::Fault& fault : s.faults) {
    const double share = slots.of(fault.first_number) / std::max(1.0, slots.count() - 1);
    drawn.axis.events.emplace_back(drawn.axis.seconds * share, "");
    drawn.lanes.annotate(fault.what, has_time(s)
                                         ? ", from " + chart::fixed(s.seconds * share, 3) + " s"
                                         : ", from record " + std::to_string(fault.first_number));
  }
  drawn.lanes.add(chart::grouped(s.missing) + " missing in " + chart::grouped(s.gaps.size()) +
                      (s.gaps.size() == 1 ? " place" : " places"),
                  drawn.axis.missing_s);
  gather(reader, slots, drawn);
  const std::string name = file_name(path);
  const std::string svg = svg_of(drawn, name, note_of(s, header));
  return as_page ? page_of(name, svg, text_of(s)) : svg;
}

}  // namespace firmtouch::log
