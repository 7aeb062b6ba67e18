// Distances, sides and certificates against brute force in double, on the demo's part and on real
// models.
#include <cmath>
#include <map>
#include <thread>

#include "baked_mesh.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/direction.hpp"
#include "firmtouch/mesh/nearest_answer.hpp"
#include "harness/test.hpp"
#include "surface/crossings.hpp"
#include "surface/make/make_cad.hpp"
#include "surface/make/make_part.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT
using math::Vec3;

// On two threads: brute force is what takes the time.
std::vector<Truth> truths(const tools::Surface& surface, const std::vector<Vec3>& queries) {
  const BruteForce brute_force(surface);
  std::vector<Truth> result(queries.size());
  const auto work = [&](size_t first) {
    for (size_t i = first; i < queries.size(); i += 2) result[i] = brute_force(wide(queries[i]));
  };
  std::thread other(work, 1);
  work(0);
  other.join();
  return result;
}

// Of the model as its file has it: any vertex may be off by the rounding of its coordinates.
void check_answer(const BakedMesh& baked, const mesh::Closest& c, const Truth& truth,
                  bool crosses_itself) {
  const double scale = std::max(baked.size, truth.distance),
               reported = std::fabs(double{c.distance_m});
  CHECK_LE(truth.distance - reported, 4e-7 * scale);
  const double rounding = double{baked.view.head().rounding_m} - baked.moved_m;
  const double least = std::max(0.0, truth.distance - rounding), most = truth.distance + rounding;
  CHECK_LE(double{c.certificate.lower_m}, least + 1e-12 * scale);
  if (!c.certificate.exact) return;
  CHECK_LE(reported - least, 4e-7 * scale);
  CHECK_LE(most - reported, 4e-7 * scale);
  CHECK_LE(truth.distance - double{c.certificate.lower_m}, 4e-7 * scale);
  if (truth.distance > 2e-6 * baked.size && !crosses_itself)
    CHECK_EQ(c.certificate.sign, truth.inside ? -1 : 1);
}

// Whether the closest point lies where the surface crosses itself: there winding number and
// pseudonormal disagree and either side is right.
bool at_crossing(const BakedMesh& baked, const tools::Crossings& crossings, Vec3 point) {
  for (const auto& pair : crossings.pairs)
    for (const uint32_t face : {pair.first, pair.second})
      for (const uint32_t corner : baked.surface.faces[face])
        if (length(wide(baked.surface.vertices[corner]) - wide(point)) < 0.005 * baked.size)
          return true;
  return false;
}

// Whether the roundings of the point and the pseudonormal may hide the side, and the answer is not
// exact: square to the pseudonormal, or within 28 units of float32 of the longest edge.
bool may_hide_side(const BakedMesh& baked, Vec3 p_m, const mesh::Closest& c, const Truth& truth) {
  const double height_m = std::fabs(dot(wide(p_m) - wide(c.point_m), wide(c.direction)));
  return height_m < 6e-5 * truth.distance + 28 * 0x1p-24 * double{baked.view.head().longest_edge_m};
}

void against_brute_force(const BakedMesh& baked, size_t count, uint64_t seed,
                         bool has_hidden_sides = false) {
  const std::vector<Vec3> queries = hard_queries(baked.surface, count, seed);
  const std::vector<Truth> truth = truths(baked.surface, queries);
  const tools::Crossings crossings = tools::find_crossings(baked.surface);
  mesh::Hint warm;
  for (size_t i = 0; i < queries.size(); ++i) {
    test::note("query", static_cast<int64_t>(i));
    mesh::Hint cold;
    for (mesh::Hint* hint : {&warm, &cold}) {
      const mesh::Closest c = mesh::closest_point(baked.view, queries[i], query::kUnlimited, *hint);
      CHECK(c.certificate.exact ||
            (has_hidden_sides && may_hide_side(baked, queries[i], c, truth[i])));
      check_answer(baked, c, truth[i], at_crossing(baked, crossings, c.point_m));
    }
  }
}

// Of radius 1 m and 2.4 m long about the origin, with a fan from one corner at either end.
tools::Surface cylinder_of(uint32_t sides) {
  tools::Surface surface;
  const uint32_t rings = 3, last = (rings - 1) * sides;
  for (uint32_t i = 0; i < rings * sides; ++i)
    surface.vertices.push_back({static_cast<float>(std::cos(2 * M_PI * i / sides)),
                                static_cast<float>(std::sin(2 * M_PI * i / sides)),
                                1.2f * (static_cast<float>(i / sides) - 1)});
  for (uint32_t ring = 0; ring < last; ring += sides) {
    for (uint32_t i = 0; i < sides; ++i) {
      const uint32_t here = ring + i, next = ring + (i + 1) % sides;
      surface.faces.push_back({here, next, here + sides});
      surface.faces.push_back({here + sides, next, next + sides});
    }
  }
  for (uint32_t i = 1; i + 1 < sides; ++i) {
    surface.faces.push_back({0, i + 1, i});
    surface.faces.push_back({last, last + i, last + i + 1});
  }
  return surface;
}

void against_real_model(const char* file, size_t daily, size_t whole) {
  if (models_folder().empty()) return test::skip("FIRMTOUCH_MODELS names no folder of real models");
  const BakedMesh baked(real_model(file));
  CHECK(!baked.surface.faces.empty());
  if (baked.surface.faces.empty()) return;
  against_brute_force(baked, long_run() ? whole : daily, 11);
}

}  // namespace

// Where coordinates are as coarse as a lower bound still covers.
TEST(PartFarFromItsOrigin_AnswersForTheFilesModel) {
  tools::Surface surface = tools::make_part(1, 1000);
  const float away = static_cast<float>(1.3 * diagonal(surface));
  for (Vec3& v : surface.vertices) v = {v.x - away, v.y + away, v.z + away};
  const BakedMesh baked(surface);
  CHECK(baked.view.head().rounding_m > 0.5f * mesh::kMaxRounding * baked.view.head().diagonal_m);
  against_brute_force(baked, long_run() ? 40000 : 4000, 5);
}
TEST(PartAnswersLikeBruteForce) { against_brute_force(part(), 20000 / 4, 3); }
TEST(SpotAnswersLikeBruteForce) { against_real_model("spot.obj", 20000, 20000); }
TEST(RockerArmAnswersLikeBruteForce) { against_real_model("rocker-arm.off", 20000, 20000); }
TEST(FandiskAnswersLikeBruteForce) { against_real_model("fandisk.obj", 20000, 20000); }
TEST(HorseAnswersLikeBruteForce) { against_real_model("horse.ply", 2000, 20000); }

// Few large triangles, long thin ones, fans: float32 alone keeps no promise, and rivals decide.
TEST(MachinedPartsAnswerLikeBruteForce) {
  for (uint64_t seed = 0; seed < 4 * tools::kCadKinds; ++seed) {
    const tools::Surface part = tools::to_surface(tools::make_cad(seed));
    against_brute_force(BakedMesh(part), long_run() ? 100000 : 300, seed, true);
    tools::MeshOptions as_given;
    as_given.max_growth = 0;
    const BakedMesh baked(part, as_given);
    CHECK(baked.view.has_rivals());
    against_brute_force(baked, long_run() ? 10000 : 300, seed, true);
  }
}

// From its axis all sides of a cylinder are equally near, and about a corner of its fans many
// triangles: more than the rivals that are kept. Only a bound of the others is, which mostly
// saves measuring all again.
TEST(MoreRivalsThanAreKept_AnswerLikeBruteForce) {
  constexpr uint32_t kSides = 160;
  const tools::Surface cylinder = cylinder_of(kSides);
  tools::MeshOptions as_given;
  as_given.max_growth = 0;
  const BakedMesh baked(cylinder, as_given);
  CHECK(baked.view.has_rivals());
  Random random(29);
  const auto at = [&](double reach_m) {
    return static_cast<float>(random.between(-1, 1) * reach_m);
  };
  std::vector<Vec3> queries;
  for (uint32_t i = 0; i < (long_run() ? 20000u : 600u); ++i) {
    const double reach_m = std::exp(random.between(-14, -7));
    const Vec3 from_m = i % 3 == 0 ? cylinder.vertices[0] : Vec3{0, 0, at(0.1)};
    const float x_m = from_m.x + at(reach_m), y_m = from_m.y + at(reach_m);
    queries.push_back({x_m, y_m, from_m.z + at(reach_m)});
  }
  const std::vector<Truth> truth = truths(cylinder, queries);
  mesh::Hint warm;
  uint64_t work_about_axis = 0;
  for (size_t i = 0; i < queries.size(); ++i) {
    test::note("query", static_cast<int64_t>(i));
    mesh::Hint cold;
    for (mesh::Hint* hint : {&warm, &cold}) {
      const mesh::Closest c = mesh::closest_point(baked.view, queries[i], query::kUnlimited, *hint);
      CHECK(c.certificate.exact || truth[i].distance < 4e-6 * baked.size);
      check_answer(baked, c, truth[i], false);
      if (i % 3 != 0) work_about_axis += c.certificate.work;
    }
  }
  // To measure all again takes eight times as much.
  CHECK_LE(work_about_axis / (queries.size() * 4 / 3), 1000u);
}

// Brute force does not see it: float32 loses far less than its bound.
TEST(RivalsThatAreNotKept_BoundTheAnswer) {
  tools::MeshOptions as_given;
  as_given.max_growth = 0;
  const BakedMesh baked(cylinder_of(160), as_given);
  const mesh::View& view = baked.view;
  Random random(31);
  const auto at = [&](double reach_m) {
    return static_cast<float>(random.between(-1, 1) * reach_m);
  };
  uint64_t let_go = 0;
  for (int i = 0; i < 200; ++i) {
    const double reach_m = std::exp(random.between(-14, -7));
    const Vec3 p_m{at(reach_m), at(reach_m), at(0.1)};
    mesh::NearBound bound;
    CHECK(bound.begin(view.head(), mesh::in_box_frame(view, p_m)));
    mesh::Search search;
    search.p_m = p_m;
    search.slack_m2 = mesh::Nearer::slack_m2(view.head().longest_edge_m);
    search.start = query::kNowhere;
    search.budget = UINT32_MAX;
    search.band2_m2 = FLT_MAX;
    CHECK((mesh::search_nearest<false, mesh::NearBound, mesh::WithRivals>(view, bound, search)));
    const mesh::Rivals& rivals = search.rivals;
    std::vector<uint32_t> known{search.best.triangle};
    for (uint32_t k = 0; k < rivals.count; ++k) known.push_back(rivals.triangle(k));
    float rest_m = FLT_MAX;
    for (uint32_t t = 0; t < view.head().triangle_count; ++t) {
      const mesh::Corners corners(view, t);
      mesh::Foot foot;
      mesh::find_foot_apart(p_m, {corners.a_m, corners.b_m, corners.c_m},
                            mesh::Nearer::than_nothing(), foot);
      if (!(foot.distance2_m2 < rivals.limit2_m2(search.best.distance2_m2)) ||
          std::count(known.begin(), known.end(), t) != 0)
        continue;
      const float distance_m = std::sqrt(foot.distance2_m2);
      rest_m = std::min(rest_m, distance_m - mesh::own_loss_m(mesh::Loss(view.head()), corners,
                                                              foot.feature, distance_m));
      ++let_go;
    }
    CHECK_LE(rivals.rest_m, rest_m);
    mesh::Hint hint;
    const mesh::Closest c = mesh::closest_point(view, p_m, query::kUnlimited, hint);
    if (c.certificate.work < 1000) CHECK_LE(c.certificate.lower_m, rest_m);
  }
  CHECK_LE(200u * 100u, let_go);
}

TEST(EveryBudgetIsCertifiedColdAndWarm) {
  const BakedMesh& baked = part();
  const std::vector<Vec3> queries = hard_queries(baked.surface, 600, 5);
  const std::vector<Truth> truth = truths(baked.surface, queries);
  std::map<uint32_t, mesh::Hint> warm;
  for (size_t i = 0; i < queries.size(); ++i) {
    test::note("query", static_cast<int64_t>(i));
    float gap = 3e38f;
    for (const uint32_t budget : {1u, 2u, 4u, 8u, 16u, 32u, 64u, 128u, 256u, 0xFFFFFFFFu}) {
      mesh::Hint cold;
      const mesh::Closest c = mesh::closest_point(baked.view, queries[i], {budget}, cold);
      CHECK_LE(c.certificate.work, budget);
      check_answer(baked, c, truth[i], false);
      const float now = std::fabs(c.distance_m) - c.certificate.lower_m;
      CHECK_LE(
          now,
          gap * (1 + 1e-6f) + 1e-9f);  // never grows, except for the rounding of the difference
      gap = now;
      check_answer(baked, mesh::closest_point(baked.view, queries[i], {budget}, warm[budget]),
                   truth[i], false);
    }
    CHECK(gap < 3e38f);
  }
}

// A query that ran out begins at the leaf where it ended.
TEST(StandingStill_ShortQuery_CertificateOnlyImproves) {
  const BakedMesh& baked = part();
  Random random(17);
  std::vector<Vec3> queries;
  for (int i = 0; i < 600; ++i) {
    const double reach_m = i % 2 == 0 ? 0.075 : 0.04;
    const auto at = [&] { return static_cast<float>(random.between(-reach_m, reach_m)); };
    const float x = at(), y = at();
    queries.push_back({x, y, at()});
  }
  const std::vector<Truth> truth = truths(baked.surface, queries);
  int at_once = 0, in_the_end = 0, raised = 0;
  for (size_t i = 0; i < queries.size(); ++i) {
    test::note("query", static_cast<int64_t>(i));
    mesh::Hint hint;
    mesh::Closest before = mesh::closest_point(baked.view, queries[i], {40}, hint);
    const mesh::Closest first = before;
    for (int tick = 1; tick < 40; ++tick) {
      const mesh::Closest now = mesh::closest_point(baked.view, queries[i], {40}, hint);
      check_answer(baked, now, truth[i], false);
      CHECK_LE(std::fabs(now.distance_m), std::fabs(before.distance_m));
      CHECK_GE(now.certificate.lower_m, before.certificate.lower_m);
      before = now;
    }
    at_once += first.certificate.exact ? 1 : 0;
    in_the_end += before.certificate.exact ? 1 : 0;
    raised += before.certificate.lower_m > first.certificate.lower_m * 1.001f ? 1 : 0;
  }
  CHECK_LE(at_once + 5, in_the_end);
  CHECK_LE(20, raised);
}

// A hint certifies what is near its position; this position is none, or infinitely far.
TEST(HintOfNoPosition_CarriesNothingOn) {
  const BakedMesh& baked = part();
  const float nowhere[] = {NAN, HUGE_VALF, 1e30f};
  Random random(23);
  const auto at = [&](double reach_m) {
    return static_cast<float>(random.between(-1, 1) * reach_m);
  };
  for (int i = 0; i < 6000; ++i) {
    const Vec3 p{at(0.075), at(0.075), at(0.04)};
    mesh::Hint hint, cold;
    mesh::closest_point(baked.view, p, query::kUnlimited, hint);
    mesh::closest_point(baked.view, {p.x + 1e-6f, p.y, p.z}, query::kUnlimited, hint);
    hint.position_m.x = nowhere[i % 3];
    const Vec3 to{p.x + at(0.005), p.y + at(0.005), p.z + at(0.005)};
    const mesh::Closest c = mesh::closest_point(baked.view, to, query::kUnlimited, hint);
    const mesh::Closest right = mesh::closest_point(baked.view, to, query::kUnlimited, cold);
    CHECK_LE(std::fabs(c.distance_m - right.distance_m), 1e-8f);
    CHECK_LE(c.certificate.lower_m, std::fabs(right.distance_m));
  }
}

TEST(SixtyFourStepsGiveAGoodLowerBound) {
  const BakedMesh& baked = part();
  Random random(9);
  std::vector<double> share;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p{static_cast<float>(random.between(-0.075, 0.075)),
                 static_cast<float>(random.between(-0.075, 0.075)),
                 static_cast<float>(random.between(-0.05, 0.05))};
    mesh::Hint cold, whole;
    const mesh::Closest c = mesh::closest_point(baked.view, p, {64}, cold);
    const mesh::Closest truth = mesh::closest_point(baked.view, p, query::kUnlimited, whole);
    share.push_back(double{c.certificate.lower_m} /
                    std::max(1e-12, std::fabs(double{truth.distance_m})));
  }
  std::sort(share.begin(), share.end());
  CHECK_GE(share[share.size() / 2], 0.85);
}

TEST(TwoToolsShareOneMesh) {
  const BakedMesh& baked = part();
  const std::vector<Vec3> a = hard_queries(baked.surface, 200, 1),
                          b = hard_queries(baked.surface, 200, 2);
  mesh::Hint hint_a, hint_b, alone;
  for (size_t i = 0; i < a.size(); ++i) {
    const mesh::Closest together = mesh::closest_point(baked.view, a[i], query::kUnlimited, hint_a);
    (void)mesh::closest_point(baked.view, b[i], query::kUnlimited, hint_b);
    const mesh::Closest apart = mesh::closest_point(baked.view, a[i], query::kUnlimited, alone);
    CHECK(!(together.distance_m < apart.distance_m || together.distance_m > apart.distance_m));
    CHECK_EQ(together.triangle, apart.triangle);
    CHECK_EQ(together.certificate.steps, apart.certificate.steps);
  }
}
