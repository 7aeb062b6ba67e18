#include <algorithm>

#include "harness/test.hpp"
#include "log/sample_log.hpp"

// Damaged logs: no block is given that was not written, whatever was done to the bytes.
namespace firmtouch::log_test {
namespace {

// Two runs of one controller: their heads differ by when they began, and so do their blocks.
struct Pair {
  Bytes one, other;
  std::vector<log::Block> blocks, other_blocks;
};

Pair make_pair(Random& random) {
  std::vector<std::vector<uint32_t>> numbers[2];
  for (auto& blocks : numbers) {
    uint32_t next = static_cast<uint32_t>(random.below(3));
    for (uint32_t i = 0; i < 3; ++i) {
      blocks.emplace_back();
      for (uint64_t k = 1 + random.below(2); k > 0; --k, next += random.below(4) == 0 ? 2u : 1u)
        blocks.back().push_back(next);
    }
  }
  Pair pair;
  pair.one = log_of(numbers[0], 1, random.below(2) == 0, std::to_string(random.next()));
  pair.other = log_of(numbers[1], 1, random.below(2) == 0, std::to_string(random.next()));
  pair.blocks = read(pair.one).blocks;
  pair.other_blocks = read(pair.other).blocks;
  return pair;
}

void flip(Random& random, Bytes& bytes, uint64_t from) {
  for (uint64_t i = 1 + random.below(16); i > 0; --i)
    bytes[from + random.below(bytes.size() - from)] ^= static_cast<uint8_t>(1u << random.below(8));
}

void erase(Bytes& bytes, uint64_t from, uint64_t count) {
  bytes.erase(bytes.begin() + static_cast<long>(from),
              bytes.begin() + static_cast<long>(from + count));
}

// Flips, a cut, bytes lost, written over or doubled, a piece of the other log.
Bytes damaged(Random& random, const Pair& pair) {
  Bytes bytes = pair.one;
  // Mostly behind the head, whose text refuses the whole log at once.
  const uint64_t from = random.below(16) == 0 ? 0 : first_block(bytes);
  const uint64_t at = from + random.below(bytes.size() - from);
  const uint64_t count = 1 + random.below(bytes.size() - at);
  switch (random.below(6)) {
    case 0:
      flip(random, bytes, from);
      break;
    case 1:
      bytes.resize(at);
      break;
    case 2:
      erase(bytes, at, count);
      break;
    case 3:
      for (uint64_t i = 0; i < count; ++i) bytes[at + i] = static_cast<uint8_t>(random.next());
      break;
    case 4:
      bytes.insert(bytes.begin() + static_cast<long>(at + count),
                   bytes.begin() + static_cast<long>(at),
                   bytes.begin() + static_cast<long>(at + count));
      break;
    default: {
      const uint64_t there = random.below(pair.other.size());
      const uint64_t piece = 1 + random.below(pair.other.size() - there);
      if (random.below(2) == 0) erase(bytes, at, count);
      bytes.insert(bytes.begin() + static_cast<long>(at),
                   pair.other.begin() + static_cast<long>(there),
                   pair.other.begin() + static_cast<long>(there + piece));
    }
  }
  return bytes;
}

// A splice may have replaced this log's head by the other's: then it is that log.
bool is_other(const Bytes& bytes, const Pair& pair) {
  const auto behind_head = static_cast<long>(first_block(pair.other));
  return bytes.size() >= first_block(pair.other) &&
         std::equal(pair.other.begin(), pair.other.begin() + behind_head, bytes.begin());
}

bool was_written(const log::Block& block, const std::vector<log::Block>& blocks) {
  for (const log::Block& one : blocks)
    if (one.sequence == block.sequence && one.first_number == block.first_number &&
        one.missing == block.missing && one.payload == block.payload)
      return true;
  return false;
}

TEST(ADamagedLogGivesNoBlockThatWasNotWritten) {
  const uint64_t tries = is_long() ? 100000000 : 100000;
  Random random(20261121);
  uint64_t wrong = 0, given = 0, refused = 0;
  Pair pair = make_pair(random);
  for (uint64_t i = 0; i < tries; ++i) {
    if (i % 64 == 0) pair = make_pair(random);
    const Bytes bytes = damaged(random, pair);
    const std::vector<log::Block>& written =
        is_other(bytes, pair) ? pair.other_blocks : pair.blocks;
    try {
      log::Reader reader(log::over_memory(bytes), "memory");
      log::Block block;
      while (reader.next(block)) {
        ++given;
        if (!was_written(block, written)) ++wrong;
      }
    } catch (const log::Refused&) {
      ++refused;
    }
  }
  test::note("tries", static_cast<int64_t>(tries));
  CHECK_EQ(wrong, 0u);
  CHECK_GE(given, tries / 2);  // the undamaged neighbours are read
  CHECK_LT(refused, tries / 8);
}

}  // namespace
}  // namespace firmtouch::log_test
