// The hashes by which opening compares sets of faces: no two sets have equal sums by structure.
#include <set>

#include "firmtouch/hull/face_hash.hpp"
#include "harness/test.hpp"

namespace hull = firmtouch::hull;

namespace {

uint64_t hash_of(uint32_t a, uint32_t b, uint32_t c) {
  return hull::face_hash(hull::HashedNumber(a), hull::HashedNumber(b), hull::HashedNumber(c));
}
uint64_t side_hash(uint32_t a, uint32_t b) {
  return hull::pair_hash(hull::HashedNumber(a), hull::HashedNumber(b));
}

}  // namespace

TEST(FaceHash_IsTheSameFromEachCornerAndOtherwiseUnique) {
  std::set<uint64_t> seen;
  uint32_t faces = 0;
  for (uint32_t a = 0; a < 40; ++a)
    for (uint32_t b = a + 1; b < 40; ++b)
      for (uint32_t c = a + 1; c < 40; ++c) {
        if (b == c) continue;
        const uint64_t hash = hash_of(a, b, c);
        CHECK(hash == hash_of(b, c, a) && hash == hash_of(c, a, b));
        seen.insert(hash);
        ++faces;
      }
  CHECK_EQ(seen.size(), faces);
}

TEST(FaceHash_NumbersThatDifferInABit_Differ) {
  std::set<uint64_t> seen;
  uint32_t numbers = 0;
  // Each in the second half differs from one in the first by one bit.
  for (uint32_t i = 0; i < 1u << 16; ++i, ++numbers) seen.insert(hull::number_hash(i));
  for (uint32_t i = 0; i < 1u << 16; ++i, ++numbers)
    seen.insert(hull::number_hash((i * 255u) % 65521u + 65536u + (i >> 8 << 16)));
  CHECK_EQ(seen.size(), numbers);
}

TEST(FaceHash_TwoFacesThatExchangeACorner_ChangeTheSum) {
  uint32_t same = 0;
  for (uint32_t a = 0; a < 12; ++a)
    for (uint32_t b = 0; b < 12; ++b)
      for (uint32_t c = 12; c < 24; ++c)
        for (uint32_t d = c + 1; d < 24; ++d) {
          if (a == b) continue;
          const uint64_t as_is = hash_of(100, a, c) + hash_of(200, b, d);
          if (as_is == hash_of(100, a, d) + hash_of(200, b, c)) ++same;
          const uint64_t sides = side_hash(a, c) + side_hash(b, d);
          if (sides == side_hash(a, d) + side_hash(b, c)) ++same;
        }
  CHECK_EQ(same, 0u);
}

// The lattice of two numbers for each corner: half of its faces have all of its sides.
TEST(FaceHash_FacesWithTheSameSides_ChangeTheSum) {
  uint32_t same = 0;
  for (uint32_t first = 0; first < 4096; ++first) {
    uint64_t even = 0, odd = 0;
    for (uint32_t bits = 0; bits < 8; ++bits) {
      const uint32_t x = bits & 1u, y = bits >> 1 & 1u, z = bits >> 2;
      const uint64_t hash = hash_of(first + x, first + 2 + y, first + 4 + z);
      ((x ^ y ^ z) != 0 ? odd : even) += hash;
    }
    if (even == odd) ++same;
  }
  CHECK_EQ(same, 0u);
}

// Grids of faces whose numbers rise evenly, as meshes of patches have, two of them moved.
TEST(FaceHash_TwoFacesOfAGrid_Moved_ChangeTheSum) {
  std::set<uint64_t> sums;
  constexpr uint32_t kMoves = 64;
  for (uint32_t move = 0; move < kMoves; ++move) {
    uint64_t sum = 0;
    for (uint32_t i = 0; i < 400; ++i) {
      const uint32_t a = i + (i == 7 ? move : 0);
      sum += hash_of(a, a + 1, a + 20) + hash_of(a + 1, a + 21, a + 20);
    }
    sums.insert(sum);
  }
  CHECK_EQ(sums.size(), kMoves);
}
