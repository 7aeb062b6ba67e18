#include "log/writer.hpp"

#include <cstring>

#include "firmtouch/core/crc32.hpp"

namespace firmtouch::log {
namespace {

uint32_t crc_of(const void* data, uint64_t bytes) {
  return core::crc32({static_cast<const uint8_t*>(data), static_cast<uint32_t>(bytes)});
}

}  // namespace

Writer::Writer(Sink& sink, Header header) : sink_(sink), header_(std::move(header)) {
  header_.record_bytes = place(header_.fields);
}

bool Writer::begin() {
  const std::string text = text_of(header_);
  std::memcpy(file_.magic, kMagic, sizeof kMagic);
  file_.major = kMajor;
  file_.minor = kMinor;
  file_.text_bytes = static_cast<uint32_t>(text.size());
  file_.record_bytes = header_.record_bytes;
  file_.text_crc = crc_of(text.data(), text.size());
  file_.head_crc = crc_of(&file_, offsetof(FileHead, head_crc));
  if (!sink_.write(0, {&file_, sizeof file_}, {text.data(), text.size()})) return false;
  offset_ = sizeof file_ + text.size();
  previous_crc_ = file_.head_crc;
  return true;
}

bool Writer::append(const uint8_t* records, uint32_t count) {
  BlockHead head{};
  head.kind = kRecordsBlock;
  head.count = count;
  head.payload_bytes = count * header_.record_bytes;
  // The 32 bits of a record's number, carried on to 64.
  const uint32_t first = word(records, 0);
  const uint64_t number =
      records_ == 0 ? first : next_number_ + (first - static_cast<uint32_t>(next_number_));
  head.first_number = number;
  head.missing = missing_;
  if (records_ > 0) head.missing += missing_between(next_number_, number, header_.decimation);
  const IndexEntry entry{offset_, number, count, sequence_};
  if (!write_block(head, records)) return false;
  missing_ = head.missing;
  index_.push_back(entry);
  uint64_t last = number;
  for (uint32_t i = 1; i < count; ++i) {
    const uint32_t at = word(records, i * header_.record_bytes);
    const uint64_t here = last + (at - static_cast<uint32_t>(last));
    missing_ += missing_between(last + header_.decimation, here, header_.decimation);
    last = here;
  }
  next_number_ = last + header_.decimation;
  records_ += count;
  return true;
}

bool Writer::finish(uint64_t produced) {
  if (end_offset_ == 0) {
    BlockHead head{};
    head.kind = kEndBlock;
    head.count = static_cast<uint32_t>(index_.size());
    head.payload_bytes = static_cast<uint32_t>(index_.size() * sizeof(IndexEntry));
    const uint64_t lost =
        records_ > 0 ? missing_between(next_number_, produced, header_.decimation) : 0;
    head.missing = missing_ + lost;
    head.first_number = next_number_ + lost * header_.decimation;
    const uint64_t at = offset_;
    if (!write_block(head, reinterpret_cast<const uint8_t*>(index_.data()))) return false;
    missing_ = head.missing;
    end_offset_ = at;
  }
  Tail tail{end_offset_, kTailMagic, 0};
  tail.crc = crc_of(&tail, offsetof(Tail, crc));
  if (!sink_.write(offset_, {&tail, sizeof tail}, {nullptr, 0})) return false;
  return sink_.end_at(offset_ + sizeof tail);
}

bool Writer::write_block(BlockHead& head, const uint8_t* payload) {
  head.magic = kBlockMagic;
  head.log = file_.head_crc;
  head.sequence = sequence_;
  head.previous_crc = previous_crc_;
  head.payload_crc = crc_of(payload, head.payload_bytes);
  head.head_crc = crc_of(&head, offsetof(BlockHead, head_crc));
  if (!sink_.write(offset_, {&head, sizeof head}, {payload, head.payload_bytes})) return false;
  offset_ += sizeof head + head.payload_bytes;
  previous_crc_ = head.head_crc;
  ++sequence_;
  return true;
}

}  // namespace firmtouch::log
