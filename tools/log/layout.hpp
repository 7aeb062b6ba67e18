#pragma once
#include <cstddef>
#include <cstdint>

// The parts of a log file, `.ftl`, as they lie on the disk; tools/FORMAT.md says what they mean.
// Little-endian, no padding.
namespace firmtouch::log {

constexpr uint8_t kMagic[8] = {'F', 'T', 'L', 'O', 'G', '\r', '\n', 0x1A};
constexpr uint16_t kMajor = 2;
constexpr uint16_t kMinor = 1;  // 1: records have input.last_work_us
constexpr uint32_t kMaxTextBytes = 1u << 22;
constexpr uint32_t kMaxRecordBytes = 1u << 14;
constexpr uint32_t kMaxPayloadBytes = 1u << 24;

struct FileHead {
  uint8_t magic[8];
  uint16_t major;
  uint16_t minor;
  uint32_t text_bytes;    // of the text that follows
  uint32_t record_bytes;  // of one record
  uint32_t reserved;
  uint32_t text_crc;
  uint32_t head_crc;  // of the 28 bytes before: identifies the log; each block repeats it
};
static_assert(sizeof(FileHead) == 32);

constexpr uint32_t kBlockMagic = 0x424C5446u;  // "FTLB"
constexpr uint32_t kRecordsBlock = 1;
constexpr uint32_t kEndBlock = 2;

struct BlockHead {
  uint32_t magic;
  uint32_t log;            // FileHead::head_crc
  uint32_t kind;           // kRecordsBlock, kEndBlock
  uint32_t sequence;       // of this block in its log, from 0
  uint32_t payload_bytes;  // that follow
  uint32_t count;          // records, or entries of the index
  uint64_t first_number;   // of the first record; in the end: that the next one would have had
  uint64_t missing;        // records missing between the log's first one and this block
  uint32_t reserved[3];
  uint32_t previous_crc;  // head_crc of the block before; of the file's head in the first one
  uint32_t payload_crc;
  uint32_t head_crc;  // of the 60 bytes before
};
static_assert(sizeof(BlockHead) == 64 && offsetof(BlockHead, first_number) == 24);

struct IndexEntry {
  uint64_t offset;  // of a block of records from the file's first byte
  uint64_t first_number;
  uint32_t count;
  uint32_t sequence;
};
static_assert(sizeof(IndexEntry) == 24);

constexpr uint32_t kTailMagic = 0x454C5446u;  // "FTLE"

/// The last bytes of a log that was closed: where its end block is.
struct Tail {
  uint64_t end_offset;
  uint32_t magic;
  uint32_t crc;  // of the 12 bytes before
};
static_assert(sizeof(Tail) == 16);

}  // namespace firmtouch::log
