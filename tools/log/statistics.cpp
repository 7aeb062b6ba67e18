#include "log/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::log {
namespace {

constexpr size_t kWorst = 5;
constexpr double kS_per_us = 1e-6;

// What the fields of a record give, one record after the other.
class Collector {
 public:
  Collector(const Header& header, Statistics& result)
      : header_(header),
        result_(result),
        clock_(header.find("input.clock_us")),
        steps_(header.find("output.steps")),
        faults_(header.find("output.faults")),
        force_(header.find("output.force_N")),
        seen_(32) {
    for (const Column& column : header.columns())
      if (column.field->type == Type::kF32) floats_.push_back(column);
  }

  void take(uint64_t number, const uint8_t* record) {
    if (result_.records == 0) result_.first_number = number;
    if (clock_ != nullptr) take_clock(number, word(record, clock_->offset));
    if (steps_ != nullptr) take_steps(number, word(record, steps_->offset));
    if (faults_ != nullptr) take_faults(number, word(record, faults_->offset));
    if (force_ != nullptr) take_force(number, record);
    take_floats(number, record);
    ++result_.records;
    result_.last_number = number;
  }

  void close() {
    close_period();
    if (clock_ != nullptr) result_.seconds = static_cast<double>(all_passed_) * clock_->scale;
    if (result_.records > 0) result_.mean_steps /= static_cast<double>(result_.records);
    for (uint32_t bit = 0; bit < seen_.size(); ++bit) {
      if (seen_[bit].records == 0) continue;
      seen_[bit].what = header_.what(faults_->name, bit);
      result_.faults.push_back(seen_[bit]);
    }
  }

 private:
  void take_clock(uint64_t number, uint32_t clock) {
    if (result_.records > 0) {
      const uint32_t passed = clock - last_clock_;  // the clock wraps
      all_passed_ += passed;
      if (number - result_.last_number == header_.decimation) {
        if (passed > longest_) longest_ = passed, result_.period.max_number = number;
        passed_.push_back(passed);
      }
    }
    last_clock_ = clock;
  }

  void take_steps(uint64_t number, uint32_t steps) {
    result_.mean_steps += steps;
    std::vector<Statistics::Steps>& worst = result_.worst_steps;
    if (worst.size() == kWorst && steps <= worst.back().steps) return;
    const auto place = std::find_if(worst.begin(), worst.end(),
                                    [&](const Statistics::Steps& s) { return s.steps < steps; });
    worst.insert(place, {number, steps});
    if (worst.size() > kWorst) worst.pop_back();
  }

  void take_faults(uint64_t number, uint32_t faults) {
    for (uint32_t bit = 0; faults >> bit != 0 && bit < 32; ++bit) {
      if ((faults >> bit & 1u) == 0) continue;
      if (seen_[bit].records++ == 0) seen_[bit].first_number = number;
      if (bit == 31) break;
    }
  }

  void take_force(uint64_t number, const uint8_t* record) {
    double square = 0;
    for (uint32_t k = 0; k < force_->count; ++k)
      square += value(*force_, k, record) * value(*force_, k, record);
    const double force_N = std::sqrt(square);
    if (force_N > result_.max_force_N)
      result_.max_force_N = force_N, result_.max_force_number = number;
  }

  void take_floats(uint64_t number, const uint8_t* record) {
    constexpr uint32_t kExponent = 0x7F800000u;  // all of it set: not finite
    for (const Column& column : floats_) {
      if ((word(record, column.offset) & kExponent) != kExponent) continue;
      if (result_.not_finite.records++ == 0)
        result_.not_finite.first_number = number, result_.not_finite.first_field = column.name;
      return;
    }
  }

  void close_period() {
    Statistics::Period& period = result_.period;
    period.count = passed_.size();
    if (passed_.empty()) return;
    std::sort(passed_.begin(), passed_.end());
    const double us = clock_->scale / kS_per_us / header_.decimation;
    const auto at = [&](double share) {
      const size_t i = static_cast<size_t>(share * static_cast<double>(passed_.size()));
      return passed_[std::min(i, passed_.size() - 1)] * us;
    };
    period.min_us = at(0);
    period.median_us = at(0.5);
    period.p99_us = at(0.99);
    period.p999_us = at(0.999);
    period.max_us = at(1);
    double sum = 0, squares = 0;
    for (const uint32_t passed : passed_) sum += passed * us;
    period.mean_us = sum / static_cast<double>(passed_.size());
    for (const uint32_t passed : passed_)
      squares += (passed * us - period.mean_us) * (passed * us - period.mean_us);
    period.deviation_us = std::sqrt(squares / static_cast<double>(passed_.size()));
  }

  const Header& header_;
  Statistics& result_;
  const Field *clock_, *steps_, *faults_, *force_;
  uint32_t last_clock_ = 0, longest_ = 0;
  uint64_t all_passed_ = 0;
  std::vector<uint32_t> passed_;
  std::vector<Column> floats_;
  std::vector<Statistics::Fault> seen_;
};

}  // namespace

Statistics statistics_of(Reader& reader) {
  Statistics result;
  Collector collector(reader.header(), result);
  Block block;
  while (reader.next(block)) {
    uint64_t number = block.first_number;
    for (uint32_t i = 0; i < block.count; ++i) {
      number += word(block.record(i), 0) - static_cast<uint32_t>(number);
      collector.take(number, block.record(i));
    }
  }
  collector.close();
  result.blocks = reader.blocks();
  result.missing = reader.missing();
  result.gaps = reader.gaps();
  result.troubles = reader.troubles();
  return result;
}

}  // namespace firmtouch::log
