#include "firmtouch/asset/loading.hpp"

namespace firmtouch::asset {

const char* find_name(const Container& asset, uint32_t type, const char* wanted) {
  if (wanted != nullptr) return asset.find(type, wanted).empty() ? nullptr : wanted;
  const uint32_t first = asset.next_of_type(type);
  return first == kNoSection ? nullptr : asset.name(first);
}

}  // namespace firmtouch::asset
