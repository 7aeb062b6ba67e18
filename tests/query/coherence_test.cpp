// What a certificate still says after a motion, and how probe sections are read.
#include "firmtouch/query/coherence.hpp"

#include <float.h>
#include <stdint.h>

#include "firmtouch/math/isa.hpp"
#include "firmtouch/query/probe.hpp"
#include "harness/test.hpp"

namespace core = firmtouch::core;
namespace math = firmtouch::math;
namespace query = firmtouch::query;

namespace {

query::HintBase hint_at(math::Vec3 position_m, float lower_m, int8_t sign) {
  query::HintBase hint;
  hint.position_m = position_m;
  hint.lower_m = lower_m;
  hint.sign = sign;
  return hint;
}

uint32_t g_seed = 2463534242u;
float random_unit() {  // -1 to 1
  g_seed ^= g_seed << 13, g_seed ^= g_seed >> 17, g_seed ^= g_seed << 5;
  return static_cast<float>(static_cast<int32_t>(g_seed)) * 0x1p-31f;
}

const float kNan = math::float_of(0x7FC00000u);
const float kInf = math::float_of(0x7F800000u);

}  // namespace

TEST(MotionTakesItsLengthFromTheFreeRadius) {
  const query::Carried carried = query::carry(hint_at({1, 2, 3}, 1.0f, -1), {1.3f, 2, 3.4f});
  CHECK_LE(carried.lower_m, 0.5f + 1e-6f);
  CHECK_GE(carried.lower_m, 0.5f - 1e-6f);
  CHECK_EQ(carried.sign, -1);
}

TEST(RestKeepsAll) {
  const query::Carried carried = query::carry(hint_at({1, 2, 3}, 0.25f, 1), {1, 2, 3});
  CHECK_EQ(carried.lower_m, 0.25f);
  CHECK_EQ(carried.sign, 1);
}

// In exact arithmetic: (lower + left)^2 is compared by squares in double, whose 53 bits hold
// products of floats exactly, except the sum of three; the margin of 2^-48 is far below the 2^-24
// that would matter.
TEST(CarriedBoundIsNeverMoreThanTheTruth) {
  uint32_t too_much = 0;
  uint32_t known = 0;
  for (int i = 0; i < 20000; ++i) {
    const float scale =
        math::float_of(0x3F800000u + (static_cast<uint32_t>(i % 60) << 23) - (30u << 23));
    const math::Vec3 from{random_unit() * scale, random_unit() * scale, random_unit() * scale};
    const float step = scale * (i % 3 == 0 ? 1.0f : 1e-3f);
    const math::Vec3 to{from.x + random_unit() * step, from.y + random_unit() * step,
                        from.z + random_unit() * step};
    const float lower = step * 1.7f * (1.0f + 0.5f * random_unit());
    const query::Carried carried = query::carry(hint_at(from, lower, 1), to);
    const double x = static_cast<double>(to.x) - static_cast<double>(from.x);
    const double y = static_cast<double>(to.y) - static_cast<double>(from.y);
    const double z = static_cast<double>(to.z) - static_cast<double>(from.z);
    const double room = static_cast<double>(lower) - static_cast<double>(carried.lower_m);
    if (carried.lower_m > 0) ++known;
    if (carried.lower_m > 0 && !(room * room * (1 + 0x1p-48) >= x * x + y * y + z * z)) ++too_much;
    if ((carried.lower_m > 0) != (carried.sign == 1)) ++too_much;
  }
  CHECK_EQ(too_much, 0u);
  CHECK_GE(known, 5000u);  // the test must not pass by knowing nothing
}

TEST(JumpBeyondTheFreeRadiusLeavesNothing) {
  const query::Carried carried = query::carry(hint_at({0, 0, 0}, 1.0f, 1), {0, 1.0000001f, 0});
  CHECK_EQ(carried.lower_m, 0.0f);
  CHECK_EQ(carried.sign, 0);
  const query::Carried far =
      query::carry(hint_at({0, 0, 0}, 1.0f, 1), {FLT_MAX, -FLT_MAX, FLT_MAX});
  CHECK_EQ(far.lower_m, 0.0f);
  CHECK_EQ(far.sign, 0);
}

TEST(ColdHintKnowsNothing) {
  const query::Carried carried = query::carry(query::HintBase{}, {0, 0, 0});
  CHECK_EQ(carried.lower_m, 0.0f);
  CHECK_EQ(carried.sign, 0);
}

TEST(NaN_CarriesNothing) {
  const float bad[] = {kNan, kInf, -kInf};
  for (const float value : bad) {
    const math::Vec3 places[] = {{value, 0, 0}, {0, value, 0}, {0, 0, value}};
    for (const math::Vec3 place : places) {
      CHECK_EQ(query::carry(hint_at({0, 0, 0}, 1.0f, 1), place).sign, 0);
      CHECK_EQ(query::carry(hint_at({0, 0, 0}, 1.0f, 1), place).lower_m, 0.0f);
      CHECK_EQ(query::carry(hint_at(place, 1.0f, 1), {0, 0, 0}).sign, 0);
    }
  }
  CHECK_EQ(query::carry(hint_at({0, 0, 0}, kNan, 1), {0, 0, 0}).sign, 0);
  CHECK_EQ(query::carry(hint_at({0, 0, 0}, -1.0f, 1), {0, 0, 0}).sign, 0);
}

TEST(ProbeSectionIsReadOnlyWhole) {
  struct Section {
    query::ProbeHead head;
    query::ProbePoint point[3];
  };
  Section section{{3, 0, 0x11223344u, 0x55667788u}, {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}};
  const uint8_t* bytes = reinterpret_cast<const uint8_t*>(&section);
  const query::Probes probes = query::read_probes({bytes, sizeof section});
  CHECK_EQ(probes.points.size(), 3u);
  CHECK(probes.hash == 0x5566778811223344ull);
  CHECK_EQ(probes.points[2].z_m, 9.0f);
  for (uint32_t n = 0; n < sizeof section; ++n)
    CHECK(query::read_probes({bytes, n}).points.empty());
  section.head.count = 4;
  CHECK(query::read_probes({bytes, sizeof section}).points.empty());
  section.head.count = 3;
  section.head.reserved = 1;
  CHECK(query::read_probes({bytes, sizeof section}).points.empty());
}
