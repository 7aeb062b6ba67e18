#include "firmtouch/asset/opening.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/core/crc32.hpp"

namespace firmtouch::asset {
namespace {

using core::kPassed;
using core::reject;
using core::Verdict;

uint32_t min(uint32_t a, uint32_t b) { return a < b ? a : b; }

core::Bytes slice(core::Bytes bytes, uint32_t offset, uint32_t count) {
  return {bytes.data() + offset, count};
}

Verdict check_name(const char (&name)[kNameBytes], uint32_t i) {
  if (name[0] == 0) return reject(kRuleNameEmpty, i);
  uint32_t end = 0;
  while (end < kNameBytes && name[end] != 0) {
    const unsigned char letter = static_cast<unsigned char>(name[end]);
    if (letter < 0x20 || letter == 0x7F) return reject(kRuleNameControl, i);
    ++end;
  }
  if (end == kNameBytes) return reject(kRuleNameEnd, i);
  for (; end < kNameBytes; ++end) {
    if (name[end] != 0) return reject(kRuleNamePadding, i);
  }
  return kPassed;
}

// Names are proven to be padded with zeros, so all bytes may be compared.
int compare(const Entry& a, const Entry& b) {
  for (uint32_t k = 0; k < kNameBytes; ++k) {
    const int left = static_cast<unsigned char>(a.name[k]);
    const int right = static_cast<unsigned char>(b.name[k]);
    if (left != right) return left - right;
  }
  if (a.type == b.type) return 0;
  return a.type < b.type ? -1 : 1;
}

}  // namespace

Opening::Opening(core::Bytes file) {
  const Verdict verdict = check_header(file);
  if (!verdict.ok()) settle(verdict);
}

void Opening::settle(Verdict verdict) {
  verdict_ = verdict;
  stage_ = Stage::kDone;
}

Verdict Opening::check_header(core::Bytes file) {
  if (reinterpret_cast<uintptr_t>(file.data()) % kAlignment != 0) return reject(kRuleAlignment);
  const core::Span<const Header> found = core::as_array<Header>(file, 1);
  if (found.empty()) return reject(kRuleTooShort);
  const Header& header = found[0];
  if (header.magic != kMagic) return reject(kRuleMagic);
  if (header.byte_order != kByteOrder) return reject(kRuleByteOrder);
  if (header.major != kMajor) return reject(kRuleMajor);
  if (core::crc32(slice(file, 0, offsetof(Header, header_crc))) != header.header_crc) {
    return reject(kRuleHeaderCrc);
  }
  if (header.reserved != 0) return reject(kRuleReserved);
  if (header.total_bytes > file.size()) return reject(kRuleTruncated);
  if (header.total_bytes < file.size()) return reject(kRuleExtended);
  if (header.total_bytes % kAlignment != 0) return reject(kRuleTotalBytes);
  const uint32_t rest = header.total_bytes - static_cast<uint32_t>(sizeof(Header));
  if (header.section_count > rest / sizeof(Entry)) return reject(kRuleTableSize);
  container_.file_ = file;
  container_.entries_ =
      core::as_array<Entry>(slice(file, sizeof(Header), rest), header.section_count);
  free_ = static_cast<uint32_t>(sizeof(Header) + header.section_count * sizeof(Entry));
  return kPassed;
}

Verdict Opening::check_entry(uint32_t i) {
  const Entry& entry = container_.entries_[i];
  const Verdict name = check_name(entry.name, i);
  if (!name.ok()) return name;
  if (i > 0) {
    const int order = compare(container_.entries_[i - 1], entry);
    if (order > 0) return reject(kRuleEntryOrder, i);
    if (order == 0) return reject(kRuleEntryTwice, i);
  }
  return check_extent(i);
}

// Sections fill the file in the table's order, so one running end proves that none overlaps
// another.
Verdict Opening::check_extent(uint32_t i) {
  const Entry& entry = container_.entries_[i];
  const uint32_t total = container_.file_.size();
  if (entry.bytes == 0) return reject(kRuleSectionEmpty, i);
  if (entry.offset % kAlignment != 0) return reject(kRuleSectionAlignment, i);
  if (entry.offset < free_) return reject(kRuleSectionOverlap, i);
  if (entry.offset > free_) return reject(kRuleSectionGap, i);
  if (entry.bytes > total - free_) return reject(kRuleSectionOutside, i);
  // At most the total, which is a multiple of the alignment: rounding up cannot overflow or pass
  // it.
  free_ += entry.bytes;
  free_ += (kAlignment - free_ % kAlignment) % kAlignment;
  return kPassed;
}

Verdict Opening::check_section_end(uint32_t i) const {
  const Entry& entry = container_.entries_[i];
  if (crc_ != entry.crc) return reject(kRuleSectionCrc, i);
  const uint8_t* bytes = container_.file_.data();
  for (uint32_t at = entry.offset + entry.bytes; at % kAlignment != 0; ++at) {
    if (bytes[at] != 0) return reject(kRuleSectionPadding, i);
  }
  return kPassed;
}

uint32_t Opening::work_table_crc(uint32_t bytes) {
  const uint32_t table = static_cast<uint32_t>(container_.entries_.size() * sizeof(Entry));
  const uint32_t now = min(bytes, table - offset_);
  crc_ = core::crc32(slice(container_.file_, static_cast<uint32_t>(sizeof(Header)) + offset_, now),
                     crc_);
  offset_ += now;
  if (offset_ == table) {
    const Header& header = core::as_array<Header>(container_.file_, 1)[0];
    if (crc_ != header.table_crc) {
      settle(reject(kRuleTableCrc));
    } else {
      stage_ = Stage::kEntries;
    }
  }
  return now;
}

uint32_t Opening::work_entry() {
  if (index_ == container_.entries_.size()) {
    index_ = offset_ = crc_ = 0;
    stage_ = Stage::kSections;
    if (free_ != container_.file_.size())
      settle(reject(kRuleTrailingBytes, container_.entries_.size()));
    return 0;
  }
  const Verdict verdict = check_entry(index_);
  ++index_;
  if (!verdict.ok()) settle(verdict);
  return sizeof(Entry);
}

uint32_t Opening::work_section(uint32_t bytes) {
  if (index_ == container_.entries_.size()) {
    settle(kPassed);
    return 0;
  }
  const core::Bytes section = container_.section(index_);
  const uint32_t now = min(bytes, section.size() - offset_);
  crc_ = core::crc32(slice(section, offset_, now), crc_);
  offset_ += now;
  if (offset_ == section.size()) {
    const Verdict verdict = check_section_end(index_);
    ++index_;
    offset_ = crc_ = 0;
    if (!verdict.ok()) settle(verdict);
  }
  return now;
}

void Opening::work(uint32_t bytes) {
  uint32_t left = bytes == 0 ? 1 : bytes;
  while (left > 0 && stage_ != Stage::kDone) {
    uint32_t used = 0;
    if (stage_ == Stage::kTableCrc) {
      used = work_table_crc(left);
    } else if (stage_ == Stage::kEntries) {
      used = work_entry();
    } else {
      used = work_section(left);
    }
    left -= min(used, left);
  }
}

Verdict open(core::Bytes file, Container& container) {
  Opening opening(file);
  while (!opening.done()) opening.work(UINT32_MAX);
  container = opening.container();
  return opening.verdict();
}

}  // namespace firmtouch::asset
