#include "firmtouch/spline/proof/sections.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/spline/layout.hpp"

namespace firmtouch::spline {
namespace {

// What the head says, not yet proven. Curves without lengths make no guide.
bool is_of_kind(const asset::Container& asset, const char* name, bool is_surface) {
  const core::Span<const Head> head = core::as_whole_array<Head>(asset.find(kHeadSection, name));
  if (head.size() != 1 || (head[0].is_surface != 0) != is_surface) return false;
  return is_surface || !asset.find(kArcsSection, name).empty();
}

}  // namespace

const char* find_kind(const asset::Container& asset, const char* wanted, bool is_surface) {
  if (wanted != nullptr) return is_of_kind(asset, wanted, is_surface) ? wanted : nullptr;
  for (uint32_t at = asset.next_of_type(kHeadSection); at != asset::kNoSection;
       at = asset.next_of_type(kHeadSection, at + 1))
    if (is_of_kind(asset, asset.name(at), is_surface)) return asset.name(at);
  return nullptr;
}

}  // namespace firmtouch::spline
