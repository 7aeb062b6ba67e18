#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace firmtouch::chart {

/// A line of a chart, its values evenly spaced over the time; NaN interrupts it. The others are
/// within 1e30.
struct Series {
  std::string label;
  std::string colour;  // CSS
  std::vector<double> values;
  bool is_area = false;  // filled down to the axis
  double width = 1.6;
};

/// A chart over time, as SVG.
struct Chart {
  std::string title, unit;
  std::vector<Series> series;
  bool is_logarithmic = false;  // values of at least 1
  int decimals = 2;             // of the values shown
};

/// What all charts of a run share.
struct TimeAxis {
  double seconds = 1;
  using Spans = std::vector<std::pair<double, double>>;
  Spans contact_s, guide_s;
  Spans off_s;                                         // motors off after a fault: shown in grey
  Spans missing_s;                                     // of which nothing is known: shown in red
  std::vector<std::pair<double, std::string>> events;  // the text may be empty
};

struct ChartSize {
  double width = 1120, height = 176;
  double left = 58, right = 14, top = 16, bottom = 26;
};

/// The <svg> element; `index` names it for the page's cursor. Colours are the style sheet's
/// variables.
std::string svg_of(const Chart& chart, const TimeAxis& axis, const ChartSize& size, int index);

/// Round numbers from `low` to `high`, about `count` of them.
std::vector<double> round_numbers(double low, double high, int count);

/// The same SVG with the light theme's colours instead of the style sheet's variables: for a
/// picture that has no style sheet.
std::string with_colours(std::string svg);

/// Text for HTML and SVG.
std::string html_of(const std::string& text);
/// A number with `decimals` digits behind the point.
std::string fixed(double value, int decimals);
/// With a space between each three digits of the whole part: 20 160.
std::string grouped(uint64_t value);

}  // namespace firmtouch::chart
