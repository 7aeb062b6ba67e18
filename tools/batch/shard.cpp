#include "batch/shard.hpp"

#include <cstdlib>

#include "device/refused.hpp"

namespace firmtouch::tools {
namespace {

uint64_t whole(const std::string& text) {
  char* end = nullptr;
  const uint64_t value = std::strtoull(text.c_str(), &end, 10);
  const bool is_whole = !text.empty() && text[0] >= '0' && text[0] <= '9' && *end == 0;
  return is_whole && value <= kMaxRuns ? value : 0;
}

}  // namespace

Shard shard_of(const std::string& text) {
  const size_t slash = text.find('/');
  Shard shard;
  shard.number = whole(text.substr(0, slash));
  shard.of = slash == std::string::npos ? 0 : whole(text.substr(slash + 1));
  if (shard.number < 1 || shard.number > shard.of)
    throw Refused("--shard " + text + ": write I/N, from 1/N to N/N");
  return shard;
}

}  // namespace firmtouch::tools
