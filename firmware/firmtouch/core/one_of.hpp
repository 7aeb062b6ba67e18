#pragma once
#include <stddef.h>

namespace firmtouch::core {

/// Memory for one object at a time, of one of several types: the states of proofs that run in turn.
/// Nothing is destroyed: the types are plain values.
template <class... Ts>
class OneOf {
  static_assert((__is_trivially_copyable(Ts) && ...), "nothing is destroyed here");

 public:
  /// Replaces the held value by a new T, constructed in place without a copy on the stack.
  template <class T, class... Arguments>
  T& begin(const Arguments&... arguments) {
    static_assert(sizeof(T) <= kBytes, "T is not of this memory");
    return (new (static_cast<void*>(bytes_)) Held<T>{T(arguments...)})->value;
  }
  /// Pre: the last begin() was of a T.
  template <class T>
  T& get() {
    return static_cast<Held<T>*>(static_cast<void*>(bytes_))->value;
  }

 private:
  // Its own placement new: <new> is not freestanding everywhere.
  template <class T>
  struct Held {
    T value;
    static void* operator new(size_t, void* at) { return at; }
    static void operator delete(void*, void*) {}
    static void operator delete(void*) {}
  };
  static constexpr size_t max_of(const size_t (&values)[sizeof...(Ts)]) {
    size_t most = 0;
    for (const size_t value : values) most = value > most ? value : most;
    return most;
  }
  static constexpr size_t kBytes = max_of({sizeof(Ts)...});

  alignas(Ts...) unsigned char bytes_[kBytes];
};

}  // namespace firmtouch::core
