#pragma once
#include <stdint.h>

namespace firmtouch::core {

/// Non-owning view of `count` elements. Indexing is unchecked: open() proves all indices once.
template <class T>
class Span {
 public:
  constexpr Span() = default;
  constexpr Span(T* data, uint32_t count) : data_(data), count_(count) {}
  template <uint32_t N>
  constexpr Span(T (&array)[N]) : data_(array), count_(N) {}  // NOLINT(google-explicit-constructor)

  constexpr T* data() const { return data_; }
  constexpr uint32_t size() const { return count_; }
  constexpr bool empty() const { return count_ == 0; }
  constexpr T& operator[](uint32_t i) const { return data_[i]; }
  constexpr T* begin() const { return data_; }
  constexpr T* end() const { return data_ + count_; }

 private:
  T* data_ = nullptr;
  uint32_t count_ = 0;
};

using Bytes = Span<const uint8_t>;

}  // namespace firmtouch::core
