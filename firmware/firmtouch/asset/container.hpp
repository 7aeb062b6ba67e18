#pragma once
#include <stdint.h>

#include "firmtouch/asset/layout.hpp"
#include "firmtouch/core/span.hpp"

namespace firmtouch::asset {

constexpr uint32_t kNoSection = UINT32_MAX;

/// An asset file whose frame Opening has proven; the sections' contents are for their modules to
/// prove. Immutable; reads nothing but the file's own bytes, which must stay where they are.
/// Resolve names once, at start, never in a tick.
class Container {
 public:
  Container() = default;

  bool is_open() const { return !file_.empty(); }
  uint32_t section_count() const { return entries_.size(); }
  /// Pre: i < section_count().
  uint32_t type(uint32_t i) const { return entries_[i].type; }
  /// Pre: i < section_count(). Result: ends with a zero, lives as long as the file's bytes.
  const char* name(uint32_t i) const { return entries_[i].name; }
  /// Pre: i < section_count().
  core::Bytes section(uint32_t i) const {
    return {file_.data() + entries_[i].offset, entries_[i].bytes};
  }

  /// The bytes of the section (type, name).
  /// Bounds: O(log sections). Result: empty where there is no such section.
  core::Bytes find(uint32_t type, const char* name) const;
  /// The first section of this type at or after index `from`, in the table's order: the way to the
  /// first mesh or curve, whatever its name. Bounds: O(sections). Result: kNoSection where there is
  /// none.
  uint32_t next_of_type(uint32_t type, uint32_t from = 0) const;
  /// How many sections have none of these types: newer than this program, and skipped.
  uint32_t count_unknown(core::Span<const uint32_t> known_types) const;

  core::Bytes bytes() const { return file_; }
  /// One number that tells assets apart: the header's CRC, which covers the CRCs of table and
  /// sections.
  uint32_t crc() const;

 private:
  friend class Opening;
  core::Bytes file_;
  core::Span<const Entry> entries_;
};

/// Length of the asset that begins at `region`, which may be longer (memory-mapped flash).
/// Result: 0 where no asset of a known version begins there or it would not fit.
uint32_t stated_bytes(core::Bytes region);

}  // namespace firmtouch::asset
