#pragma once
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "log/layout.hpp"
#include "log/schema.hpp"
#include "log/source.hpp"

namespace firmtouch::log {

/// A file that is no log, or one whose head is damaged: rule L<rule> of tools/FORMAT.md.
struct Refused : std::runtime_error {
  Refused(uint32_t number, const std::string& message)
      : std::runtime_error(message), rule(number) {}
  uint32_t rule;
};

/// Records that stand together in the log.
struct Block {
  uint64_t offset = 0;
  uint64_t first_number = 0;
  uint64_t missing = 0;  // before its first record, since the log's first
  uint32_t sequence = 0;
  uint32_t count = 0;
  uint32_t record_bytes = 0;
  std::vector<uint8_t> payload;
  const uint8_t* record(uint32_t i) const { return payload.data() + size_t{i} * record_bytes; }
};

/// Bytes that are no whole block, and by which rule.
struct Damage {
  uint64_t offset = 0;
  uint64_t bytes = 0;
  uint32_t rule = 0;
};

/// Records that should be there and are not: `count` of them, before the record `number`.
struct Gap {
  uint64_t number = 0;
  uint64_t count = 0;
  uint64_t of_blocks = 0;  // of these, in blocks that are lost or damaged; the others were dropped
};

/// Reads a log block by block. A block that a rule rejects is skipped and reported; what follows
/// is searched for the next whole one, so a damaged or cut-off log gives every whole block it has.
class Reader {
 public:
  /// Throws Refused where the head is not that of a log. `name`: of the file, for messages.
  Reader(std::unique_ptr<Source> source, const std::string& name);

  const Header& header() const { return header_; }
  /// The next block of records. Result: false at the end.
  bool next(Block& block);

  // What is known when next() has said false.
  uint64_t records() const { return records_; }
  uint32_t blocks() const { return blocks_; }
  const std::vector<Damage>& damage() const { return damage_; }
  /// In the order of the log. At most kMaxGaps are kept; missing() counts all.
  const std::vector<Gap>& gaps() const { return gaps_; }
  uint64_t missing() const { return missing_; }
  /// Whether it was closed: its end is there. One without was cut off behind its last block.
  bool is_closed() const { return is_closed_; }
  bool is_whole() const { return is_closed_ && damage_.empty(); }
  /// What befell the log beside dropped records, for a message; empty where nothing did.
  std::string troubles() const;

  static constexpr size_t kMaxGaps = 100000;

 private:
  bool look(uint64_t at, BlockHead& head, uint32_t& rule);
  uint32_t check_payload(const BlockHead& head, const std::vector<uint8_t>& payload) const;
  uint32_t check_end(const BlockHead& head, const std::vector<uint8_t>& payload) const;
  void take(const BlockHead& head, Block& block);
  void close(const BlockHead& head);
  void add_gap(uint64_t number, uint64_t count, uint64_t of_blocks);
  void add_damage(uint64_t from, uint64_t to, uint32_t rule);
  uint64_t find_block(uint64_t from);

  std::unique_ptr<Source> source_;
  Header header_;
  uint32_t log_ = 0;
  uint64_t at_ = 0;
  uint32_t next_sequence_ = 0;
  uint32_t previous_crc_ = 0;
  uint64_t next_number_ = 0;
  uint64_t dropped_ = 0;  // as stated in the blocks
  uint64_t missing_ = 0;
  uint64_t records_ = 0;
  uint32_t blocks_ = 0;
  bool is_closed_ = false;
  bool is_at_end_ = false;
  std::vector<IndexEntry> seen_;
  std::vector<Damage> damage_;
  std::vector<Gap> gaps_;
};

/// Reads the whole log; afterwards the reader holds what next() reported.
void read_through(Reader& reader);

}  // namespace firmtouch::log
