// Refinement of a small hull: on the host and on the controller, with the same bits.
#include "firmtouch/hull/refinement.hpp"
#include "firmtouch/core/hash.hpp"
#include "firmtouch/hull/base_hull_cast.hpp"
#include "firmtouch/hull/base_hull_distance.hpp"
#include "firmtouch/hull/complete_cast.hpp"
#include "harness/float_bits.hpp"
#include "refinement_faces.hpp"
#include "small_hull.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using hull_test::RefinementFaces;
using hull_test::SmallHull;
using math::Vec3;
using test::bits_of;

constexpr uint32_t kMax = 128;  // collapses, of the small hull fewer

struct Opened {
  SmallHull small;
  hull::View view;
  Opened() { CHECK(hull::open(small.sections, view).ok()); }
};

template <uint32_t kSplits, uint32_t kCandidates>
struct Memory {
  uint32_t bits[hull::bit_words(kMax)];
  uint32_t splits[kSplits];
  hull::Candidate candidates[kCandidates];
  hull::RefinementMemory spans() { return {{bits}, {splits}, {candidates}}; }
};

// The small hull, and a refinement that has so much memory.
template <uint32_t kSplits, uint32_t kCandidates>
struct Refined : Opened {
  Memory<kSplits, kCandidates> memory;
  hull::Refinement refinement{view, view.base_hull(), memory.spans()};

  uint32_t face_count() const {
    uint32_t count = 0;
    for (RefinementFaces faces(view, view.base_hull(), refinement); faces.next();) ++count;
    return count;
  }
};

uint32_t g_random = 1;
float random_in(float low, float high) {
  g_random = g_random * 1664525u + 1013904223u;
  const float part = (high - low) * static_cast<float>(g_random >> 8) * 0x1p-24f;
  return low + part;
}
struct Segment {
  Vec3 a, b;
};
// Both ends outside, through the ring's neighbourhood.
Segment through() {
  const float side = random_in(0, 1) < 0.5f ? -3.0f : 3.0f;
  const Vec3 aim{random_in(-1.3f, 1.3f), random_in(-1.3f, 1.3f), random_in(-0.4f, 0.4f)};
  const Vec3 a{random_in(-3, 3), side, random_in(-2, 2)};
  const Vec3 twice{aim.x * 2, aim.y * 2, aim.z * 2};
  return {a, {twice.x - a.x, twice.y - a.y, twice.z - a.z}};
}
template <class Check>
void each_segment(uint32_t seed, uint32_t count, const Check& check) {
  g_random = seed;
  for (uint32_t i = 0; i < count; ++i) {
    test::note("segment", i);
    check(i, through());
  }
}

// Of a triangle's corners in their turn, whichever comes first; summed, an order does not matter.
uint64_t mark(const uint32_t (&corner)[3]) {
  uint32_t first = 0;
  for (uint32_t k = 1; k < 3; ++k)
    if (corner[k] < corner[first]) first = k;
  core::Hash hash;
  for (uint32_t k = 0; k < 3; ++k) hash.add(corner[(first + k) % 3]);
  return hash.value();
}

}  // namespace

TEST(SplittingEverythingRestoresTheMeshFaceForFace) {
  Refined<kMax, 4> opened;
  hull::Refinement& refinement = opened.refinement;
  for (uint32_t k = 0; k < opened.view.collapse_count(); ++k) CHECK(refinement.split(k));
  CHECK_EQ(refinement.splits().size(), opened.view.collapse_count());
  uint64_t wanted = 0, found = 0;
  uint32_t count = 0;
  for (uint32_t i = 0; i < opened.view.head().mesh_triangle_count; ++i)
    wanted += mark(opened.view.triangle(i).corner);
  for (RefinementFaces faces(opened.view, opened.view.base_hull(), refinement); faces.next();
       ++count)
    found += mark(faces.number);
  CHECK_EQ(count, opened.view.head().mesh_triangle_count);
  CHECK_EQ(found, wanted);
  refinement.reset();
  CHECK_EQ(opened.face_count(), opened.view.base_hull().face_count());
}

TEST(AnyClosureLeavesAHullOfTheRightSize) {
  Refined<kMax, 4> opened;
  hull::Refinement& refinement = opened.refinement;
  for (uint32_t k = 0; k < opened.view.collapse_count(); k += 3) {
    refinement.reset();
    CHECK(refinement.split(k));
    CHECK_EQ(opened.face_count(),
             opened.view.base_hull().face_count() + 2 * refinement.splits().size());
  }
}

TEST(FromOutsideTheFirstCrossingIsTheMeshs) {
  Refined<kMax, 64> opened;
  hull::Refinement& refinement = opened.refinement;
  uint32_t hits = 0, splits = 0;
  each_segment(7, 400, [&](uint32_t, const Segment& s) {
    const mesh::Hit truth = hull::cast_segment(opened.view, s.a, s.b, query::kUnlimited);
    const hull::RefinedHit hit = refinement.first(s.a, s.b, query::kUnlimited);
    CHECK(hit.exact);
    CHECK_EQ(hit.hit, truth.hit);
    CHECK_EQ(refinement.any(s.a, s.b, query::kUnlimited).hit, truth.hit);
    CHECK_EQ(refinement.splits().size(), 0u);
    if (!truth.hit) return;
    ++hits;
    splits += hit.splits;
    CHECK_LT(hit.splits, hit.steps);
    CHECK(hit.is_of_mesh);
    CHECK_EQ(bits_of(hit.t), bits_of(truth.t));
    CHECK_EQ(hit.triangle, truth.triangle);
    CHECK_EQ(hit.enters, truth.enters);
  });
  CHECK(hits > 100);
  CHECK(splits > hits);
}

TEST(FirstAndLastCrossing_AreTheMeshs_NoneIsInvented) {
  Refined<kMax, 4> opened;
  hull::Refinement& refinement = opened.refinement;
  each_segment(9, 400, [&](uint32_t, const Segment& s) {
    mesh::SurfaceCrossing truth[16], reported[16];
    const mesh::Crossings all =
        hull::all_crossings(opened.view, s.a, s.b, query::kUnlimited, {truth});
    const hull::RefinedCrossings found = refinement.all(s.a, s.b, query::kUnlimited, {reported});
    CHECK(found.exact);
    CHECK(found.found <= all.found);
    CHECK_EQ(found.found == 0, all.found == 0);
    if (all.found == 0 || found.found == 0) return;
    CHECK_EQ(reported[0].triangle, truth[0].triangle);
    CHECK_EQ(reported[found.reported - 1].triangle, truth[all.reported - 1].triangle);
    uint32_t at = 0;
    for (uint32_t k = 0; k < found.reported; ++k) {
      while (at < all.reported && truth[at].triangle != reported[k].triangle) ++at;
      CHECK(at < all.reported);
    }
  });
}

// From so far that several crossings have times within the error of a time.
TEST(FromAfar_TheFirstCrossingIsTheMeshs) {
  Refined<kMax, 64> opened;
  uint32_t hits = 0;
  each_segment(21, 400, [&](uint32_t, const Segment& s) {
    const Vec3 way{s.b.x - s.a.x, s.b.y - s.a.y, s.b.z - s.a.z};
    const float times = 2e4f;
    const Vec3 a{s.a.x - way.x * times, s.a.y - way.y * times, s.a.z - way.z * times};
    const Vec3 b{s.b.x + way.x * times, s.b.y + way.y * times, s.b.z + way.z * times};
    const mesh::Hit truth = hull::cast_segment(opened.view, a, b, query::kUnlimited);
    const hull::RefinedHit hit = opened.refinement.first(a, b, query::kUnlimited);
    CHECK(hit.exact);
    CHECK_EQ(hit.hit, truth.hit);
    if (!truth.hit) return;
    ++hits;
    CHECK_EQ(bits_of(hit.t), bits_of(truth.t));
    CHECK_EQ(hit.triangle, truth.triangle);
  });
  CHECK(hits > 50);
}

// Half a closure is no hull: one that does not fit is taken back, and the hull's crossing reported.
TEST(OutOfMemoryOrBudget_NoMeshCrossingBeforeReportedOne) {
  Refined<12, 3> opened;
  hull::Refinement& refinement = opened.refinement;
  uint32_t conservative = 0, exact = 0;
  each_segment(11, 600, [&](uint32_t i, const Segment& s) {
    const query::Budget budget{i % 2 == 0 ? UINT32_MAX : 1 + i % 40};
    const mesh::Hit truth = hull::cast_segment(opened.view, s.a, s.b, query::kUnlimited);
    const hull::RefinedHit hit = refinement.first(s.a, s.b, budget);
    CHECK_EQ(refinement.splits().size(), 0u);
    if (truth.hit) CHECK(hit.hit);
    if (truth.hit) CHECK(hit.t <= truth.t + 0x1p-17f);
    if (hit.exact) {
      ++exact;
      CHECK_EQ(hit.hit, truth.hit);
      if (truth.hit) CHECK_EQ(hit.triangle, truth.triangle);
    } else {
      ++conservative;
    }
  });
  CHECK(conservative > 50);
  CHECK(exact > 50);
}

// A closure that does not fit leaves a hull that is not the mesh, and whose crossings are not all.
TEST(OutOfMemory_AllCrossings_SayThatThereMayBeMore) {
  Refined<12, 4> opened;
  uint32_t exact = 0, cut = 0;
  each_segment(13, 400, [&](uint32_t, const Segment& s) {
    mesh::SurfaceCrossing truth[16], reported[16];
    const mesh::Crossings all =
        hull::all_crossings(opened.view, s.a, s.b, query::kUnlimited, {truth});
    const hull::RefinedCrossings found =
        opened.refinement.all(s.a, s.b, query::kUnlimited, {reported});
    CHECK_EQ(opened.refinement.splits().size(), 0u);
    (found.exact ? exact : cut) += 1;
    if (!found.exact) return;
    CHECK_EQ(found.found == 0, all.found == 0);
    if (all.found == 0 || found.found == 0) return;
    CHECK_EQ(reported[0].triangle, truth[0].triangle);
    CHECK_EQ(reported[found.reported - 1].triangle, truth[all.reported - 1].triangle);
  });
  CHECK(exact > 50);
  CHECK(cut > 50);
}

TEST(QueryAfterSplits_AnswersAsOfTheBaseHull) {
  Refined<kMax, 64> opened, fresh;
  each_segment(15, 200, [&](uint32_t i, const Segment& s) {
    CHECK(opened.refinement.split(i % opened.view.collapse_count()));
    mesh::SurfaceCrossing buffer[16];
    if (i % 3 == 0) {
      const hull::RefinedHit hit = opened.refinement.first(s.a, s.b, query::kUnlimited);
      const hull::RefinedHit wanted = fresh.refinement.first(s.a, s.b, query::kUnlimited);
      CHECK(hit.exact);
      CHECK_EQ(hit.hit, wanted.hit);
      CHECK_EQ(hit.triangle, wanted.triangle);
      CHECK_EQ(hit.splits, wanted.splits);
    } else if (i % 3 == 1) {
      const hull::RefinedHit wanted = fresh.refinement.any(s.a, s.b, query::kUnlimited);
      CHECK_EQ(opened.refinement.any(s.a, s.b, query::kUnlimited).hit, wanted.hit);
    } else {
      const hull::RefinedCrossings wanted =
          fresh.refinement.all(s.a, s.b, query::kUnlimited, {buffer});
      const hull::RefinedCrossings found =
          opened.refinement.all(s.a, s.b, query::kUnlimited, {buffer});
      CHECK_EQ(found.found, wanted.found);
      CHECK_EQ(found.splits, wanted.splits);
    }
  });
}

TEST(SegmentBesideTheHull_TestsAndSplitsNothing) {
  Refined<kMax, 4> opened;
  mesh::SurfaceCrossing buffer[4];
  const hull::RefinedHit hit = opened.refinement.first({-3, 4, 1}, {3, 4, 1}, query::kUnlimited);
  CHECK(hit.exact && !hit.hit);
  CHECK_EQ(hit.tests + hit.splits, 0u);
  const hull::RefinedCrossings all =
      opened.refinement.all({-3, 4, 1}, {3, 4, 1}, query::kUnlimited, {buffer});
  CHECK(all.exact && all.found == 0);
  CHECK_EQ(all.tests + all.splits + all.reported, 0u);
}

TEST(ClosureThatDoesNotFit_IsReverted) {
  Refined<12, 4> opened;
  hull::Refinement& refinement = opened.refinement;
  uint32_t refused = 0;
  for (uint32_t turn = 0; turn < 2; ++turn) {
    for (uint32_t k = opened.view.collapse_count(); k-- > 0;) {
      const uint32_t before = refinement.splits().size();
      const bool fits = refinement.split(k);
      refused += fits ? 0u : 1u;
      if (!fits) CHECK_EQ(refinement.splits().size(), before);
      CHECK_EQ(opened.face_count(),
               opened.view.base_hull().face_count() + 2 * refinement.splits().size());
      if (turn == 1) refinement.reset();
    }
    refinement.reset();
  }
  CHECK(refused > 10);
}

TEST(HostileSegments_GiveFiniteResults) {
  Refined<kMax, 8> opened;
  hull::Refinement& refinement = opened.refinement;
  const uint32_t bits[] = {0x00000000, 0x80000001, 0x3F800000, 0xBF800000, 0x4E000000,
                           0x7149F2CA, 0xFF7FFFFF, 0x7F800000, 0x7FC00000, 0xFFFFFFFF};
  for (uint32_t i = 0; i < 1000; ++i) {
    float value[6];
    for (uint32_t k = 0; k < 6; ++k) {
      g_random = g_random * 1664525u + 1013904223u;
      __builtin_memcpy(&value[k], &bits[(g_random >> 12) % 10], 4);
    }
    const Vec3 a{value[0], value[1], value[2]}, b{value[3], value[4], value[5]};
    const hull::RefinedHit hit = refinement.first(a, b, query::kUnlimited);
    const mesh::Hit truth = hull::cast_segment(opened.view, a, b, query::kUnlimited);
    mesh::SurfaceCrossing buffer[4];
    const mesh::Crossings all = hull::all_crossings(opened.view, a, b, query::kUnlimited, {buffer});
    const bool is_finite =
        a.x - a.x + a.y - a.y + a.z - a.z + b.x - b.x + b.y - b.y + b.z - b.z <= 0;
    if (!is_finite) {
      CHECK(!(hit.exact || truth.exact || all.exact));
      CHECK(!refinement.any(a, b, query::kUnlimited).exact);
      CHECK(!refinement.all(a, b, query::kUnlimited, {buffer}).exact);
    }
    CHECK(hit.t >= 0 && hit.t <= 1);
    CHECK(truth.t >= 0 && truth.t <= 1);
    CHECK_EQ(truth.hit, all.found > 0);
    CHECK_EQ(truth.hit, hull::any_crossing(opened.view, a, b, query::kUnlimited).hit);
    CHECK(truth.triangle < opened.view.head().mesh_triangle_count);
  }
}

// The same number on every compiler, level and controller.
TEST(HullAnswersHaveOneHashEverywhere) {
  Refined<40, 6> opened;
  hull::Refinement& refinement = opened.refinement;
  core::Hash hash;
  g_random = 5;
  for (uint32_t i = 0; i < 1000; ++i) {
    const Segment s = through();
    const query::Budget budget{i % 5 == 0 ? 9 : UINT32_MAX};
    const hull::RefinedHit hit = refinement.first(s.a, s.b, budget);
    hash.add(bits_of(hit.t));
    hash.add(hit.triangle);
    hash.add(hit.steps);
    hash.add(hit.splits << 4 | (hit.hit ? 1u : 0u) | (hit.exact ? 2u : 0u) |
             (hit.is_of_mesh ? 4u : 0u));
    mesh::SurfaceCrossing buffer[8];
    const hull::BaseHullHit base_hull =
        hull::cast_base_hull(opened.view.base_hull(), s.a, s.b, budget);
    const hull::BaseHullDistance near =
        hull::base_hull_distance(opened.view.base_hull(), s.a, budget);
    hash.add(bits_of(base_hull.t));
    hash.add(base_hull.face << 1 | (base_hull.exact ? 1u : 0u));
    hash.add(bits_of(near.lower_m));
    hash.add(bits_of(near.point_m.x));
    hash.add(near.steps << 2 | static_cast<uint32_t>(near.side));
    const mesh::Crossings all = hull::all_crossings(opened.view, s.a, s.b, budget, {buffer});
    hash.add(all.found);
    hash.add(all.steps);
    for (uint32_t k = 0; k < all.reported; ++k) hash.add(bits_of(buffer[k].t));
  }
  CHECK_EQ(static_cast<uint32_t>(hash.value()), 22565920u);
}
