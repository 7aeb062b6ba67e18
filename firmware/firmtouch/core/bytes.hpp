#pragma once
#include <stddef.h>
#include <stdint.h>

#include "firmtouch/core/span.hpp"

namespace firmtouch::core {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "an asset is used in place: little-endian targets only");

/// The one place where bytes become structs. A span of `count` T at the start of `bytes`, or an
/// empty one where the bytes are too few or not aligned for T. T is a plain struct of the asset
/// format, whose every bit pattern is a value.
template <class T>
Span<const T> as_array(Bytes bytes, uint32_t count) {
  static_assert(__is_trivially_copyable(T), "only plain structs live in an asset");
  if (bytes.size() / sizeof(T) < count) return {};
  if (reinterpret_cast<uintptr_t>(bytes.data()) % alignof(T) != 0) return {};
  return {reinterpret_cast<const T*>(bytes.data()), count};
}

/// As many whole T as `bytes` holds; empty where a part of a T would be left over.
template <class T>
Span<const T> as_whole_array(Bytes bytes) {
  if (bytes.size() % sizeof(T) != 0) return {};
  return as_array<T>(bytes, static_cast<uint32_t>(bytes.size() / sizeof(T)));
}

}  // namespace firmtouch::core
