#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "cli/baked_input.hpp"

namespace firmtouch::cli {

/// What `firmtouch bake` was called for.
struct BakeRequest {
  std::vector<std::string> inputs;
  std::string device;  // a linkage; "": none
  BakeOptions options;

  /// The inputs, and the linkage behind them.
  std::vector<std::string> files() const;
};

struct NamedReport {
  std::string name;
  std::vector<std::string> lines;
};

struct BakedAsset {
  std::vector<NamedReport> reports;  // one a file
  std::vector<uint8_t> bytes;        // of the .fta
};

/// Of the arguments of bake_command(). Fails (usage, bad input) where they contradict each other.
BakeRequest bake_request(const Arguments& arguments);

/// Bakes, and proves with the firmware's decoder; writes nothing. `output` is named in messages.
/// Fails (bad input) with the file, the place, what is wrong and how to mend it.
BakedAsset bake_asset(BakeRequest request, const std::string& output);

}  // namespace firmtouch::cli
