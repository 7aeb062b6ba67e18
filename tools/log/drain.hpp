#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "firmtouch/core/span.hpp"
#include "log/interface.hpp"
#include "log/schema.hpp"
#include "log/sink.hpp"
#include "log/writer.hpp"

namespace firmtouch::log {

/// The reader's side of a ring (record/ring.hpp) of any record and capacity.
class Records : public Interface {
 public:
  /// The records that lie together, oldest first, each with its number first; they stay until
  /// release().
  virtual core::Bytes ready() = 0;
  virtual void release(uint32_t count) = 0;
  /// Moments' values.
  virtual uint32_t waiting() const = 0;
  virtual uint32_t capacity() const = 0;
  virtual uint32_t produced() const = 0;
  virtual uint32_t dropped() const = 0;
};

template <class Ring>
class RingRecords : public Records {
 public:
  explicit RingRecords(Ring& ring) : ring_(ring) {}
  core::Bytes ready() override {
    const auto records = ring_.ready();
    return {reinterpret_cast<const uint8_t*>(records.data()),
            records.size() * static_cast<uint32_t>(sizeof *records.data())};
  }
  void release(uint32_t count) override { ring_.release(count); }
  uint32_t waiting() const override { return ring_.waiting(); }
  uint32_t capacity() const override { return Ring::kCapacity; }
  uint32_t produced() const override { return ring_.produced(); }
  uint32_t dropped() const override { return ring_.dropped(); }

 private:
  Ring& ring_;
};

struct DrainOptions {
  // 64 KB of 128 B records: one write of the disk's; a block that is damaged takes as many along.
  uint32_t block_records = 512;
  double flush_s = 0.1;                // records wait no longer than this for their block to fill
  double sync_s = 1;                   // what a power cut may lose, beside the block in work
  uint64_t reserve_bytes = 16u << 20;  // put aside ahead of the writing
  uint64_t file_bytes = 0;             // the next file begins behind so many; 0: one file
  uint32_t keep_files = 0;             // the oldest ones are removed; 0: all are kept
  double retry_s = 0.2;                // after a write that failed: a full disk may be emptied
};

struct DrainTotals {
  uint64_t records = 0;
  uint64_t missing = 0;  // as stated in the log
  uint64_t bytes = 0;
  uint32_t files = 0;
  uint32_t failures = 0;  // of the disk
  uint32_t max_waiting = 0;
  std::string problem;  // of the last failure
};

/// From a ring to files, one step at a time, without a clock or a thread of its own: recorder.hpp
/// gives it both. Records are written from where they lie in the ring and given back when they are
/// on the disk, so all of the ring stands against a disk that stalls.
class Drain {
 public:
  /// Makes the `part`-th file, from 0; nullptr, with the reason, where it cannot.
  using Make = std::function<std::unique_ptr<Sink>(uint32_t part, std::string& problem)>;
  using Remove = std::function<void(uint32_t part)>;

  Drain(Records& records, Header header, DrainOptions options, Make make, Remove remove);

  /// Writes what is due at `now_s`. Result: whether more is due at once.
  bool step(double now_s);
  /// Writes all that is left and closes the log. Result: false where the disk refuses; the log then
  /// ends behind its last whole block.
  bool finish();
  const DrainTotals& totals() const { return totals_; }

 private:
  bool open_part();
  bool write_some(double now_s);
  void rotate();
  bool failed(double now_s, const std::string& problem);

  Records& records_;
  Header header_;
  DrainOptions options_;
  Make make_;
  Remove remove_;
  DrainTotals totals_;
  std::unique_ptr<Sink> sink_;
  std::unique_ptr<Writer> writer_;
  uint64_t reserved_ = 0;
  uint64_t records_of_closed_ = 0, missing_of_closed_ = 0, bytes_of_closed_ = 0;
  uint32_t next_number_ = 0;  // behind the last record of the part before
  bool has_number_ = false;
  double last_write_s_ = 0, last_sync_s_ = 0, retry_at_s_ = 0;
  bool is_dirty_ = false;
};

}  // namespace firmtouch::log
