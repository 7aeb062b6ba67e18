#include "chart/chart.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace firmtouch::chart {
namespace {

// Text that lines may run behind.
const std::string kOnCard = "paint-order=\"stroke\" stroke=\"var(--card)\" stroke-width=\"4\" ";

class Plot {
 public:
  Plot(const Chart& chart, const TimeAxis& axis, const ChartSize& size)
      : chart_(chart), axis_(axis), size_(size) {
    double most = 0, least = 0;
    for (const Series& s : chart.series)
      for (const double v : s.values) most = std::max(most, v), least = std::min(least, v);
    if (chart.is_logarithmic) {
      high_ = 4;
      while (high_ < most * 1.05) high_ *= 2;
      for (double v = 1; v * 1.5 <= high_; v *= 4) marks_.push_back(v);
    } else {
      if (!(most - least > 1e-30)) most = 1;
      marks_ = round_numbers(0, (most - least) * 1.04, 4);
      const double step = marks_[1];
      if (least < 0) {
        low_ = std::floor(least * 1.04 / step) * step;
        marks_.clear();
        for (int i = static_cast<int>(std::lround(low_ / step)); i * step <= most * 1.04; ++i)
          marks_.push_back(i * step);
      }
      high_ = std::max(most * 1.04, marks_.back());
    }
  }

  double x(double time_s) const {
    return size_.left + (size_.width - size_.left - size_.right) * time_s / axis_.seconds;
  }
  double y(double value) const {
    const double share = chart_.is_logarithmic ? std::log(std::max(value, 1.0)) / std::log(high_)
                                               : (value - low_) / (high_ - low_);
    return base() - (base() - size_.top) * std::clamp(share, 0.0, 1.0);
  }
  double base() const { return size_.height - size_.bottom; }

  std::string scale() const;
  std::string frame() const;
  std::string bands() const;
  std::string off() const;
  std::string missing() const;
  std::string line(const Series& series, size_t index) const;
  std::string points(const std::vector<double>& values, size_t from, size_t to) const;
  std::string events() const;

 private:
  const Chart& chart_;
  const TimeAxis& axis_;
  const ChartSize& size_;
  double low_ = 0, high_ = 1;  // of the values; low_ is 0 where none is negative
  std::vector<double> marks_;
};

std::string text_at(double x, double y, const std::string& style, const std::string& text) {
  return "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" " + style + ">" +
         html_of(text) + "</text>";
}

std::string rule(double x1, double y1, double x2, double y2, const std::string& style) {
  return "<line x1=\"" + fixed(x1, 1) + "\" y1=\"" + fixed(y1, 1) + "\" x2=\"" + fixed(x2, 1) +
         "\" y2=\"" + fixed(y2, 1) + "\" " + style + "/>";
}

int decimals_of(const std::vector<double>& marks) {
  const double step = marks.size() > 1 ? marks[1] - marks[0] : 1;
  return step >= 1 ? 0 : std::min(4, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
}

// As a decimal number where that is short.
std::string mark_text(double mark, const std::vector<double>& marks) {
  const double step = marks.size() > 1 ? marks[1] - marks[0] : 1;
  if (step >= 1e-4 && step <= 1e6) return fixed(mark, decimals_of(marks));
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", mark);
  return text;
}

std::string Plot::frame() const {
  std::string svg;
  const double right = size_.width - size_.right;
  for (const double mark : marks_) {
    svg += rule(size_.left, y(mark), right, y(mark), "stroke=\"var(--grid)\"");
    svg += text_at(size_.left - 8, y(mark) + 4, "text-anchor=\"end\" fill=\"var(--soft)\"",
                   chart_.is_logarithmic ? fixed(mark, 0) : mark_text(mark, marks_));
  }
  if (low_ < 0) svg += rule(size_.left, y(0), right, y(0), "stroke=\"var(--line)\"");
  const std::vector<double> times = round_numbers(0, axis_.seconds, 10);
  for (const double time : times) {
    if (time > axis_.seconds * 1.0001) continue;
    svg += rule(x(time), base(), x(time), base() + 4, "stroke=\"var(--line)\"");
    const bool at_end = x(time) > right - 12;
    svg += text_at(
        x(time), base() + 18,
        std::string("text-anchor=\"") + (at_end ? "end" : "middle") + "\" fill=\"var(--soft)\"",
        mark_text(time, times) + (time > 0 ? "" : " s"));
  }
  svg += rule(size_.left, base(), right, base(), "stroke=\"var(--line)\"");
  return svg + text_at(size_.left - 8, size_.top - 5,
                       "text-anchor=\"end\" fill=\"var(--soft)\" font-style=\"italic\"",
                       chart_.unit);
}

// For a page that shows the value at the pointer: the values at the lower and upper border.
std::string Plot::scale() const {
  char text[160];
  std::snprintf(text, sizeof text,
                "\" data-base=\"%.1f\" data-top=\"%.1f\" data-low=\"%.9g\" data-high=\"%.9g",
                base(), size_.top, chart_.is_logarithmic ? 1.0 : low_, high_);
  return text + std::string(chart_.is_logarithmic ? "\" data-log=\"1" : "");
}

std::string Plot::bands() const {
  std::string svg;
  const auto band = [&](const TimeAxis::Spans& spans, double top, const char* colour) {
    for (const auto& [from, to] : spans)
      svg += "<rect x=\"" + fixed(x(from), 1) + "\" y=\"" + fixed(top, 1) + "\" width=\"" +
             fixed(std::max(0.6, x(to) - x(from)), 1) + "\" height=\"3\" fill=\"" + colour + "\"/>";
  };
  band(axis_.contact_s, size_.top - 9, "var(--second)");
  band(axis_.guide_s, size_.top - 4, "var(--good)");
  return svg;
}

// Over the lines, so that they pale: what nobody feels.
std::string Plot::off() const {
  std::string svg;
  for (const auto& [from, to] : axis_.off_s) {
    svg += "<rect class=\"off\" x=\"" + fixed(x(from), 1) + "\" y=\"" + fixed(size_.top, 1) +
           "\" width=\"" + fixed(std::max(0.6, x(to) - x(from)), 1) + "\" height=\"" +
           fixed(base() - size_.top, 1) + "\" fill=\"var(--card)\" fill-opacity=\".72\"/>";
    svg += "<rect x=\"" + fixed(x(from), 1) + "\" y=\"" + fixed(size_.top, 1) + "\" width=\"" +
           fixed(std::max(0.6, x(to) - x(from)), 1) + "\" height=\"" +
           fixed(base() - size_.top, 1) + "\" fill=\"var(--soft)\" fill-opacity=\".16\"/>";
  }
  return svg;
}

std::string Plot::missing() const {
  std::string svg;
  for (const auto& [from, to] : axis_.missing_s)
    svg += "<rect class=\"missing\" x=\"" + fixed(x(from), 1) + "\" y=\"" + fixed(size_.top, 1) +
           "\" width=\"" + fixed(std::max(0.8, x(to) - x(from)), 1) + "\" height=\"" +
           fixed(base() - size_.top, 1) + "\" fill=\"var(--bad)\" fill-opacity=\".13\"/>";
  return svg;
}

// A column of pixels shows the least and the greatest of its values, so that no peak is lost.
std::string Plot::points(const std::vector<double>& values, size_t from, size_t to) const {
  const size_t n = values.size();
  const size_t pixels = static_cast<size_t>(size_.width - size_.left - size_.right);
  const size_t columns = std::max<size_t>(1, std::min(to - from, (to - from) * pixels / n));
  std::string points;
  const auto add = [&](size_t i) {
    points += (points.empty() ? "" : " ") +
              fixed(x(axis_.seconds * static_cast<double>(i) / static_cast<double>(n)), 1) + "," +
              fixed(y(values[i]), 1);
  };
  for (size_t c = 0; c < columns; ++c) {
    const size_t begin = from + c * (to - from) / columns;
    const size_t end = std::max(begin + 1, from + (c + 1) * (to - from) / columns);
    size_t low = begin, high = begin;
    for (size_t i = begin; i < end; ++i) {
      if (values[i] < values[low]) low = i;
      if (values[i] > values[high]) high = i;
    }
    add(std::min(low, high));
    if (std::fabs(y(values[low]) - y(values[high])) > 0.3) add(std::max(low, high));
  }
  return points;
}

// Piece by piece between the NaNs.
std::string Plot::line(const Series& series, size_t index) const {
  const std::vector<double>& values = series.values;
  const size_t n = values.size();
  std::string svg;
  for (size_t from = 0; from < n;) {
    if (std::isnan(values[from])) {
      ++from;
      continue;
    }
    size_t to = from;
    while (to < n && !std::isnan(values[to])) ++to;
    const std::string line = points(values, from, to);
    const auto time = [&](size_t i) {
      return axis_.seconds * static_cast<double>(i) / static_cast<double>(n);
    };
    if (to - from == 1) {  // a line of no length would not be seen
      svg += "<circle cx=\"" + fixed(x(time(from)), 1) + "\" cy=\"" + fixed(y(values[from]), 1) +
             "\" r=\"" + fixed(series.width, 1) + "\" fill=\"" + series.colour + "\"/>";
      from = to;
      continue;
    }
    if (series.is_area)
      svg += "<polygon points=\"" + fixed(x(time(from)), 1) + "," + fixed(base(), 1) + " " + line +
             " " + fixed(x(time(to - 1)), 1) + "," + fixed(base(), 1) + "\" fill=\"" +
             series.colour + "\" fill-opacity=\".14\"/>";
    svg += "<polyline data-series=\"" + std::to_string(index) + "\" points=\"" + line +
           "\" fill=\"none\" stroke=\"" + series.colour + "\" stroke-width=\"" +
           fixed(series.width, 1) + "\" stroke-linejoin=\"round\"/>";
    from = to;
  }
  return svg;
}

std::string Plot::events() const {
  std::string svg;
  for (const auto& [time, name] : axis_.events) {
    if (time > axis_.seconds) continue;
    const bool at_end = x(time) > size_.width * 0.8;
    svg +=
        rule(x(time), size_.top, x(time), base(), "stroke=\"var(--bad)\" stroke-dasharray=\"2 3\"");
    if (name.empty()) continue;
    svg += text_at(
        x(time) + (at_end ? -5 : 5), size_.top + 13,
        kOnCard + "text-anchor=\"" + (at_end ? "end" : "start") + "\" fill=\"var(--bad)\"", name);
  }
  return svg;
}

}  // namespace

std::vector<double> round_numbers(double low, double high, int count) {
  const double raw = (high - low) / count;
  const double ten = std::pow(10, std::floor(std::log10(raw)));
  const double step = ten * (raw / ten > 5 ? 10 : raw / ten > 2 ? 5 : raw / ten > 1 ? 2 : 1);
  std::vector<double> numbers;
  for (int i = 0; low + i * step <= high * (1 + 1e-9); ++i) numbers.push_back(low + i * step);
  return numbers;
}

std::string fixed(double value, int decimals) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string grouped(uint64_t value) {
  std::string text = std::to_string(value);
  for (size_t i = text.size(); i > 3; i -= 3)
    text.insert(i - 3, "\u202f");  // narrow no-break space
  return text;
}

std::string with_colours(std::string svg) {
  constexpr const char* kColours[][2] = {{"var(--force)", "#2159d6"}, {"var(--second)", "#e2742b"},
                                         {"var(--third)", "#8a93a6"}, {"var(--good)", "#1f8a5b"},
                                         {"var(--bad)", "#c62839"},   {"var(--soft)", "#566175"},
                                         {"var(--line)", "#dde2ea"},  {"var(--grid)", "#e8ecf1"},
                                         {"var(--card)", "#ffffff"},  {"var(--ink)", "#16202e"}};
  for (const auto& [name, colour] : kColours)
    for (size_t at = svg.find(name); at != std::string::npos; at = svg.find(name, at))
      svg.replace(at, std::string(name).size(), colour);
  return svg;
}

std::string html_of(const std::string& text) {
  std::string html;
  for (const char c : text)
    html += c == '&'   ? "&amp;"
            : c == '<' ? "&lt;"
            : c == '>' ? "&gt;"
            : c == '"' ? "&quot;"
            : (static_cast<unsigned char>(c) < ' ' && c != '\n') || c == 0x7F
                ? "?"  // no page may hold them
                : std::string(1, c);
  return html;
}

std::string svg_of(const Chart& chart, const TimeAxis& axis, const ChartSize& size, int index) {
  const Plot plot(chart, axis, size);
  std::string svg = "<svg class=\"chart\" viewBox=\"0 0 " + fixed(size.width, 0) + " " +
                    fixed(size.height, 0) + "\" data-chart=\"" + std::to_string(index) +
                    "\" data-left=\"" + fixed(size.left, 0) + "\" data-right=\"" +
                    fixed(size.width - size.right, 0) + plot.scale() +
                    "\" font-family=\"system-ui,Segoe UI,Roboto,Helvetica,Arial,sans-serif\" "
                    "font-size=\"12\" role=\"img\" "
                    "aria-label=\"" +
                    html_of(chart.title) + " over time\">";
  svg += plot.frame() + plot.missing() + plot.bands();
  for (size_t i = 0; i < chart.series.size(); ++i) svg += plot.line(chart.series[i], i);
  svg += plot.off() + plot.events();
  svg += "<line class=\"cursor\" y1=\"" + fixed(size.top, 0) + "\" y2=\"" + fixed(plot.base(), 0) +
         "\" stroke=\"var(--ink)\" stroke-opacity=\".55\" style=\"display:none\"/>";
  return svg + "</svg>";
}

}  // namespace firmtouch::chart
