#pragma once
#include <cstdint>
#include <vector>

#include "log/layout.hpp"
#include "log/schema.hpp"
#include "log/sink.hpp"

namespace firmtouch::log {

/// Writes one log: head, blocks, index. A call that fails changed nothing and can be repeated: the
/// next write goes to the same place. The index takes 24 B of memory a block.
class Writer {
 public:
  /// `header.fields` as they lie in a record; the first must be `number`.
  Writer(Sink& sink, Header header);

  bool begin();
  /// One block of `count` >= 1 records (at most kMaxPayloadBytes), their numbers rising.
  bool append(const uint8_t* records, uint32_t count);
  /// The end block and the tail. `produced`: how many records there were in all, so that those
  /// missing behind the last one are counted too; 0: not known.
  bool finish(uint64_t produced = 0);

  uint64_t bytes() const { return offset_; }
  uint64_t records() const { return records_; }
  uint64_t missing() const { return missing_; }
  uint32_t blocks() const { return sequence_; }
  /// That the record behind the last one should have.
  uint64_t next_number() const { return next_number_; }
  bool has_begun() const { return offset_ > 0; }

 private:
  bool write_block(BlockHead& head, const uint8_t* payload);

  Sink& sink_;
  Header header_;
  FileHead file_{};
  std::vector<IndexEntry> index_;
  uint64_t offset_ = 0;
  uint64_t next_number_ = 0;  // that the next record should have
  uint64_t records_ = 0;
  uint64_t missing_ = 0;
  uint32_t sequence_ = 0;
  uint32_t previous_crc_ = 0;
  uint64_t end_offset_ = 0;  // of the end block, once it is written
};

/// How many records are missing between one that should have had the number `expected` and the one
/// that came, of which every `decimation`-th was to be kept.
constexpr uint64_t missing_between(uint64_t expected, uint64_t number, uint32_t decimation) {
  return number <= expected ? 0 : (number - expected + decimation - 1) / decimation;
}

}  // namespace firmtouch::log
