#include "cli/plan_images.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "firmtouch/record/tick_ring.hpp"
#include "surface/read/json.hpp"

namespace firmtouch::cli {
namespace {

// The text of tools/check/image_budgets.txt.
constexpr const char kBudgets[] =
#include "cli/image_budgets.inc"
    ;

bool lists(const std::string& parts, const std::string& part) {
  return (";" + parts + ";").find(";" + part + ";") != std::string::npos;
}

// What a part, or two together, bring with them (firmware/app/CMakeLists.txt).
constexpr struct {
  const char *part, *other, *brings;
} kBrought[] = {{"all", "all", "mesh;field;hull;spline;guide;spline_guide;linkage"},
                {"homing", "homing", "linkage"},
                {"all", "tool", "objects"}};

bool has_part(const std::string& parts, const std::string& part) {
  if (lists(parts, part)) return true;
  return std::any_of(std::begin(kBrought), std::end(kBrought), [&](const auto& row) {
    return lists(parts, row.part) && lists(parts, row.other) && lists(row.brings, part);
  });
}

}  // namespace

std::vector<Image> budgeted_images(const std::string& board) {
  std::vector<Image> images;
  std::istringstream lines(kBudgets);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    Image image;
    std::string program;
    fields >> image.board >> image.parts >> program >> image.flash >> image.ram >> image.stack;
    image.records = sizeof(record::TickRing);
    if (fields && image.board == board) images.push_back(image);
  }
  return images;
}

std::vector<Image> measured_images(const std::string& path) {
  const std::vector<uint8_t> bytes = read_file(path);
  tools::JsonReader json;
  const std::string problem =
      json.parse({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (!problem.empty()) fail_input(path + ": " + problem);
  std::vector<Image> images;
  for (const uint32_t item : json.items(json.root())) {
    const auto bytes_of = [&](uint32_t object, const char* name) {
      const int64_t value = json.whole(json.member(object, name), -1);
      if (value < 0)
        fail_input(path + ": program " + std::to_string(images.size()) + " has no '" + name +
                   "': give the resources.json that tools/check/image writes");
      return static_cast<uint64_t>(value);
    };
    Image image;
    image.board = json.text(json.member(item, "board"));
    image.parts = json.text(json.member(item, "parts"));
    image.has_two_rates = json.text(json.member(item, "two_rates")) == "true";
    image.flash = bytes_of(item, "flash");
    image.ram = bytes_of(item, "ram");
    image.records = bytes_of(item, "record_ring");
    const uint32_t stack = json.member(item, "stack");
    for (const char* phase : {"opening", "lock_step", "running"})
      image.stack = std::max(image.stack, bytes_of(stack, phase));
    images.push_back(image);
  }
  if (images.empty()) fail_input(path + ": names no program; tools/check/image BOARD writes it");
  return images;
}

const Image* image_for(const std::vector<Image>& images, const std::vector<std::string>& parts) {
  const Image* best = nullptr;
  for (const Image& image : images) {
    const bool fits = !has_part(image.parts, "trusted") &&
                      std::all_of(parts.begin(), parts.end(),
                                  [&](const auto& part) { return has_part(image.parts, part); });
    if (fits && (best == nullptr || image.flash < best->flash)) best = &image;
  }
  return best;
}

}  // namespace firmtouch::cli
