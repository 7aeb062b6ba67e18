#include "firmtouch/asset/container.hpp"

#include "firmtouch/core/bytes.hpp"

namespace firmtouch::asset {
namespace {

// Result: <0, 0 or >0, as strcmp. `a`: an entry's name, proven to be zero-terminated.
int compare(const char* a, const char* b) {
  for (uint32_t i = 0; i < kNameBytes; ++i) {
    const int left = static_cast<unsigned char>(a[i]);
    const int right = static_cast<unsigned char>(b[i]);
    if (left != right || left == 0) return left - right;
  }
  return 1;
}

}  // namespace

core::Bytes Container::find(uint32_t type, const char* name) const {
  uint32_t low = 0;
  uint32_t high = entries_.size();
  while (low < high) {
    const uint32_t middle = low + (high - low) / 2;
    const int order = compare(entries_[middle].name, name);
    if (order == 0 && entries_[middle].type == type) return section(middle);
    if (order < 0 || (order == 0 && entries_[middle].type < type)) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return {};
}

uint32_t Container::next_of_type(uint32_t type, uint32_t from) const {
  for (uint32_t i = from; i < entries_.size(); ++i) {
    if (entries_[i].type == type) return i;
  }
  return kNoSection;
}

uint32_t Container::crc() const {
  const core::Span<const Header> header = core::as_array<Header>(file_, 1);
  return header.empty() ? 0 : header[0].header_crc;
}

uint32_t stated_bytes(core::Bytes region) {
  const core::Span<const Header> header = core::as_array<Header>(region, 1);
  if (header.empty() || header[0].magic != kMagic || header[0].major != kMajor) return 0;
  return header[0].total_bytes <= region.size() ? header[0].total_bytes : 0;
}

}  // namespace firmtouch::asset
