#pragma once
// What a search that looks ahead takes without a branch, with the variants of math/isa.hpp's kind. For
// the library's own translation units.

#include "firmtouch/math/isa.hpp"

#if defined(__AVX2__) && defined(__x86_64__)
#define FIRMTOUCH_ISA_MOVES 1
#else
#define FIRMTOUCH_ISA_MOVES 0
#endif

namespace firmtouch::math {

/// Keys of two boxes, that of the first in the low half.
constexpr uint64_t keys_of(uint32_t first, uint32_t second) {
  return uint64_t{second} << 32 | first;
}

/// What waits for its turn: the least `what` is the first; the rest goes with it.
struct Waiting {
  uint64_t what, keys;
};
struct WaitingChild {
  uint64_t what, keys, child;
};

static inline void portable_put_in_order(WaitingChild& first, WaitingChild& second) {
  if (!(second.what < first.what)) return;
  const WaitingChild lesser = second;
  second = first;
  first = lesser;
}
static inline void portable_put_nearer_first(uint64_t keys, Waiting& first, Waiting& second) {
  if (!(static_cast<uint32_t>(keys >> 32) < static_cast<uint32_t>(keys))) return;
  const Waiting nearer = second;
  second = first;
  first = nearer;
}
template <class Any>
static inline void portable_replace_beyond(uint64_t last, Any& now, const Any& other) {
  if (now.what > last) now = other;
}

/// Puts the lesser of two first; of equal ones none moves. Where the processor has moves under a
/// condition by these: compilers make branches of it, which no processor could foresee.
static inline void put_in_order(WaitingChild& first, WaitingChild& second) {
#if FIRMTOUCH_ISA_MOVES
  const WaitingChild a = first, b = second;
  __asm__(
      "cmpq %[a], %[b]\n\tcmovbq %[b], %[what]\n\tcmovbq %[b_keys], %[keys]\n\t"
      "cmovbq %[b_child], %[child]\n\tcmovbq %[a], %[later_what]\n\t"
      "cmovbq %[a_keys], %[later_keys]\n\tcmovbq %[a_child], %[later_child]"
      : [what] "+&r"(first.what), [keys] "+&r"(first.keys), [child] "+&r"(first.child),
        [later_what] "+&r"(second.what), [later_keys] "+&r"(second.keys),
        [later_child] "+&r"(second.child)
      : [a] "r"(a.what), [b] "r"(b.what), [a_keys] "r"(a.keys), [b_keys] "r"(b.keys),
        [a_child] "r"(a.child), [b_child] "r"(b.child)
      : "cc");
#else
  portable_put_in_order(first, second);
#endif
}

/// Puts the second first where its key, the high half of `keys`, is less than the first's, the low half. The
/// second is what is left of both, so that fewer registers are taken.
static inline void put_nearer_first(uint64_t keys, Waiting& first, Waiting& second) {
#if FIRMTOUCH_ISA_MOVES
  const uint64_t either_what = first.what ^ second.what, either_keys = first.keys ^ second.keys;
  __asm__("cmpl %k[low], %k[high]\n\tcmovbq %[b], %[what]\n\tcmovbq %[b_keys], %[keys]"
          : [what] "+r"(first.what), [keys] "+r"(first.keys)
          : [b] "r"(second.what), [b_keys] "r"(second.keys), [low] "r"(keys), [high] "r"(keys >> 32)
          : "cc");
  second = {either_what ^ first.what, either_keys ^ first.keys};
#else
  portable_put_nearer_first(keys, first, second);
#endif
}

/// Where `now` is beyond `last`, `other` takes its place.
static inline void replace_beyond(uint64_t last, Waiting& now, const Waiting& other) {
#if FIRMTOUCH_ISA_MOVES
  __asm__("cmpq %[now], %[last]\n\tcmovbq %[other], %[now]\n\tcmovbq %[other_keys], %[keys]"
          : [now] "+&r"(now.what), [keys] "+&r"(now.keys)
          : [last] "r"(last), [other] "rm"(other.what), [other_keys] "rm"(other.keys)
          : "cc");
#else
  portable_replace_beyond(last, now, other);
#endif
}
static inline void replace_beyond(uint64_t last, WaitingChild& now, const WaitingChild& other) {
#if FIRMTOUCH_ISA_MOVES
  __asm__(
      "cmpq %[now], %[last]\n\tcmovbq %[other], %[now]\n\tcmovbq %[other_keys], %[keys]\n\t"
      "cmovbq %[other_child], %[child]"
      : [now] "+&r"(now.what), [keys] "+&r"(now.keys), [child] "+&r"(now.child)
      : [last] "r"(last), [other] "rm"(other.what), [other_keys] "rm"(other.keys),
        [other_child] "rm"(other.child)
      : "cc");
#else
  portable_replace_beyond(last, now, other);
#endif
}

/// Result: who is next: `nearer`, or where it is beyond `last` what was left last, which is left no more.
/// `farther` is left where it is not beyond. Who is left stands up to `left`, of whom the first is beyond all.
template <class Any>
[[gnu::always_inline]] static inline Any next_of(uint64_t last, Any nearer, const Any& farther,
                                                 Any*& left) {
  const Any left_last = *left;
  left[1] = farther;
  left += farther.what <= last ? 1 : 0;
  left -= nearer.what <= last ? 0 : 1;
  replace_beyond(last, nearer, left_last);
  return nearer;
}

/// Keys of twice two boxes that lie one behind the other: box_distance2() of each.
static inline void portable_family_distances2(const uint32_t* ones, const uint32_t* others,
                                              const BoxPoint& point, uint64_t& one_keys,
                                              uint64_t& other_keys) {
  one_keys = keys_of(box_distance2(ones, point), box_distance2(ones + 4, point));
  other_keys = keys_of(box_distance2(others, point), box_distance2(others + 4, point));
}
static inline void family_distances2(const uint32_t* ones, const uint32_t* others,
                                     const BoxPoint& point, uint64_t& one_keys,
                                     uint64_t& other_keys) {
#if FIRMTOUCH_ISA_MOVES
  const auto squares = [&](const uint32_t* boxes) {
    const __m256i words = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(boxes));
    const __m256i gaps = _mm256_subs_epu16(words, _mm256_broadcastsi128_si256(point.words));
    return _mm256_madd_epi16(gaps, gaps);
  };
  const __m256i a = squares(ones), b = squares(others);
  const __m256i xz = _mm256_add_epi32(_mm256_unpacklo_epi32(a, b), _mm256_unpackhi_epi32(a, b));
  const __m256i sums = _mm256_add_epi32(xz, _mm256_shuffle_epi32(xz, 0x4E));
  const __m128i keys =
      _mm_unpacklo_epi32(_mm256_castsi256_si128(sums), _mm256_extracti128_si256(sums, 1));
  one_keys = static_cast<uint64_t>(_mm_cvtsi128_si64(keys));
  other_keys = static_cast<uint64_t>(_mm_extract_epi64(keys, 1));
#else
  portable_family_distances2(ones, others, point, one_keys, other_keys);
#endif
}

/// Of three pairs of boxes, of which the second and third lie one behind the other: bit k where the first
/// of pair k is nearer than `below`, bit 4 + k where the second is. Others may be set too.
static inline uint32_t portable_boxes_below(const uint32_t* pair, const uint32_t* pairs,
                                            const BoxPoint& point, uint32_t below) {
  uint32_t are = 0;
  for (uint32_t k = 0; k < 6; ++k) {
    const uint32_t* const box = k < 2 ? pair + 4 * k : pairs + 4 * (k - 2);
    are |= box_distance2(box, point) < below ? 1u << (k / 2 + 4 * (k % 2)) : 0u;
  }
  return are;
}
static inline uint32_t boxes_below(const uint32_t* pair, const uint32_t* pairs,
                                   const BoxPoint& point, uint32_t below) {
#if FIRMTOUCH_ISA_MOVES
  const __m256i at = _mm256_broadcastsi128_si256(point.words);
  const auto squares = [at](const uint32_t* boxes) {
    const __m256i words = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(boxes));
    const __m256i gaps = _mm256_subs_epu16(words, at);
    return _mm256_madd_epi16(gaps, gaps);
  };
  const __m256i a = squares(pair), b = squares(pairs), c = squares(pairs + 8);
  // a0 b0 a1 b1, so too c: then a0 + a2, b0 + b2, ...
  const __m256i ab = _mm256_add_epi32(_mm256_unpacklo_epi32(a, b), _mm256_unpackhi_epi32(a, b));
  const __m256i cc = _mm256_add_epi32(_mm256_unpacklo_epi32(c, c), _mm256_unpackhi_epi32(c, c));
  const __m256i sums =
      _mm256_add_epi32(_mm256_unpacklo_epi64(ab, cc), _mm256_unpackhi_epi64(ab, cc));
  // By halves: a b c c.
  const __m256i least = _mm256_max_epu32(sums, _mm256_set1_epi32(static_cast<int32_t>(below)));
  const uint32_t beyond = static_cast<uint32_t>(
      _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpeq_epi32(least, sums))));
  return ~beyond;
#else
  return portable_boxes_below(pair, pairs, point, below);
#endif
}

}  // namespace firmtouch::math
