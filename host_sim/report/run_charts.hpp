#pragma once
#include <functional>
#include <string>
#include <vector>

#include "chart/chart.hpp"
#include "chart/envelope.hpp"
#include "device/device_file.hpp"
#include "host_sim/plant/environment.hpp"
#include "host_sim/report/summary.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

using chart::fixed;
using chart::grouped;
using chart::html_of;

/// A line of a chart, gathered while a run goes on.
struct Curve {
  std::string label;
  std::string colour;  // CSS
  std::function<double(const RunTick&)> of;
  bool is_area = false;
  double width = 1.6;
  chart::Envelope values{0, true};
};

struct RunChart {
  std::string title, unit, note;
  std::vector<Curve> curves;
  int decimals = 2;
  bool is_logarithmic = false;
};

/// The charts of a run, most important first: force, penetration, distance with its bound, visits,
/// guide, speed, a linkage's condition, and instructions if they are counted. Memory: at most
/// kMaxBins bins a line.
class RunCharts {
 public:
  /// At 1 kHz 16 s have a bin for each tick; a longer run keeps the least and greatest of each bin.
  /// Homing may lengthen a run, so its bins are those of the longest.
  static constexpr size_t kMaxBins = 16384;

  /// `linkage`: null for a Cartesian device. It and `facts` outlive this.
  RunCharts(const Environment& environment, const RunFacts& facts,
            const tools::LinkageDevice* linkage = nullptr);
  void add(const RunTick& tick);
  /// After the last tick: length, notes and limits.
  void finish(const Summary& summary);

  size_t bins() const { return bins_; }
  uint32_t ticks_per_bin() const { return ticks_per_bin_; }
  const std::vector<RunChart>& charts() const { return charts_; }
  const chart::TimeAxis& axis() const { return axis_; }

 private:
  void add_span(chart::TimeAxis::Spans& spans, bool holds, double time_s) const;
  void add_faults(uint32_t faults, double time_s);

  const RunFacts& facts_;
  uint32_t ticks_per_bin_;
  size_t bins_;
  std::vector<RunChart> charts_;
  chart::TimeAxis axis_;
  double min_gap_s_;  // shorter gaps between two spans are invisible
  uint32_t faults_ = 0, ticks_ = 0;
};

/// For a picture.
chart::Chart chart_of(const RunChart& from);

}  // namespace firmtouch::host_sim
