#pragma once
#include <stdint.h>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/query/staged_check.hpp"

namespace firmtouch::asset {

/// What Opening proves of an asset file: header, table and section CRCs, rules R1 to R29 of
/// tools/FORMAT.md. A verdict's element is the section's index in the table (rules of the header:
/// 0).
class Proof {
 public:
  static const query::CheckStage kStages[3];
  /// `file`: exactly the asset's bytes, at an address that is a multiple of 16; it must outlive the
  /// container.
  core::Verdict take(core::Bytes file);
  core::Verdict check_head() const { return core::kPassed; }
  Container view;

 private:
  uint32_t table_bytes() const;
  uint32_t table_pieces() const;
  uint32_t entry_count() const { return view.entries_.size(); }
  uint32_t pieces_and_sections() const;
  core::Verdict check_table(uint32_t first, uint32_t end);
  core::Verdict finish_table();
  core::Verdict finish_entries();
  core::Verdict check_entry(uint32_t i);
  core::Verdict check_extent(uint32_t i);
  core::Verdict check_sections(uint32_t first, uint32_t end);
  uint16_t take_origin(const Entry& entry);

  uint32_t crc_ = 0;      // of the current section's or the table's bytes so far
  uint32_t section_ = 0;  // the current one
  uint32_t free_ = 0;     // where the next section must begin
};

/// Checks an asset file in slices, so that a main loop stays responsive.
using Opening = query::Opening<Proof>;

/// Checks the whole file in one call.
inline core::Verdict open(core::Bytes file, Container& container) {
  return query::open_at_once<Opening>(container, file);
}

}  // namespace firmtouch::asset

extern template class firmtouch::query::Opening<firmtouch::asset::Proof>;
