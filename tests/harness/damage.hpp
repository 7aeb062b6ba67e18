#pragma once
#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "harness/long.hpp"
#include "harness/test.hpp"
#include "surface/random.hpp"

namespace firmtouch::test {

/// A copy with up to six edits: a byte becomes any byte or a letter of model files, or bytes are
/// removed or repeated.
inline std::string damaged(std::string bytes, tools::Random& random) {
  constexpr char kLetters[] = "0123456789-.,:;+eEHD/{}[]\"<> \n";
  for (uint32_t edits = 1 + random.below(6); edits > 0 && !bytes.empty(); --edits) {
    const uint32_t size = static_cast<uint32_t>(bytes.size()), at = random.below(size);
    const uint32_t length = std::min(1 + random.below(12), size - at);
    switch (random.below(4)) {
      case 0:
        bytes[at] = static_cast<char>(random.below(256));
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(at, bytes, at, length);
        break;
      default:
        bytes[at] = kLetters[random.below(sizeof kLetters - 1)];
        break;
    }
  }
  return bytes;
}

/// Damaged copies of `files`, in turn, to one reader: 1,000 of them, or 100,000 with
/// `tools/test --long`, each read in less than 10 s. `survive` checks what the reader makes of one.
template <class Survive>
void attack(const std::vector<std::string>& files, const Survive& survive) {
  using Clock = std::chrono::steady_clock;
  for (uint64_t seed = 1; seed <= (is_long() ? 100000u : 1000u); ++seed) {
    note("seed", static_cast<int64_t>(seed));
    tools::Random random(seed);
    const std::string bytes = damaged(files[seed % files.size()], random);
    const Clock::time_point began = Clock::now();
    survive(bytes);
    CHECK_LT(std::chrono::duration<double>(Clock::now() - began).count(), 10.0);
  }
}

}  // namespace firmtouch::test
