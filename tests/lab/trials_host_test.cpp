// The trials run and print their tables.
#include <cstdio>

#include "bench/models.hpp"
#include "harness/test.hpp"
#include "lab/trials.hpp"
#include "surface/make/make_part.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::lab {
namespace {

Report report_of(const std::string& name, const Options& options) {
  Report report;
  for (const Bench& trial : trials())
    if (name == trial.name) trial.run(options, report);
  return report;
}

size_t lines_with(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

struct SmallPart {
  TemporaryFolder folder;
  Options options;
  SmallPart() { options.models = {folder.write("part.obj", to_obj(tools::make_part(1, 2000)))}; }
};

}  // namespace

TEST(OrdersPrintsEveryCombination) {
  const std::string text = to_text(report_of("orders", SmallPart().options));
  size_t rows = 0;
  for (const char* boxes :
       {"\n  16-bit AABB ", "\n  float AABB ", "\n  4-wide 16-bit ", "\n  oriented "})
    rows += lines_with(text, boxes);
  CHECK_EQ(rows, size_t{96});
}

TEST(GridFindsNoSignThatTheFirmwareReturnsOtherwise) {
  const std::string text = to_json_members(report_of("grid", SmallPart().options));
  CHECK(lines_with(text,
                   "\"what\": \"signs on which the firmware differs\", \"model\": "
                   "\"part\", \"value\": 0") == 1);
  CHECK(lines_with(text, "\"grid, oriented / aligned, with signs\"") == 1);
}

}  // namespace firmtouch::lab
