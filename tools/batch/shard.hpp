#pragma once
#include <cstdint>
#include <string>

namespace firmtouch::tools {

constexpr uint64_t kMaxRuns = 10'000'000;  // of a batch

/// A part of a batch: every `of`th run, from the `number`th on. "2/8".
struct Shard {
  uint64_t number = 1, of = 1;
  uint64_t runs(uint64_t of_all) const { return (of_all + of - number) / of; }
  uint64_t run(uint64_t nth) const { return nth * of + number - 1; }
};
/// Throws Refused with what it should be.
Shard shard_of(const std::string& text);

}  // namespace firmtouch::tools
