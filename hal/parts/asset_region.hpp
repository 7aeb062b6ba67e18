#pragma once
#include "firmtouch/core/span.hpp"

namespace firmtouch::hal {

/// The asset that was linked into the image (section .firmtouch_asset). If there is none: the whole
/// slot for a flashed one, __firmtouch_asset_slot to the end of the board's ASSET memory.
core::Bytes linked_or_loaded_asset();

}  // namespace firmtouch::hal
