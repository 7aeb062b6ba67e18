// The hull that the controller's tests are tried on is what the baker makes; with
// FIRMTOUCH_REWRITE=tests/hull/small_hull_words.hpp it is written anew.
#include <cstdio>
#include <cstdlib>

#include "bake/asset/asset_writer.hpp"
#include "bumpy_ring.hpp"
#include "harness/test.hpp"
#include "small_hull_words.hpp"

namespace firmtouch::tools {
namespace {

std::vector<uint32_t> baked_words() {
  const BakedHull baked(bumpy_ring(), 150, 16);
  CHECK(baked.report.problem.empty());
  std::vector<Section> kept;
  for (const Section& s : baked.sections) {
    if (s.type <= mesh::kTriangles32Section || s.type >= hull::kHeadSection) kept.push_back(s);
  }
  const AssetFile file = write_asset(kept);
  std::vector<uint32_t> words(file.bytes.size() / 4);
  std::memcpy(words.data(), file.bytes.data(), file.bytes.size());
  return words;
}

void rewrite(const char* path, const std::vector<uint32_t>& words) {
  std::FILE* file = std::fopen(path, "w");
  CHECK(file != nullptr);
  if (file == nullptr) return;
  std::fputs(
      "#pragma once\n// An asset of one mesh without a tree and its hull, baked: "
      "small_hull_host_test.cpp writes it.\n#include <stdint.h>\n\nnamespace "
      "firmtouch::hull_test {\n\n// clang-format off\nalignas(16) constexpr uint32_t kWords[] = "
      "{\n",
      file);
  for (size_t i = 0; i < words.size(); ++i)
    std::fprintf(file, "0x%x,%s", words[i], i % 10 == 9 || i + 1 == words.size() ? "\n" : "");
  std::fputs("};\n// clang-format on\n\n}  // namespace firmtouch::hull_test\n", file);
  std::fclose(file);
}

}  // namespace

TEST(TheSmallHullIsWhatTheBakerMakes) {
  const std::vector<uint32_t> words = baked_words();
  const char* path = std::getenv("FIRMTOUCH_REWRITE");
  if (path != nullptr && path[0] != 0) rewrite(path, words);
  CHECK_EQ(words.size(), sizeof hull_test::kWords / 4);
  if (words.size() != sizeof hull_test::kWords / 4) return;
  for (size_t i = 0; i < words.size(); ++i) CHECK_EQ(words[i], hull_test::kWords[i]);
}

}  // namespace firmtouch::tools
