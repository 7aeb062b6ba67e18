#include "log/lanes.hpp"

#include <algorithm>

namespace firmtouch::log {
namespace {

constexpr double kLane = 17, kBelow = 10;  // pixels

}  // namespace

Lanes::Lanes(const Header& header, const std::vector<std::string>& fields,
             const std::vector<std::string>& all, size_t bins)
    : bins_(bins) {
  for (const std::string& name : fields) {
    const Field* field = header.find(name);
    if (field == nullptr || field->unit != "bits") continue;
    const bool is_all = std::find(all.begin(), all.end(), name) != all.end();
    for (uint32_t bit = 0; bit < 32; ++bit) {
      bool is_named = false;
      for (const Bit& named : header.bits) is_named |= named.field == name && named.bit == bit;
      if (is_named || is_all) add_lane(header, *field, bit);
    }
  }
}

void Lanes::add_lane(const Header& header, const Field& field, uint32_t bit) {
  const bool is_fault = field.name == "output.faults";
  const char* colour = is_fault                       ? "var(--bad)"
                       : field.name == "output.state" ? "var(--force)"
                                                      : "var(--third)";
  lanes_.push_back({(is_fault ? "fault: " : "") + header.what(field.name, bit),
                    colour,
                    field.offset,
                    bit,
                    std::vector<bool>(bins_),
                    false,
                    {}});
}

void Lanes::add(size_t bin, const uint8_t* record) {
  for (Lane& lane : lanes_) {
    if (!lane.spans.empty() || (word(record, lane.offset) >> lane.bit & 1u) == 0) continue;
    lane.bins[bin] = true;
    lane.is_set = true;
  }
}

void Lanes::add(const std::string& label, const chart::TimeAxis::Spans& spans) {
  if (spans.empty()) return;
  lanes_.insert(lanes_.begin(), Lane{label, "var(--bad)", 0, 0, {}, true, spans});
}

void Lanes::annotate(const std::string& fault, const std::string& more) {
  for (Lane& lane : lanes_)
    if (lane.label == "fault: " + fault) lane.label += more;
}

double Lanes::height() const {
  const auto set =
      std::count_if(lanes_.begin(), lanes_.end(), [](const Lane& lane) { return lane.is_set; });
  return set > 0 ? kLane * static_cast<double>(set) + kBelow : 0;
}

std::string Lanes::svg_of(const chart::TimeAxis& axis, const chart::ChartSize& size) const {
  using chart::fixed;
  const double width = size.width - size.left - size.right;
  std::string svg = "<svg viewBox=\"0 0 " + fixed(size.width, 0) + " " + fixed(height(), 0) +
                    "\" font-size=\"11.5\">";
  double top = 0;
  for (const Lane& lane : lanes_) {
    if (!lane.is_set) continue;
    chart::TimeAxis::Spans spans = lane.spans;
    for (size_t i = 0; i < lane.bins.size(); ++i) {
      if (!lane.bins[i]) continue;
      const double each_s = axis.seconds / static_cast<double>(lane.bins.size());
      const double from = each_s * static_cast<double>(i);
      if (i > 0 && lane.bins[i - 1])
        spans.back().second = from + each_s;
      else
        spans.emplace_back(from, from + each_s);
    }
    svg += "<rect x=\"" + fixed(size.left, 1) + "\" y=\"" + fixed(top, 1) + "\" width=\"" +
           fixed(width, 1) + "\" height=\"" + fixed(kLane - 3, 1) + "\" fill=\"var(--grid)\" " +
           "fill-opacity=\".55\"/>";
    for (const auto& [from, to] : spans)
      svg += "<rect x=\"" + fixed(size.left + width * from / axis.seconds, 1) + "\" y=\"" +
             fixed(top, 1) + "\" width=\"" +
             fixed(std::max(0.8, width * (to - from) / axis.seconds), 1) + "\" height=\"" +
             fixed(kLane - 3, 1) + "\" fill=\"" + lane.colour + "\" fill-opacity=\".45\"/>";
    svg += "<text x=\"" + fixed(size.left + 6, 1) + "\" y=\"" + fixed(top + 11, 1) +
           "\" fill=\"var(--ink)\">" + chart::html_of(lane.label) + "</text>";
    top += kLane;
  }
  return svg + "</svg>";
}

}  // namespace firmtouch::log
