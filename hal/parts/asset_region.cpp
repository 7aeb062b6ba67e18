#include "parts/asset_region.hpp"

#include "firmtouch/hal/board.hpp"

extern "C" {
extern const uint8_t __firmtouch_asset_begin[], __firmtouch_asset_end[];
extern const uint8_t __firmtouch_asset_slot[], __firmtouch_asset_slot_end[];
}

namespace firmtouch::hal {
namespace {

core::Bytes between(const uint8_t* begin, const uint8_t* end) {
  return {begin, static_cast<uint32_t>(reinterpret_cast<uintptr_t>(end) -
                                       reinterpret_cast<uintptr_t>(begin))};
}

}  // namespace

core::Bytes linked_or_loaded_asset() {
  const core::Bytes linked = between(__firmtouch_asset_begin, __firmtouch_asset_end);
  return linked.empty() ? between(__firmtouch_asset_slot, __firmtouch_asset_slot_end) : linked;
}

}  // namespace firmtouch::hal
