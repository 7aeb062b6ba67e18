#include "firmtouch/field/closest_point.hpp"

#include <float.h>

#include "cube_field.hpp"
#include "firmtouch/core/hash.hpp"
#include "firmtouch/math/isa.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using field_test::coordinate;
using field_test::Opened;
using math::Vec3;

}  // namespace

TEST(FreeSpace_NeedsNoMeshQuery_NearMesh_AnswerIsTheMeshs) {
  const Opened o;
  mesh::Hint hint, alone;
  uint32_t state = 5, far = 0, near = 0, inside = 0;
  Vec3 p{1.3f, 0.2f, 0.1f};
  for (uint32_t i = 0; i < 4000; ++i) {
    if (i % 200 == 0) p = {coordinate(state, 2.5f), coordinate(state, 2.5f), 0.3f};  // a jump
    p = {p.x * 0.99f + coordinate(state, 0.1f), p.y * 0.99f + coordinate(state, 0.1f),
         p.z * 0.99f + coordinate(state, 0.1f)};
    const field::Answer answer =
        field::closest_point(o.view, o.mesh, p, 0.05f, query::kUnlimited, hint);
    const mesh::Closest truth = mesh::closest_point(o.mesh, p, query::kUnlimited, alone);
    const query::Certificate& certificate = answer.closest.certificate;
    CHECK_EQ(static_cast<int>(certificate.sign), static_cast<int>(truth.certificate.sign));
    if (answer.is_far) {
      ++far;
      CHECK_EQ(certificate.steps, 1u);
      CHECK(!certificate.exact && certificate.sign > 0);
      CHECK_GT(certificate.lower_m, 0.05f);
      CHECK_LE(certificate.lower_m, truth.distance_m);
      CHECK_GE(answer.closest.distance_m * (1 + 1e-6f), truth.certificate.lower_m);
      continue;
    }
    ++near;
    inside += certificate.sign < 0 ? 1u : 0u;
    CHECK(certificate.exact);
    CHECK_LE(answer.closest.distance_m - truth.distance_m, 1e-6f);
    CHECK_GE(answer.closest.distance_m - truth.distance_m, -1e-6f);
  }
  CHECK_GT(far, 300u);
  CHECK_GT(near, 300u);
  CHECK_GT(inside, 300u);
}

TEST(OutOfBudget_FieldsBoundAndSignReplaceTheSearchs) {
  const Opened o;
  uint32_t state = 7, raised = 0, reported = 0;
  for (uint32_t i = 0; i < 2000; ++i) {
    const Vec3 p{coordinate(state, 1.4f), coordinate(state, 1.4f), coordinate(state, 1.4f)};
    mesh::Hint hint, alone;
    const mesh::Closest truth = mesh::closest_point(o.mesh, p, query::kUnlimited, alone);
    alone = {};
    const mesh::Closest cut = mesh::closest_point(o.mesh, p, {1}, alone);
    const mesh::Closest c = field::closest_point(o.view, o.mesh, p, 10.0f, {1}, hint).closest;
    const float truth_m = truth.distance_m < 0 ? -truth.distance_m : truth.distance_m;
    const float reported_m = c.distance_m < 0 ? -c.distance_m : c.distance_m;
    CHECK_LE(c.certificate.lower_m, truth_m * (1 + 1e-6f) + 1e-6f);
    CHECK_GE(reported_m, truth_m - 2e-6f);
    CHECK_EQ(hint.lower_m, c.certificate.lower_m);
    if (c.certificate.sign != 0) CHECK_EQ(c.certificate.sign, truth.certificate.sign);
    raised += c.certificate.lower_m > cut.certificate.lower_m ? 1u : 0u;
    reported += c.certificate.sign != 0 && cut.certificate.sign == 0 ? 1u : 0u;
    if (reported_m > 0.01f && c.certificate.sign != 0)
      CHECK_EQ(c.distance_m < 0, c.certificate.sign < 0);
  }
  CHECK_GT(raised, 300u);
  CHECK_GT(reported, 500u);
}

TEST(AfterAJumpTheSearchStartsAtTheSeed) {
  const Opened o;
  uint32_t state = 11, fewer = 0;
  mesh::Hint hint, alone;
  for (uint32_t i = 0; i < 500; ++i) {
    const Vec3 p{coordinate(state, 1.2f), coordinate(state, 1.2f), coordinate(state, 1.2f)};
    const field::Answer answer =
        field::closest_point(o.view, o.mesh, p, 10.0f, query::kUnlimited, hint);
    const mesh::Closest c = mesh::closest_point(o.mesh, p, query::kUnlimited, alone);
    CHECK(answer.closest.certificate.exact);
    fewer += answer.closest.certificate.steps < c.certificate.steps ? 1u : 0u;
  }
  CHECK_GT(fewer, 100u);
}

TEST(HostilePoints_GiveFiniteAnswers) {
  const Opened o;
  mesh::Hint hint;
  const float bads[] = {
      __builtin_nanf(""), __builtin_inff(), -__builtin_inff(), 1e30f, FLT_MAX, 1e-42f};
  for (uint32_t round = 0; round < 3; ++round) {
    for (const float bad : bads) {
      Vec3 p{0.9f, 0.8f, 1.1f};
      (&p.x)[round] = bad;
      const field::Answer answer = field::closest_point(o.view, o.mesh, p, 0.1f, {4}, hint);
      CHECK(answer.closest.distance_m >= -FLT_MAX && answer.closest.distance_m <= FLT_MAX);
      CHECK(answer.closest.certificate.lower_m >= 0 &&
            answer.closest.certificate.lower_m <= FLT_MAX);
      const field::Answer next =
          field::closest_point(o.view, o.mesh, {0.9f, 0.8f, 1.1f}, 0.3f, query::kUnlimited, hint);
      CHECK(next.closest.certificate.exact);
    }
  }
}

TEST(Answers_HaveOneHashEverywhere) {
  const Opened o;
  core::Hash hash;
  mesh::Hint hint;
  uint32_t state = 13;
  Vec3 p{1.3f, 0.2f, 0.1f};
  for (uint32_t i = 0; i < 2000; ++i) {
    if (i % 100 == 0) p = {coordinate(state, 2), coordinate(state, 2), coordinate(state, 2)};
    p = {p.x * 0.99f + coordinate(state, 0.05f), p.y * 0.99f,
         p.z * 0.99f + coordinate(state, 0.05f)};
    const query::Budget budget{i % 3 == 0 ? 3u : UINT32_MAX};
    const mesh::Closest c = field::closest_point(o.view, o.mesh, p, 0.1f, budget, hint).closest;
    const float values[] = {c.distance_m, c.point_m.x, c.point_m.y, c.point_m.z,
                            c.certificate.lower_m};
    for (const float value : values) hash.add(math::bits_of(value));
    hash.add(c.certificate.steps);
    hash.add(static_cast<uint32_t>(c.certificate.sign + 1));
  }
  CHECK_EQ(hash.value(), 0x424517036ca841b3u);
}
