#pragma once
// Entries of a search's stack, ordered without branches: a mispredicted branch costs more than the
// boxes below it.

#include <stdint.h>

#if defined(__x86_64__)
#define FIRMTOUCH_HAS_CMOV 1
#else
#define FIRMTOUCH_HAS_CMOV 0
#endif

namespace firmtouch::simd {

/// Keys of two boxes, that of the first in the low half.
constexpr uint64_t keys_of(uint32_t first, uint32_t second) {
  return uint64_t{second} << 32 | first;
}

/// A pending node: the lowest `key` is next; the rest belongs to it.
struct Entry {
  uint64_t key, keys;
};
struct ChildEntry {
  uint64_t key, keys, child;
};

static inline void portable_order(ChildEntry& first, ChildEntry& second) {
  if (!(second.key < first.key)) return;
  const ChildEntry lesser = second;
  second = first;
  first = lesser;
}
static inline void portable_put_nearer_first(uint64_t keys, Entry& first, Entry& second) {
  if (!(static_cast<uint32_t>(keys >> 32) < static_cast<uint32_t>(keys))) return;
  const Entry nearer = second;
  second = first;
  first = nearer;
}
template <class Any>
static inline void portable_replace_beyond(uint64_t cutoff, Any& now, const Any& other) {
  if (now.key > cutoff) now = other;
}

/// Puts the entry of the lower key first; equal ones keep their order. By conditional moves:
/// compilers make a branch of it, which no predictor can learn.
static inline void order(ChildEntry& first, ChildEntry& second) {
#if FIRMTOUCH_HAS_CMOV
  const ChildEntry a = first, b = second;
  __asm__(
      "cmpq %[a], %[b]\n\tcmovbq %[b], %[key]\n\tcmovbq %[b_keys], %[keys]\n\t"
      "cmovbq %[b_child], %[child]\n\tcmovbq %[a], %[later_key]\n\t"
      "cmovbq %[a_keys], %[later_keys]\n\tcmovbq %[a_child], %[later_child]"
      : [key] "+&r"(first.key), [keys] "+&r"(first.keys), [child] "+&r"(first.child),
        [later_key] "+&r"(second.key), [later_keys] "+&r"(second.keys),
        [later_child] "+&r"(second.child)
      : [a] "r"(a.key), [b] "r"(b.key), [a_keys] "r"(a.keys), [b_keys] "r"(b.keys),
        [a_child] "r"(a.child), [b_child] "r"(b.child)
      : "cc");
#else
  portable_order(first, second);
#endif
}

/// Puts the second first if its box key, the high half of `keys`, is below the first's, the low
/// half. The second is rebuilt from the exclusive or of both: fewer registers.
static inline void put_nearer_first(uint64_t keys, Entry& first, Entry& second) {
#if FIRMTOUCH_HAS_CMOV
  const uint64_t either_key = first.key ^ second.key, either_keys = first.keys ^ second.keys;
  __asm__("cmpl %k[low], %k[high]\n\tcmovbq %[b], %[key]\n\tcmovbq %[b_keys], %[keys]"
          : [key] "+r"(first.key), [keys] "+r"(first.keys)
          : [b] "r"(second.key), [b_keys] "r"(second.keys), [low] "r"(keys), [high] "r"(keys >> 32)
          : "cc");
  second = {either_key ^ first.key, either_keys ^ first.keys};
#else
  portable_put_nearer_first(keys, first, second);
#endif
}

/// Replaces `now` by `other` if its key is beyond `cutoff`.
static inline void replace_beyond(uint64_t cutoff, Entry& now, const Entry& other) {
#if FIRMTOUCH_HAS_CMOV
  __asm__("cmpq %[now], %[cutoff]\n\tcmovbq %[other], %[now]\n\tcmovbq %[other_keys], %[keys]"
          : [now] "+&r"(now.key), [keys] "+&r"(now.keys)
          : [cutoff] "r"(cutoff), [other] "rm"(other.key), [other_keys] "rm"(other.keys)
          : "cc");
#else
  portable_replace_beyond(cutoff, now, other);
#endif
}
static inline void replace_beyond(uint64_t cutoff, ChildEntry& now, const ChildEntry& other) {
#if FIRMTOUCH_HAS_CMOV
  __asm__(
      "cmpq %[now], %[cutoff]\n\tcmovbq %[other], %[now]\n\tcmovbq %[other_keys], %[keys]\n\t"
      "cmovbq %[other_child], %[child]"
      : [now] "+&r"(now.key), [keys] "+&r"(now.keys), [child] "+&r"(now.child)
      : [cutoff] "r"(cutoff), [other] "rm"(other.key), [other_keys] "rm"(other.keys),
        [other_child] "rm"(other.child)
      : "cc");
#else
  portable_replace_beyond(cutoff, now, other);
#endif
}

/// Returns the next entry: `nearer` if its key is at most `cutoff`, else the popped top of the
/// stack. Pushes `farther` if its key is at most `cutoff`. The bottom of the stack is beyond every
/// cutoff.
template <class Any>
[[gnu::always_inline]] static inline Any next_of(uint64_t cutoff, Any nearer, const Any& farther,
                                                 Any*& top) {
  const Any popped = *top;
  top[1] = farther;
  top += farther.key <= cutoff ? 1 : 0;
  top -= nearer.key <= cutoff ? 0 : 1;
  replace_beyond(cutoff, nearer, popped);
  return nearer;
}

}  // namespace firmtouch::simd
