#pragma once
#include <cstring>
#include <string>
#include <vector>

#include "firmtouch/core/crc32.hpp"
#include "firmtouch/record/ring.hpp"
#include "harness/long.hpp"
#include "log/layout.hpp"
#include "log/memory_sink.hpp"
#include "log/reader.hpp"
#include "log/writer.hpp"

// Small logs in memory, and hands to spoil them with.
namespace firmtouch::log_test {

using Bytes = std::vector<uint8_t>;

/// 16 bytes: number, a clock, a float, a word of bits.
struct Row {
  uint32_t number = 0;
  uint32_t clock_us = 0;
  float force_N = 0;
  uint32_t faults = 0;
};

inline Row row_of(uint32_t number) {
  return {number, number * 1000u, 0.25f * static_cast<float>(number % 17), number * 2654435761u};
}

inline log::Header header() {
  log::Header made;
  made.fields = {{"number", "1", 1, 0, log::Type::kU32, 1, 0},
                 {"input.clock_us", "s", 1e-6, 0, log::Type::kU32, 1, 0},
                 {"output.force_N", "N", 1, 0, log::Type::kF32, 1, 0},
                 {"output.faults", "bits", 1, 0, log::Type::kU32, 1, 0}};
  made.record_bytes = log::place(made.fields);
  made.bits = {{"output.faults", 3, "deadline"}};
  made.text["asset"] = "two\nlines \\ and a backslash";
  return made;
}

inline const uint8_t* bytes_of(const std::vector<Row>& rows) {
  return reinterpret_cast<const uint8_t*>(rows.data());
}

/// A closed log of blocks of these numbers.
inline Bytes log_of(const std::vector<std::vector<uint32_t>>& blocks, uint32_t decimation = 1,
                    bool is_closed = true, const std::string& begun = "0") {
  log::MemorySink sink;
  log::Header head = header();
  head.decimation = decimation;
  head.text["recorded_at_us"] = begun;
  log::Writer writer(sink, head);
  writer.begin();
  for (const std::vector<uint32_t>& numbers : blocks) {
    std::vector<Row> rows;
    for (const uint32_t number : numbers) rows.push_back(row_of(number));
    writer.append(bytes_of(rows), static_cast<uint32_t>(rows.size()));
  }
  if (is_closed) writer.finish();
  return sink.bytes();
}

struct Found {
  std::vector<Row> rows;
  std::vector<log::Block> blocks;
  std::vector<log::Gap> gaps;
  std::vector<log::Damage> damage;
  uint64_t missing = 0;
  bool is_closed = false;
  std::string troubles;
};

/// Calls take(record) for all that are left of the next block. Result: false if there is none.
template <class Record, class Take>
bool read_block(log::Reader& reader, log::Block& block, const Take& take) {
  if (!reader.next(block)) return false;
  for (uint32_t i = 0; i < block.count; ++i) {
    Record record;
    std::memcpy(&record, block.record(i), sizeof record);
    take(record);
  }
  return true;
}

inline Found read(const Bytes& bytes) {
  log::Reader reader(log::over_memory(bytes), "memory");
  Found found;
  log::Block block;
  while (read_block<Row>(reader, block, [&](const Row& row) { found.rows.push_back(row); }))
    found.blocks.push_back(block);
  found.gaps = reader.gaps();
  found.damage = reader.damage();
  found.missing = reader.missing();
  found.is_closed = reader.is_closed();
  found.troubles = reader.troubles();
  return found;
}

/// The rule that refuses the log, or the first of its blocks that is refused; 0: none.
inline uint32_t rule_of(const Bytes& bytes) {
  try {
    const Found found = read(bytes);
    return found.damage.empty() ? 0 : found.damage[0].rule;
  } catch (const log::Refused& refused) {
    return refused.rule;
  }
}

inline uint32_t crc_of(const uint8_t* from, uint64_t bytes) {
  return core::crc32({from, static_cast<uint32_t>(bytes)});
}

template <class T>
T get(const Bytes& bytes, uint64_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}
template <class T>
void put(Bytes& bytes, uint64_t at, const T& value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

inline uint64_t first_block(const Bytes& bytes) {
  return sizeof(log::FileHead) + get<log::FileHead>(bytes, 0).text_bytes;
}

/// Makes every CRC and every link of the chain right again, so that only what was changed on
/// purpose is wrong. Blocks must still lie one behind the other.
inline void repair(Bytes& bytes) {
  log::FileHead file = get<log::FileHead>(bytes, 0);
  file.text_crc = crc_of(bytes.data() + sizeof file, file.text_bytes);
  file.head_crc =
      crc_of(reinterpret_cast<const uint8_t*>(&file), offsetof(log::FileHead, head_crc));
  put(bytes, 0, file);
  uint32_t previous = file.head_crc;
  for (uint64_t at = first_block(bytes); at + sizeof(log::BlockHead) <= bytes.size();) {
    log::BlockHead head = get<log::BlockHead>(bytes, at);
    if (head.payload_bytes > bytes.size() - at - sizeof head) break;
    head.log = file.head_crc;
    head.previous_crc = previous;
    head.payload_crc = crc_of(bytes.data() + at + sizeof head, head.payload_bytes);
    head.head_crc =
        crc_of(reinterpret_cast<const uint8_t*>(&head), offsetof(log::BlockHead, head_crc));
    put(bytes, at, head);
    previous = head.head_crc;
    at += sizeof head + head.payload_bytes;
    if (head.kind == log::kEndBlock) break;
  }
}

class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed * 2 + 1) {}
  uint64_t next() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return state_ * 0x2545F4914F6CDD1Dull;
  }
  uint64_t below(uint64_t limit) { return (next() >> 11) % limit; }

 private:
  uint64_t state_;
};

using test::is_long;

/// A folder of a test's own, gone with it.
struct Folder {
  Folder();
  ~Folder();
  std::string name;
};

}  // namespace firmtouch::log_test
