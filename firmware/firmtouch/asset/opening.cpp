#include "firmtouch/asset/opening.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/core/crc32.hpp"

namespace firmtouch::asset {
namespace {

using core::kPassed;
using core::reject;
using core::Verdict;

constexpr uint32_t kPieceBytes = 256;
static_assert(kPieceBytes % kAlignment == 0);

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

using Stage = query::StageOf<Proof>;

}  // namespace

// CRCs are continued by pieces of a multiple of the alignment.
const query::CheckStage Proof::kStages[3] = {
    Stage::of<&Proof::table_pieces, &Proof::check_table, &Proof::finish_table>(8),
    Stage::of<&Proof::entry_count, &Proof::check_entry, &Proof::finish_entries>(10),
    Stage::of<&Proof::pieces_and_sections, &Proof::check_sections>(10)};

Verdict Proof::take(core::Bytes file) {
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
  view.file_ = file;
  view.entries_ = core::as_array<Entry>(slice(file, sizeof(Header), rest), header.section_count);
  free_ = static_cast<uint32_t>(sizeof(Header) + header.section_count * sizeof(Entry));
  return kPassed;
}

Verdict Proof::check_entry(uint32_t i) {
  const Entry& entry = view.entries_[i];
  const Verdict name = check_name(entry.name, i);
  if (!name.ok()) return name;
  if (i > 0) {
    const int order = compare(view.entries_[i - 1], entry);
    if (order > 0) return reject(kRuleEntryOrder, i);
    if (order == 0) return reject(kRuleEntryTwice, i);
  }
  return check_extent(i);
}

// Sections fill the file in the table's order, so one running end proves that none overlaps
// another.
Verdict Proof::check_extent(uint32_t i) {
  const Entry& entry = view.entries_[i];
  const uint32_t total = view.file_.size();
  if (entry.bytes == 0) return reject(kRuleSectionEmpty, i);
  if (entry.offset % kAlignment != 0) return reject(kRuleSectionAlignment, i);
  if (entry.offset < free_) return reject(kRuleSectionOverlap, i);
  if (entry.offset > free_) return reject(kRuleSectionGap, i);
  if (entry.bytes > total - free_) return reject(kRuleSectionOutside, i);
  // At most the total, which is a multiple of the alignment: rounding up cannot overflow or pass
  // it.
  free_ += entry.bytes;
  free_ += (kAlignment - free_ % kAlignment) % kAlignment;
  const uint16_t rule = entry.type == kOriginSection ? take_origin(entry) : uint16_t{0};
  return {rule, i};
}

// Pre: the section lies in the file.
uint16_t Proof::take_origin(const Entry& entry) {
  if (entry.bytes != 3 * sizeof(float)) return kRuleOriginSize;
  if (view.origin_m_ != nullptr) return kRuleSecondOrigin;
  const float* const at_m =
      core::as_array<float>(slice(view.file_, entry.offset, entry.bytes), 3).data();
  view.origin_m_ = at_m;
  const float sum_m =
      __builtin_fabsf(at_m[0]) + __builtin_fabsf(at_m[1]) + __builtin_fabsf(at_m[2]);
  return sum_m <= kMaxOrigin_m ? 0 : kRuleOriginValue;
}

uint32_t Proof::table_bytes() const {
  return static_cast<uint32_t>(view.entries_.size() * sizeof(Entry));
}
uint32_t Proof::table_pieces() const { return (table_bytes() + kPieceBytes - 1) / kPieceBytes; }
uint32_t Proof::pieces_and_sections() const {
  return view.file_.size() / kPieceBytes + 1 + view.entries_.size();
}

Verdict Proof::check_table(uint32_t first, uint32_t end) {
  const uint32_t from = first * kPieceBytes, to = min(end * kPieceBytes, table_bytes());
  crc_ =
      core::crc32(slice(view.file_, static_cast<uint32_t>(sizeof(Header)) + from, to - from), crc_);
  return kPassed;
}

Verdict Proof::finish_table() {
  const Header& header = core::as_array<Header>(view.file_, 1)[0];
  if (crc_ != header.table_crc) return reject(kRuleTableCrc);
  crc_ = 0;
  return kPassed;
}

Verdict Proof::finish_entries() {
  if (free_ != view.file_.size()) return reject(kRuleTrailingBytes, view.entries_.size());
  free_ = static_cast<uint32_t>(sizeof(Header)) + table_bytes();
  return kPassed;
}

// A unit is a piece of the file, or a section. free_ is now where the unchecked rest begins.
Verdict Proof::check_sections(uint32_t, uint32_t end) {
  while (section_ < view.entries_.size()) {
    const uint32_t done = free_ / kPieceBytes + section_;
    if (done >= end) break;
    const Entry& entry = view.entries_[section_];
    const uint32_t behind = entry.offset + entry.bytes;
    const bool is_last = (behind - free_) / kPieceBytes < end - done;
    const uint32_t to = is_last ? behind : free_ + (end - done) * kPieceBytes;
    crc_ = core::crc32(slice(view.file_, free_, to - free_), crc_);
    free_ = to;
    if (!is_last) break;
    if (crc_ != entry.crc) return reject(kRuleSectionCrc, section_);
    for (; free_ % kAlignment != 0; ++free_)
      if (view.file_.data()[free_] != 0) return reject(kRuleSectionPadding, section_);
    ++section_;
    crc_ = 0;
  }
  return kPassed;
}

}  // namespace firmtouch::asset

template class firmtouch::query::Opening<firmtouch::asset::Proof>;
