#pragma once
#include <stdint.h>

// Hashes whose sums compare two sets without memory. For the library's own translation units.
//
// They are no defence against an attacker, and need none against damage, which the CRC detects.
// They detect the faulty baker: a face lost, replaced twice or turned round.
//
// Hashes are products modulo 2^64 of functions of the numbers. Two different sets with equal sums
// are a root of a polynomial whose variables are the functions' values, of degree 1 in each. If
// these were random, at most one choice in 2^30 would be a root (Schwartz 1980, Zippel 1979). They
// are chosen before any asset is made. By their structure alone they must have no roots, so they
// are not linear, not even without carries: tests/hull/face_hash_host_test.cpp.

namespace firmtouch::hull {

/// A number and two functions of it: as the first of two, and as the second. Neither has a value
/// twice, nor zero for a number below 2^24. An offset without it doubles where `x` does.
/// Source: Appleby 2016, MurmurHash3, the finalizer.
struct HashedNumber {
  uint32_t number, first, second;

  HashedNumber() = default;
  [[gnu::always_inline]] explicit HashedNumber(uint32_t x) : number(x) {
    x = x * 0x85EBCA6Bu + 0x9E3779B9u;
    x = (x ^ x >> 15) * 0xC2B2AE35u;
    first = x ^ x >> 16;
    second = (first ^ first >> 13) * 0x9E3779B1u;
  }
};

/// Of a pair in this order.
static inline uint64_t pair_hash(const HashedNumber& a, const HashedNumber& b) {
  return uint64_t{a.first} * b.second;
}
/// Of a face one corner of which is youngest: from that on.
static inline uint64_t face_hash(const HashedNumber& a, const HashedNumber& b,
                                 const HashedNumber& c) {
  if (a.number > b.number && a.number > c.number) return a.first * pair_hash(b, c);
  return b.number > c.number ? b.first * pair_hash(c, a) : c.first * pair_hash(a, b);
}
/// Of one number.
static inline uint64_t number_hash(uint32_t x) {
  const HashedNumber hashed(x);
  return pair_hash(hashed, hashed);
}

/// Whether the same three stand in the same turn. Pre: the three of `b` differ, or false may come.
static inline bool is_same_face(const uint32_t (&a)[3], const uint32_t (&b)[3]) {
  if (a[0] == b[0]) return a[1] == b[1] && a[2] == b[2];
  if (a[0] == b[1]) return a[1] == b[2] && a[2] == b[0];
  return a[0] == b[2] && a[1] == b[0] && a[2] == b[1];
}

}  // namespace firmtouch::hull
