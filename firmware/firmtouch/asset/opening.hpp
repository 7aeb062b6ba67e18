#pragma once
#include <stdint.h>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"

namespace firmtouch::asset {

/// Checks header, table and section CRCs of an asset file in slices, so that a main loop stays
/// responsive: rules R1 to R26 of tools/FORMAT.md. A verdict's element is the section's index in
/// the table (rules of the header: 0).
///
///     Opening opening(file);
///     while (!opening.done()) opening.work(4096);
///     if (opening.verdict().ok()) container = opening.container();
class Opening {
 public:
  /// `file`: exactly the asset's bytes, at an address that is a multiple of 16; it must outlive the
  /// container.
  explicit Opening(core::Bytes file);

  /// Checks about `bytes` more; 0 counts as 1. Table entries and padding are checked as a whole.
  /// Bounds: O(bytes), two table look-ups a byte; no recursion; reads only inside the file.
  void work(uint32_t bytes);
  bool done() const { return stage_ == Stage::kDone; }
  core::Verdict verdict() const { return verdict_; }
  /// The proven file. Result: a closed container unless done() and verdict().ok().
  Container container() const { return done() && verdict_.ok() ? container_ : Container{}; }

 private:
  enum class Stage : uint8_t { kTableCrc, kEntries, kSections, kDone };
  void settle(core::Verdict verdict);
  core::Verdict check_header(core::Bytes file);
  core::Verdict check_entry(uint32_t i);
  core::Verdict check_extent(uint32_t i);
  core::Verdict check_section_end(uint32_t i) const;
  uint32_t work_table_crc(uint32_t bytes);
  uint32_t work_entry();
  uint32_t work_section(uint32_t bytes);

  Container container_;
  core::Verdict verdict_;
  Stage stage_ = Stage::kTableCrc;
  uint32_t index_ = 0;   // of the current entry or section
  uint32_t offset_ = 0;  // bytes of the table or section already in crc_
  uint32_t crc_ = 0;
  uint32_t free_ = 0;  // where the next section must begin
};

/// Checks the whole file in one call.
core::Verdict open(core::Bytes file, Container& container);

}  // namespace firmtouch::asset
