#include "log/reader.hpp"

#include <algorithm>
#include <cstring>

#include "firmtouch/core/crc32.hpp"
#include "log/writer.hpp"

namespace firmtouch::log {
namespace {

// The rules that refuse a file, and those that refuse a block; tools/FORMAT.md.
constexpr uint32_t kRuleMagic = 1, kRuleMajor = 2, kRuleHeadCrc = 3, kRuleTextCut = 4,
                   kRuleTextCrc = 5, kRuleReserved = 6, kRuleRecordBytes = 7, kRuleLine = 8,
                   kRuleFields = 9, kRuleNumber = 10;
constexpr uint32_t kRuleNoBlock = 20, kRuleOtherLog = 21, kRuleSequence = 22, kRuleKind = 23,
                   kRuleLength = 24, kRuleCut = 25, kRulePayloadCrc = 26, kRuleChain = 27,
                   kRuleBlockReserved = 28, kRuleNumbers = 29, kRuleMissing = 30, kRuleIndex = 31,
                   kRuleTail = 32;

constexpr uint64_t kSearchBytes = 1u << 16;

uint32_t crc_of(const void* data, uint64_t bytes) {
  return core::crc32({static_cast<const uint8_t*>(data), static_cast<uint32_t>(bytes)});
}

[[noreturn]] void refuse(uint32_t rule, const std::string& name, const std::string& what) {
  throw Refused(rule, name + ": " + what + " (rule L" + std::to_string(rule) + ")");
}

// Reads and checks the head of the file; its text goes into `text`.
FileHead read_head(Source& source, const std::string& name, std::string& text) {
  FileHead head{};
  if (source.size() < sizeof head || !source.read(0, &head, sizeof head) ||
      std::memcmp(head.magic, kMagic, sizeof kMagic) != 0)
    refuse(
        kRuleMagic, name,
        "this is no log; `firmtouch-sim run SCENARIO --log FILE` and `firmtouch-sim record` make "
        "one");
  if (head.major != kMajor)
    refuse(kRuleMajor, name,
           "version " + std::to_string(head.major) + " of the log format; this program reads " +
               std::to_string(kMajor) + ": use the release that recorded it");
  if (crc_of(&head, offsetof(FileHead, head_crc)) != head.head_crc)
    refuse(kRuleHeadCrc, name, "its head is damaged; take another copy of it");
  if (head.reserved != 0) refuse(kRuleReserved, name, "a reserved word of its head is not 0");
  if (head.record_bytes == 0 || head.record_bytes > kMaxRecordBytes || head.record_bytes % 4 != 0)
    refuse(kRuleRecordBytes, name,
           "records of " + std::to_string(head.record_bytes) + " bytes: 4 to " +
               std::to_string(kMaxRecordBytes) + " in steps of 4 are possible");
  if (head.text_bytes > kMaxTextBytes || head.text_bytes > source.size() - sizeof head)
    refuse(kRuleTextCut, name, "cut off inside its head; record the run again");
  text.resize(head.text_bytes);
  if (!source.read(sizeof head, text.data(), text.size()) ||
      crc_of(text.data(), text.size()) != head.text_crc)
    refuse(kRuleTextCrc, name, "the text of its head is damaged; take another copy of it");
  return head;
}

}  // namespace

Reader::Reader(std::unique_ptr<Source> source, const std::string& name)
    : source_(std::move(source)) {
  std::string text;
  const FileHead head = read_head(*source_, name, text);
  const std::string wrong = parse(text, head.record_bytes, header_);
  if (!wrong.empty()) refuse(kRuleLine, name, wrong);
  if (place(header_.fields) != head.record_bytes)
    refuse(kRuleFields, name, "its fields do not add up to a record");
  const Field& first = header_.fields.front();
  if (first.name != "number" || first.type != Type::kU32 || first.count != 1)
    refuse(kRuleNumber, name, "its records do not begin with their number");
  log_ = previous_crc_ = head.head_crc;
  at_ = sizeof head + text.size();
}

// What stands at `at`: result false, and the rule, where it is no block that may follow here.
bool Reader::look(uint64_t at, BlockHead& head, uint32_t& rule) {
  const auto refused = [&](uint32_t by) {
    rule = by;
    return false;
  };
  if (source_->size() - at < sizeof head || !source_->read(at, &head, sizeof head))
    return refused(kRuleCut);
  if (head.magic != kBlockMagic || crc_of(&head, offsetof(BlockHead, head_crc)) != head.head_crc)
    return refused(kRuleNoBlock);
  if (head.log != log_) return refused(kRuleOtherLog);
  for (const uint32_t reserved : head.reserved)
    if (reserved != 0) return refused(kRuleBlockReserved);
  if (head.kind != kRecordsBlock && head.kind != kEndBlock) return refused(kRuleKind);
  const uint64_t each = head.kind == kEndBlock ? sizeof(IndexEntry) : header_.record_bytes;
  if (head.payload_bytes != head.count * each || head.payload_bytes > kMaxPayloadBytes ||
      (head.kind == kRecordsBlock && head.count == 0))
    return refused(kRuleLength);
  if (head.sequence < next_sequence_) return refused(kRuleSequence);
  if (head.sequence == next_sequence_ && head.previous_crc != previous_crc_)
    return refused(kRuleChain);
  if (head.payload_bytes > source_->size() - at - sizeof head) return refused(kRuleCut);
  return true;
}

// Result: the rule that refuses it; 0 for none.
uint32_t Reader::check_payload(const BlockHead& head, const std::vector<uint8_t>& payload) const {
  if (crc_of(payload.data(), payload.size()) != head.payload_crc) return kRulePayloadCrc;
  if (head.kind == kEndBlock) return check_end(head, payload);
  if (word(payload.data(), 0) != static_cast<uint32_t>(head.first_number)) return kRuleNumbers;
  if (records_ > 0 && head.first_number < next_number_) return kRuleNumbers;
  for (uint32_t i = 1; i < head.count; ++i) {
    const uint32_t step = word(payload.data(), i * header_.record_bytes) -
                          word(payload.data(), (i - 1) * header_.record_bytes);
    if (step == 0 || step > UINT32_MAX / 2) return kRuleNumbers;
  }
  // Between two blocks that follow each other, all that is missing was dropped.
  const uint64_t before =
      records_ > 0 ? missing_between(next_number_, head.first_number, header_.decimation) : 0;
  if (head.sequence == next_sequence_ ? head.missing != dropped_ + before
                                      : head.missing < dropped_ || head.missing > dropped_ + before)
    return records_ > 0 || head.sequence == next_sequence_ ? kRuleMissing : 0;
  return 0;
}

uint32_t Reader::check_end(const BlockHead& head, const std::vector<uint8_t>& payload) const {
  if (head.missing < dropped_ || head.first_number < next_number_) return kRuleMissing;
  // Every block that was read must stand in the index, and those that were not are lost.
  size_t next = 0;
  for (uint32_t i = 0; i < head.count; ++i) {
    IndexEntry entry;
    std::memcpy(&entry, payload.data() + i * sizeof entry, sizeof entry);
    if (next < seen_.size() && entry.sequence == seen_[next].sequence) {
      if (std::memcmp(&entry, &seen_[next], sizeof entry) != 0) return kRuleIndex;
      ++next;
    }
  }
  return next == seen_.size() && head.count == head.sequence ? 0 : kRuleIndex;
}

void Reader::take(const BlockHead& head, Block& block) {
  block.offset = at_;
  block.first_number = head.first_number;
  block.missing = head.missing;
  block.sequence = head.sequence;
  block.count = head.count;
  block.record_bytes = header_.record_bytes;
  if (records_ > 0) {
    const uint64_t lost = missing_between(next_number_, head.first_number, header_.decimation);
    add_gap(head.first_number, lost, lost - std::min(lost, head.missing - dropped_));
  }
  dropped_ = head.missing;
  uint64_t last = head.first_number;
  for (uint32_t i = 1; i < head.count; ++i) {
    const uint32_t number = word(block.record(i), 0);
    const uint64_t here = last + (number - static_cast<uint32_t>(last));
    const uint64_t lost = missing_between(last + header_.decimation, here, header_.decimation);
    add_gap(here, lost, 0);
    dropped_ += lost;
    last = here;
  }
  next_number_ = last + header_.decimation;
  records_ += head.count;
  ++blocks_;
  seen_.push_back({at_, head.first_number, head.count, head.sequence});
}

void Reader::close(const BlockHead& head) {
  if (records_ > 0) {
    const uint64_t lost = missing_between(next_number_, head.first_number, header_.decimation);
    add_gap(head.first_number, lost, lost - std::min(lost, head.missing - dropped_));
  }
  is_closed_ = is_at_end_ = true;
  const uint64_t end = at_ + sizeof head + head.payload_bytes;
  Tail tail{};
  const bool has_tail = source_->size() == end + sizeof tail &&
                        source_->read(end, &tail, sizeof tail) && tail.magic == kTailMagic &&
                        tail.end_offset == at_ && crc_of(&tail, offsetof(Tail, crc)) == tail.crc;
  if (!has_tail) add_damage(end, source_->size(), kRuleTail);
}

void Reader::add_gap(uint64_t number, uint64_t count, uint64_t of_blocks) {
  missing_ += count;
  if (count > 0 && gaps_.size() < kMaxGaps) gaps_.push_back({number, count, of_blocks});
}

void Reader::add_damage(uint64_t from, uint64_t to, uint32_t rule) {
  damage_.push_back({from, to - from, rule});
}

// The next place at or behind `from` where a block's magic stands; the file's end where there is
// none.
uint64_t Reader::find_block(uint64_t from) {
  uint8_t magic[4];
  std::memcpy(magic, &kBlockMagic, sizeof magic);
  std::vector<uint8_t> bytes;
  while (source_->size() >= sizeof magic && from <= source_->size() - sizeof magic) {
    bytes.resize(std::min(kSearchBytes, source_->size() - from));
    if (!source_->read(from, bytes.data(), bytes.size())) break;
    const auto found = std::search(bytes.begin(), bytes.end(), magic, magic + sizeof magic);
    if (found != bytes.end()) return from + static_cast<uint64_t>(found - bytes.begin());
    from += bytes.size() - (sizeof magic - 1);
  }
  return source_->size();
}

bool Reader::next(Block& block) {
  uint64_t damaged_from = at_;
  uint32_t first_rule = 0;
  while (!is_at_end_ && at_ < source_->size()) {
    BlockHead head{};
    uint32_t rule = 0;
    uint64_t behind = at_ + 1;
    if (look(at_, head, rule)) {
      block.payload.resize(head.payload_bytes);
      if (!source_->read(at_ + sizeof head, block.payload.data(), head.payload_bytes)) {
        rule = kRuleCut;
      } else {
        rule = check_payload(head, block.payload);
      }
      // The head is whole, so its length is to be trusted: no search inside this block.
      behind = at_ + sizeof head + head.payload_bytes;
    }
    if (rule == 0) {
      if (damaged_from < at_) add_damage(damaged_from, at_, first_rule);
      if (head.kind == kRecordsBlock) take(head, block);
      if (head.kind == kEndBlock) close(head);
      previous_crc_ = head.head_crc;
      next_sequence_ = head.sequence + 1;
      at_ = behind;
      if (head.kind == kRecordsBlock) return true;
      return false;
    }
    if (first_rule == 0) first_rule = rule;
    at_ = find_block(behind);
  }
  if (!is_at_end_ && damaged_from < source_->size()) {
    // Zeros alone were put aside by the recorder and never written.
    bool is_empty = true;
    std::vector<uint8_t> bytes;
    for (uint64_t at = damaged_from; is_empty && at < source_->size(); at += bytes.size()) {
      bytes.resize(std::min(kSearchBytes, source_->size() - at));
      if (!source_->read(at, bytes.data(), bytes.size())) break;
      is_empty = std::all_of(bytes.begin(), bytes.end(), [](uint8_t b) { return b == 0; });
    }
    if (!is_empty) add_damage(damaged_from, source_->size(), first_rule);
  }
  is_at_end_ = true;
  return false;
}

std::string Reader::troubles() const {
  std::string text;
  uint64_t bytes = 0, lost = 0;
  for (const Damage& damage : damage_) bytes += damage.bytes;
  for (const Gap& gap : gaps_) lost += gap.of_blocks;
  if (!damage_.empty())
    text += "damaged in " + std::to_string(damage_.size()) +
            (damage_.size() == 1 ? " place, at byte " : " places, the first at byte ") +
            std::to_string(damage_[0].offset) + " (rule L" + std::to_string(damage_[0].rule) +
            "), " + std::to_string(bytes) + " bytes and " + std::to_string(lost) +
            " records between whole blocks lost";
  if (!is_closed_)
    text += std::string(text.empty() ? "" : "; ") + "it was not closed: cut off behind record " +
            std::to_string(records_ == 0 ? 0 : next_number_ - header_.decimation);
  return text;
}

void read_through(Reader& reader) {
  Block block;
  while (reader.next(block)) {
  }
}

}  // namespace firmtouch::log
