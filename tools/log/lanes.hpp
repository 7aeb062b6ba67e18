#pragma once
#include <string>
#include <vector>

#include "chart/chart.hpp"
#include "log/schema.hpp"

namespace firmtouch::log {

/// Bits over time in words, a lane each: faults, state, lines. Lanes whose bit is never set are
/// left out.
class Lanes {
 public:
  /// The bits that the log names of these fields; of one that is listed in `all`, the others too.
  Lanes(const Header& header, const std::vector<std::string>& fields,
        const std::vector<std::string>& all, size_t bins);

  void add(size_t bin, const uint8_t* record);
  /// A lane of the caller's: set over these spans of the axis' time.
  void add(const std::string& label, const chart::TimeAxis::Spans& spans);

  /// Adds a remark behind the name of a fault.
  void annotate(const std::string& fault, const std::string& more);

  double height() const;
  /// Drawn as high as height() says, over the time axis of the charts below.
  std::string svg_of(const chart::TimeAxis& axis, const chart::ChartSize& size) const;

 private:
  struct Lane {
    std::string label;
    const char* colour;
    uint32_t offset;  // of the field's word in a record
    uint32_t bit;
    std::vector<bool> bins;
    bool is_set = false;
    chart::TimeAxis::Spans spans;  // where there are no bins
  };
  void add_lane(const Header& header, const Field& field, uint32_t bit);
  size_t bins_;
  std::vector<Lane> lanes_;
};

}  // namespace firmtouch::log
