#pragma once
#include <mutex>
#include <vector>

#include "log/drain.hpp"

namespace firmtouch::host_sim {

/// Bounded queue of records between the thread that reads a link and the one that writes the log.
/// The record size is known at run time only. A mutex is allowed: neither thread is a servo.
class QueuedRecords : public log::Records {
 public:
  QueuedRecords(uint32_t record_bytes, uint32_t capacity)
      : record_bytes_(record_bytes), capacity_(capacity), bytes_(size_t{record_bytes} * capacity) {}

  /// Appends a record; if the queue is full, drops and counts it.
  /// Result: false, and it is left out, if its number is not above the last, as of a frame that
  ///         came twice or late: no log may hold it.
  bool push(const uint8_t* record) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const uint32_t number = log::word(record, 0);
    const bool is_first = kept_ == 0 && dropped_ == 0;
    if (!is_first && static_cast<int32_t>(number - number_) < 0) return false;
    number_ = number + 1;
    if (kept_ - taken_ == capacity_) {
      ++dropped_;
      return true;
    }
    uint8_t* slot = bytes_.data() + size_t{kept_ % capacity_} * record_bytes_;
    for (uint32_t i = 0; i < record_bytes_; ++i) slot[i] = record[i];
    ++kept_;
    return true;
  }
  uint32_t record_bytes() const { return record_bytes_; }

  core::Bytes ready() override {
    const std::lock_guard<std::mutex> lock(mutex_);
    const uint32_t first = taken_ % capacity_, waiting = kept_ - taken_;
    const uint32_t together = capacity_ - first;
    return {bytes_.data() + size_t{first} * record_bytes_,
            (waiting < together ? waiting : together) * record_bytes_};
  }
  void release(uint32_t count) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    taken_ += count;
  }
  uint32_t waiting() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return kept_ - taken_;
  }
  uint32_t capacity() const override { return capacity_; }
  /// Behind the number of the last record that came.
  uint32_t produced() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return number_;
  }
  uint32_t dropped() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return dropped_;
  }

 private:
  const uint32_t record_bytes_, capacity_;
  mutable std::mutex mutex_;
  std::vector<uint8_t> bytes_;
  uint32_t kept_ = 0, taken_ = 0, dropped_ = 0, number_ = 0;
};

}  // namespace firmtouch::host_sim
