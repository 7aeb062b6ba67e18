#include "firmtouch/field/closest_point.hpp"

#include <float.h>

#include "cube_field.hpp"
#include "firmtouch/core/hash.hpp"
#include "firmtouch/math/isa.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using field_test::coordinate;
using field_test::CubeField;
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

TEST(FarAnswer_LeavesTheCellsBoundsAndSeedToTheNextQuery) {
  const Opened o;
  const Vec3 near{0.9f, 0.1f, 0.2f}, far{1.3f, 1.25f, -0.3f};
  mesh::Hint hint;
  CHECK(!field::closest_point(o.view, o.mesh, near, 0.05f, query::kUnlimited, hint).is_far);
  hint.safe_subtree = 1;  // of the last place
  CHECK(field::closest_point(o.view, o.mesh, far, 0.05f, query::kUnlimited, hint).is_far);
  const field::Bounds bounds = field::distance_bounds(o.view, far);
  CHECK_EQ(hint.leaf_slot, bounds.seed);
  CHECK_EQ(hint.lower_m, bounds.lower_m);
  CHECK_EQ(hint.sign, 1);
  CHECK_EQ(hint.safe_subtree, query::kNowhere);
  CHECK_EQ(hint.position_m.x, far.x);
  CHECK_EQ(hint.position_m.y, far.y);
  CHECK_EQ(hint.position_m.z, far.z);
}

TEST(AfterLessThanACell_TheSearchIsThatOfTheMeshAlone) {
  const Opened o;
  uint32_t state = 19;
  for (uint32_t i = 0; i < 500; ++i) {
    const Vec3 p{coordinate(state, 1.1f), coordinate(state, 1.1f), coordinate(state, 1.1f)};
    const Vec3 next{p.x + coordinate(state, 0.01f), p.y, p.z};
    mesh::Hint hint;
    (void)mesh::closest_point(o.mesh, p, query::kUnlimited, hint);
    mesh::Hint alone = hint;
    const mesh::Closest truth = mesh::closest_point(o.mesh, next, query::kUnlimited, alone);
    const mesh::Closest c =
        field::closest_point(o.view, o.mesh, next, 10.0f, query::kUnlimited, hint).closest;
    CHECK_EQ(c.distance_m, truth.distance_m);
    CHECK_EQ(c.certificate.steps, truth.certificate.steps);
    CHECK_EQ(hint.leaf_slot, alone.leaf_slot);
    CHECK_EQ(hint.safe_subtree, alone.safe_subtree);
  }
}

// A hint of the last tick holds nothing, so the bound and sign come from the field alone.
TEST(OutOfBudgetWithAWarmHint_FieldsBoundAndSignReplaceTheSearchs) {
  const Opened o;
  uint32_t state = 17, inside = 0, outside = 0;
  for (uint32_t i = 0; i < 2000; ++i) {
    const Vec3 p{coordinate(state, 1.3f), coordinate(state, 1.3f), coordinate(state, 1.3f)};
    const field::Bounds bounds = field::distance_bounds(o.view, p);
    mesh::Hint hint;
    hint.leaf_slot = bounds.seed;
    hint.position_m = p;
    const mesh::Closest c = field::closest_point(o.view, o.mesh, p, 10.0f, {1}, hint).closest;
    CHECK_GE(c.certificate.lower_m, bounds.lower_m);
    CHECK_GE(hint.lower_m, bounds.lower_m);
    if (bounds.sign == 0) continue;
    CHECK_EQ(c.certificate.sign, bounds.sign);
    CHECK_EQ(c.distance_m < 0, bounds.sign < 0);
    CHECK_EQ(hint.sign, bounds.sign);
    (bounds.sign < 0 ? inside : outside) += 1;
  }
  CHECK_GT(inside, 300u);
  CHECK_GT(outside, 300u);
}

// Where a cell states nothing, a jump of more than a cell leaves what the last certificate says.
TEST(UnknownCell_AfterAJump_KeepsTheLastCertificate) {
  CubeField distance_field;
  for (int16_t& word : distance_field.words) word = field::kUnknown;
  const mesh::View mesh = distance_field.cube.view();
  field::View view;
  CHECK(field::open(distance_field.sections(), mesh, view).ok());
  mesh::Hint hint;
  CHECK(field::closest_point(view, mesh, {0.02f, 0.01f, 0}, 0.1f, query::kUnlimited, hint)
            .closest.certificate.exact);
  const mesh::Closest c =
      field::closest_point(view, mesh, {0.42f, 0.01f, 0}, 0.1f, {1}, hint).closest;
  CHECK_EQ(c.certificate.sign, -1);
  CHECK(c.certificate.lower_m > 0.57f && c.certificate.lower_m <= 0.58f);
}

// A sheet's field has no signs: 0 is no reason to query the mesh in free space.
TEST(UnsignedField_FreeSpace_NeedsNoMeshQuery) {
  CubeField distance_field;
  distance_field.head.is_signed = 0;
  for (int16_t& word : distance_field.words)
    if (word < 0) word = static_cast<int16_t>(-1 - word);
  distance_field.cube.head.is_signed = 0;
  mesh::Sections sections = distance_field.cube.sections();
  sections.vertex_normals = sections.edge_folds = {};
  const mesh::View mesh = test::opened<mesh::View>(sections);
  field::View view;
  CHECK(field::open(distance_field.sections(), mesh, view).ok());
  const Vec3 points[] = {{0, 0, 0}, {0.1f, -0.2f, 0.1f}, {1.3f, 1.3f, 1.3f}, {5, 1, 2}};
  for (const Vec3& p : points) {
    mesh::Hint hint;
    const field::Answer answer =
        field::closest_point(view, mesh, p, 0.05f, query::kUnlimited, hint);
    CHECK(answer.is_far);
    CHECK_EQ(answer.closest.certificate.steps, 1u);
    CHECK_EQ(answer.closest.certificate.sign, 0);
    CHECK_GT(answer.closest.certificate.lower_m, 0.05f);
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
