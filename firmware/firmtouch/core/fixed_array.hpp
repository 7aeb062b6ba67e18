#pragma once
#include <stdint.h>

namespace firmtouch::core {

/// Up to `Capacity` values in place. push() beyond the capacity is refused, never an overrun.
template <class T, uint32_t Capacity>
class FixedArray {
 public:
  static constexpr uint32_t kCapacity = Capacity;

  bool push(const T& value) {
    if (count_ >= Capacity) return false;
    items_[count_++] = value;
    return true;
  }
  void clear() { count_ = 0; }
  uint32_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  T& operator[](uint32_t i) { return items_[i]; }
  const T& operator[](uint32_t i) const { return items_[i]; }
  const T* begin() const { return items_; }
  const T* end() const { return items_ + count_; }

 private:
  T items_[Capacity]{};
  uint32_t count_ = 0;
};

}  // namespace firmtouch::core
