#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace firmtouch::chart {

/// Least and greatest value in each bin of time: a line of bounded size over any number of samples.
/// NaN where a bin has none.
class Envelope {
 public:
  /// `is_single`: at most one sample falls into a bin, and the greatest values are not kept.
  Envelope(size_t bins, bool is_single) : low_(bins, kNone), high_(is_single ? 0 : bins, kNone) {}

  /// NaN and values beyond 1e30, which a chart cannot show, are left out.
  void add(size_t bin, double value) {
    if (!(std::fabs(value) <= 1e30)) return;
    const float v = static_cast<float>(value);
    if (!(low_[bin] <= v)) low_[bin] = v;
    if (!high_.empty() && !(high_[bin] >= v)) high_[bin] = v;
  }
  /// Pre: `bins` <= those that there are.
  void shorten(size_t bins) {
    low_.resize(bins);
    if (!high_.empty()) high_.resize(bins);
  }
  const std::vector<float>& low() const { return low_; }
  /// Empty if a bin has one sample.
  const std::vector<float>& high() const { return high_; }
  /// One value a bin, or two: the least, then the greatest.
  std::vector<double> values() const {
    std::vector<double> list;
    for (size_t i = 0; i < low_.size(); ++i) {
      list.push_back(static_cast<double>(low_[i]));
      if (!high_.empty()) list.push_back(static_cast<double>(high_[i]));
    }
    return list;
  }

 private:
  static constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> low_, high_;
};

}  // namespace firmtouch::chart
