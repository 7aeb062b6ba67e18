// Objects as an asset stores them: each rule broken alone, every word damaged, and what is read.
#include "firmtouch/scene/stored_objects.hpp"

#include <float.h>
#include <stdint.h>

#include "harness/float_bits.hpp"
#include "harness/rules.hpp"

using namespace firmtouch;  // NOLINT: a test file
using scene::ObjectLayout;

namespace {

constexpr uint32_t kMaxRows = 17;

struct Scene {
  ObjectLayout object[kMaxRows] = {};
  uint32_t count = 16;

  Scene() {
    for (uint32_t i = 0; i < kMaxRows; ++i) {
      ObjectLayout& o = object[i];
      o.name[0] = static_cast<char>('a' + i);
      o.mesh[0] = 'm';
      // A quarter turn about z.
      o.rotation[1] = -1, o.rotation[3] = o.rotation[8] = 1;
      o.at_m[0] = 0.25f, o.at_m[2] = -0.5f;
      o.velocity_mps[1] = 0.125f;
      o.turn_rad_per_s[2] = 3;
      o.stiffness_N_per_m = FLT_MAX;
      o.friction_static = 0.5f, o.friction_dynamic = 0.25f;
    }
  }
  core::Bytes bytes() const {
    return test::bytes(object, static_cast<uint32_t>(count * sizeof(ObjectLayout)));
  }
  core::Verdict verdict() const {
    scene::StoredObjects to;
    const core::Verdict verdict = scene::open(bytes(), to);
    CHECK_EQ(to.size(), verdict.ok() ? count : 0u);
    return verdict;
  }
};

constexpr test::CheckRule<Scene> check_rule;

}  // namespace

TEST(StoredObjects_EachRuleIsBrokenAlone) {
  check_rule(scene::kRuleObjectCount, 0, [](Scene& s) { s.count = 0; });
  check_rule(scene::kRuleObjectCount, 0, [](Scene& s) { s.count = 17; });
  check_rule(scene::kRuleObjectName, 2, [](Scene& s) { s.object[2].name[0] = 0; });
  check_rule(scene::kRuleObjectName, 2, [](Scene& s) { s.object[2].name[5] = 'x'; });
  check_rule(scene::kRuleObjectName, 3, [](Scene& s) { s.object[3].mesh[0] = 7; });
  check_rule(scene::kRuleObjectName, 3, [](Scene& s) {
    for (char& c : s.object[3].mesh) c = 'x';
  });
  check_rule(scene::kRuleObjectTwice, 9, [](Scene& s) { s.object[9].name[0] = 'b'; });
  check_rule(scene::kRuleObjectRotation, 4, [](Scene& s) { s.object[4].rotation[8] = -1; });
  check_rule(scene::kRuleObjectRotation, 4, [](Scene& s) { s.object[4].rotation[1] = -1.01f; });
  check_rule(scene::kRuleObjectTooFar, 5, [](Scene& s) { s.object[5].at_m[1] = 11; });
  check_rule(scene::kRuleObjectTooFast, 6, [](Scene& s) { s.object[6].velocity_mps[0] = -101; });
  check_rule(scene::kRuleObjectTooFast, 6, [](Scene& s) { s.object[6].turn_rad_per_s[1] = 1001; });
  check_rule(scene::kRuleObjectMaterial, 7, [](Scene& s) { s.object[7].stiffness_N_per_m = -1; });
  check_rule(scene::kRuleObjectMaterial, 7, [](Scene& s) { s.object[7].friction_static = 101; });
}

TEST(StoredObjects_PartOfAnObjectIsRejected) {
  const Scene scene;
  scene::StoredObjects to;
  for (uint32_t less = 1; less < sizeof(ObjectLayout); ++less) {
    const core::Bytes cut(scene.bytes().data(), scene.bytes().size() - less);
    CHECK_EQ(scene::open(cut, to).rule, uint16_t{scene::kRuleObjectCount});
  }
}

TEST(StoredObjects_NanAndInfinityAreRejectedEverywhere) {
  constexpr uint32_t kFirst = offsetof(ObjectLayout, rotation) / 4, kEnd = sizeof(ObjectLayout) / 4;
  constexpr uint32_t kBits[] = {0x7FC00000u, 0x7F800000u, 0xFF800000u, 0x7F800001u};
  for (const uint32_t bits : kBits)
    for (uint32_t word = kFirst; word < kEnd; ++word) {
      Scene scene;
      __builtin_memcpy(reinterpret_cast<char*>(&scene.object[1]) + 4 * word, &bits, 4);
      CHECK(!scene.verdict().ok());
    }
}

TEST(StoredObjects_AreReadAsTheyStand) {
  const Scene scene;
  scene::StoredObjects stored;
  CHECK(scene::open(scene.bytes(), stored).ok());
  const scene::Object object = scene::object_of(stored[3]);
  const math::Mat3& m = object.pose.rotation;
  CHECK(m.row[0].y <= -1.0f && m.row[1].x >= 1.0f && m.row[2].z >= 1.0f);
  CHECK(object.pose.translation_m.z <= -0.5f && object.twist.velocity_mps.y >= 0.125f);
  CHECK(object.twist.turn_rad_per_s.z >= 3.0f && object.stiffness_N_per_m >= FLT_MAX);
  CHECK(object.friction_static >= 0.5f && object.friction_dynamic <= 0.25f);
}
