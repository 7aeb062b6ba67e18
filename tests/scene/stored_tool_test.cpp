// A tool as an asset stores it: each rule broken alone, every word damaged.
#include "firmtouch/scene/stored_tool.hpp"

#include <stdint.h>

#include "harness/float_bits.hpp"
#include "harness/rules.hpp"

using namespace firmtouch;  // NOLINT: a test file

namespace {

constexpr uint32_t kRows = scene::kMaxSpheres + 1;

struct Tool {
  scene::SphereLayout sphere[kRows];
  uint32_t bytes_more = 0, count = scene::kMaxSpheres;

  Tool() {
    for (scene::SphereLayout& s : sphere) s = {{-1, 0.5f, 1}, 0.1f};
    sphere[1].radius_m = 0;
  }
  core::Verdict verdict() const {
    scene::StoredTool to;
    const uint32_t size = static_cast<uint32_t>(count * sizeof(scene::SphereLayout)) + bytes_more;
    const core::Verdict verdict = scene::open(test::bytes(sphere, size), to);
    CHECK_EQ(to.size(), verdict.ok() ? count : 0u);
    return verdict;
  }
};

constexpr test::CheckRule<Tool> check_rule;

}  // namespace

TEST(StoredTool_EachRuleIsBrokenAlone) {
  check_rule(scene::kRuleSphereCount, 0, [](Tool& t) { t.count = 0; });
  check_rule(scene::kRuleSphereCount, 0, [](Tool& t) { t.count = 9; });
  check_rule(scene::kRuleSphereCount, 0, [](Tool& t) { t.count = 7, t.bytes_more = 4; });
  check_rule(scene::kRuleSpherePlace, 3, [](Tool& t) { t.sphere[3].at_m[1] = -1.0001f; });
  check_rule(scene::kRuleSphereRadius, 7, [](Tool& t) { t.sphere[7].radius_m = 0.1001f; });
  check_rule(scene::kRuleSphereRadius, 2, [](Tool& t) { t.sphere[2].radius_m = -1e-9f; });
}

TEST(StoredTool_NaNInAnyWord_IsRejectedByTheRuleOfItsField) {
  for (uint32_t word = 0; word < 4 * scene::kMaxSpheres; ++word) {
    const float bad = test::float_of(word % 2 == 0 ? 0x7FC00000u : 0xFF800000u);
    const uint32_t i = word / 4, k = word % 4;
    check_rule(k == 3 ? scene::kRuleSphereRadius : scene::kRuleSpherePlace, i, [&](Tool& t) {
      if (k == 3)
        t.sphere[i].radius_m = bad;
      else
        t.sphere[i].at_m[k] = bad;
    });
  }
}
