#pragma once
#include <stdint.h>

#include "firmtouch/asset/layout.hpp"
#include "firmtouch/core/span.hpp"
#include "firmtouch/math/vec3.hpp"

namespace firmtouch::asset {

constexpr uint32_t kNoSection = UINT32_MAX;

/// A proven asset file: header, table and section CRCs. The modules prove their own sections.
/// Immutable; reads the file in place, so its bytes must not move or change.
/// Resolve names once, at start, never in a tick.
class Container {
 public:
  Container() = default;

  bool is_open() const { return !file_.empty(); }
  uint32_t section_count() const { return entries_.size(); }
  /// Pre: i < section_count().
  uint32_t type(uint32_t i) const { return entries_[i].type; }
  /// Pre: i < section_count(). Result: zero-terminated; valid as long as the file's bytes.
  const char* name(uint32_t i) const { return entries_[i].name; }
  /// Pre: i < section_count().
  core::Bytes section(uint32_t i) const {
    return {file_.data() + entries_[i].offset, entries_[i].bytes};
  }

  /// The bytes of the section (type, name).
  /// Bounds: O(log sections). Result: empty if there is no such section.
  core::Bytes find(uint32_t type, const char* name) const;
  /// Index of the first section of this type at or after `from`, in the table's order.
  /// Bounds: O(sections). Result: kNoSection if there is none.
  uint32_t next_of_type(uint32_t type, uint32_t from = 0) const;

  /// What the coordinates of all geometries count from, in those of their files: add it to an
  /// object's place. 0 where the asset has none.
  math::Vec3 origin_m() const {
    return origin_m_ == nullptr ? math::Vec3{}
                                : math::Vec3{origin_m_[0], origin_m_[1], origin_m_[2]};
  }
  core::Bytes bytes() const { return file_; }
  /// Identity of the asset: the header's CRC, which covers the CRCs of table and sections.
  uint32_t crc() const;

 private:
  friend class Proof;
  core::Bytes file_;
  core::Span<const Entry> entries_;
  const float* origin_m_ = nullptr;
};

/// Length of the asset at the start of `region`, which may be longer (memory-mapped flash).
/// Result: 0 if no asset of a known version starts there, or if it does not fit.
uint32_t stated_bytes(core::Bytes region);

}  // namespace firmtouch::asset
