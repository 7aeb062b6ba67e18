#include "firmtouch/scene/stored_name.hpp"

namespace firmtouch::scene {

bool is_name(const char (&name)[kNameBytes]) {
  uint32_t length = 0;
  for (; length < kNameBytes && name[length] != 0; ++length) {
    const auto byte = static_cast<uint8_t>(name[length]);
    if (byte < 0x20 || byte == 0x7F) return false;
  }
  if (length == 0 || length == kNameBytes) return false;
  for (uint32_t i = length; i < kNameBytes; ++i)
    if (name[i] != 0) return false;
  return true;
}

bool is_same_name(const char (&a)[kNameBytes], const char (&b)[kNameBytes]) {
  for (uint32_t i = 0; i < kNameBytes; ++i)
    if (a[i] != b[i]) return false;
  return true;
}

}  // namespace firmtouch::scene
