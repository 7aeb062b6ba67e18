#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"

namespace firmtouch::core {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "an asset is used in place: little-endian targets only");

/// View of `count` T at the start of `bytes`, without a copy; the only cast from bytes to structs.
/// Pre: T is a plain struct of the asset format; every bit pattern of it is a value.
/// Result: empty if the bytes are too few or not aligned for T.
template <class T>
Span<const T> as_array(Bytes bytes, uint32_t count) {
  static_assert(__is_trivially_copyable(T), "only plain structs live in an asset");
  if (bytes.size() / sizeof(T) < count) return {};
  if (reinterpret_cast<uintptr_t>(bytes.data()) % alignof(T) != 0) return {};
  return {static_cast<const T*>(static_cast<const void*>(bytes.data())), count};
}

/// View of all of `bytes` as T. Result: empty if the size is not a multiple of sizeof(T).
template <class T>
Span<const T> as_whole_array(Bytes bytes) {
  if (bytes.size() % sizeof(T) != 0) return {};
  return as_array<T>(bytes, static_cast<uint32_t>(bytes.size() / sizeof(T)));
}

}  // namespace firmtouch::core
