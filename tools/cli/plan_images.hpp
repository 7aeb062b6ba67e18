#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace firmtouch::cli {

/// What a controller program takes, in bytes: flash without the asset, RAM without records and
/// stack, stack of the deepest phase.
struct Image {
  std::string board;
  std::string parts;           // as in FIRMTOUCH_APP
  bool has_two_rates = false;  // FIRMTOUCH_APP_TWO_RATES
  uint64_t flash = 0, ram = 0, stack = 0;
  uint64_t records = 0;  // RAM of the record ring

  uint64_t whole_ram() const { return ram + stack + records; }
};

/// The programs of `board` that tools/check/image keeps within their budgets, which are returned.
std::vector<Image> budgeted_images(const std::string& board);

/// Those of a resources.json, which tools/check/image writes beside what it measured. Fails (bad
/// input) where it is none.
std::vector<Image> measured_images(const std::string& path);

/// The smallest in flash that has all `parts`; nullptr: none has. One that trusts a signature does
/// not count.
const Image* image_for(const std::vector<Image>& images, const std::vector<std::string>& parts);

}  // namespace firmtouch::cli
