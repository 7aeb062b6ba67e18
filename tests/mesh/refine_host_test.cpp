// Machined parts with their long triangles made compact: the surface stays where it was, closed,
// and every face still names one of the file's.
#include "bake/mesh/refine.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "bake/mesh/turn_slivers.hpp"
#include "brute_force.hpp"
#include "harness/test.hpp"
#include "surface/edges.hpp"
#include "surface/make/make_cad.hpp"
#include "surface/make/make_part.hpp"
#include "true_distance.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT

constexpr uint64_t kSeeds = 2 * tools::kCadKinds;  // half of them turned askew
constexpr double kMaxMove = 5e-8;                  // in diagonals

struct Both {
  tools::Surface given, refined;
  tools::Refined report;

  explicit Both(const tools::Surface& surface, double max_move = kMaxMove) : given(surface) {
    for (uint32_t f = 0; f < given.faces.size(); ++f) given.source.push_back(f);
    tools::longest_edge_first(given);
    refined = given;
    report = tools::refine(refined, max_move * diagonal(given));
  }
};

Both part(uint64_t seed) { return Both(tools::to_surface(tools::make_cad(seed))); }

Point corner(const tools::Surface& surface, const tools::Face& face, size_t k) {
  return wide(surface.vertices[face[k]]);
}

// Of its longest edges, how many are longer than half of the longest of `given`.
size_t long_edges(const tools::Surface& surface, const tools::Surface& given) {
  const auto longest_of = [](const tools::Surface& of, const tools::Face& face) {
    double longest = 0;
    for (size_t k = 0; k < 3; ++k)
      longest = std::max(longest, length(corner(of, face, (k + 1) % 3) - corner(of, face, k)));
    return longest;
  };
  double longest = 0;
  for (const tools::Face& face : given.faces) longest = std::max(longest, longest_of(given, face));
  size_t count = 0;
  for (const tools::Face& face : surface.faces)
    count += longest_of(surface, face) > longest / 2 ? 1u : 0u;
  return count;
}

double area(const tools::Surface& surface) {
  double sum = 0;
  for (const tools::Face& face : surface.faces)
    sum += length(cross(corner(surface, face, 1) - corner(surface, face, 0),
                        corner(surface, face, 2) - corner(surface, face, 0))) /
           2;
  return sum;
}

double distance_to(const tools::Surface& surface, Point p) {
  double least = 1e300;
  for (const tools::Face& face : surface.faces)
    least = std::min(least, true_distance(p, corner(surface, face, 0), corner(surface, face, 1),
                                          corner(surface, face, 2)));
  return least;
}

// How far random points of `from`, and all of its corners, lie from `to`.
double farthest(const tools::Surface& from, const tools::Surface& to, uint64_t seed) {
  Random random(seed);
  double most = 0;
  for (size_t i = 0; i < (long_run() ? 4000u : 400u); ++i) {
    const tools::Face& face = from.faces[random.next() % from.faces.size()];
    double v = random.between(0, 1), w = random.between(0, 1);
    if (v + w > 1) v = 1 - v, w = 1 - w;
    if (i % 4 == 0) v = w = 0;
    const Point a = corner(from, face, 0);
    most = std::max(most, distance_to(to, a + (corner(from, face, 1) - a) * v +
                                              (corner(from, face, 2) - a) * w));
  }
  return most;
}

// Each edge of two faces that pass it either way.
bool is_closed_and_alike(const tools::Surface& surface) {
  std::map<std::pair<uint32_t, uint32_t>, int> passes;
  for (const tools::Face& face : surface.faces)
    for (size_t k = 0; k < 3; ++k)
      if (++passes[{face[k], face[(k + 1) % 3]}] > 1) return false;
  for (const auto& [edge, count] : passes)
    if (passes.count({edge.second, edge.first}) == 0) return false;
  return true;
}

// A bar whose long faces are cut as fans: all of one rim at a corner of the other.
tools::Surface bar_of_fans(uint32_t count) {
  const uint32_t rim_count = count + 1;
  tools::Surface bar;
  for (uint32_t rim = 0; rim < 4; ++rim)
    for (uint32_t i = 0; i < rim_count; ++i)
      bar.vertices.push_back(
          {float(i) / float(count), (rim & 1u) != 0 ? 0.1f : 0.0f, (rim & 2u) != 0 ? 0.1f : 0.0f});
  const auto strip = [&](uint32_t one, uint32_t other) {
    for (uint32_t i = 0; i < count; ++i) {
      bar.faces.push_back({other * rim_count, one * rim_count + i, one * rim_count + i + 1});
      bar.faces.push_back(
          {one * rim_count + count, other * rim_count + i + 1, other * rim_count + i});
    }
  };
  strip(1, 0), strip(3, 1), strip(2, 3), strip(0, 2);
  for (const uint32_t i : {0u, count}) {
    const uint32_t a = i, b = rim_count + i, c = 3 * rim_count + i, d = 2 * rim_count + i;
    bar.faces.push_back(i == 0 ? tools::Face{a, c, b} : tools::Face{a, b, c});
    bar.faces.push_back(i == 0 ? tools::Face{a, d, c} : tools::Face{a, c, d});
  }
  return bar;
}

// A prism of `count` long sides, all cut so that each triangle's longest edge begins at its tip.
tools::Surface prism_of_tips(uint32_t count) {
  tools::Surface prism;
  for (uint32_t end = 0; end < 2; ++end) {
    for (uint32_t i = 0; i < count; ++i) {
      const double angle = 2 * 3.14159265358979 * i / count;
      prism.vertices.push_back(
          {float(end), float(0.1 * std::cos(angle)), float(0.1 * std::sin(angle))});
    }
  }
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t a = i, b = (i + 1) % count, c = count + b, d = count + i;
    prism.faces.push_back({a, c, d});
    prism.faces.push_back({a, b, c});
    if (i == 0 || i + 1 == count) continue;
    prism.faces.push_back({0, i + 1, i});
    prism.faces.push_back({count, d, c});
  }
  for (tools::Face& face : prism.faces) std::swap(face[1], face[2]);
  return prism;
}

// How far the middle of the long faces lies from where their longest edges begin, on average.
double mean_reach(tools::Surface surface) {
  tools::longest_edge_first(surface);
  double sum = 0;
  uint32_t count = 0;
  for (const tools::Face& face : surface.faces) {
    const Point a = corner(surface, face, 0), b = corner(surface, face, 1),
                c = corner(surface, face, 2);
    if (length(b - a) < 0.9) continue;
    sum += length((a + b + c) * (1.0 / 3) - a);
    ++count;
  }
  return sum / count;
}

uint32_t largest_valence(const tools::Surface& surface) {
  std::vector<uint32_t> valence(surface.vertices.size());
  for (const tools::Face& face : surface.faces)
    for (const uint32_t v : face) ++valence[v];
  return *std::max_element(valence.begin(), valence.end());
}

}  // namespace

TEST(Refine_MachinedPart_MovesNoFartherThanItReports) {
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    const Both both = part(seed);
    const double within = both.report.moved_m + 1e-15;
    CHECK(both.report.any());
    CHECK_LE(both.report.moved_m, kMaxMove * diagonal(both.given));
    CHECK_LE(farthest(both.given, both.refined, seed), within);
    CHECK_LE(farthest(both.refined, both.given, seed), within);
    CHECK_LE(std::fabs(area(both.refined) / area(both.given) - 1), 1e-6);
  }
}

TEST(Refine_MachinedPart_StaysClosedAndManifold) {
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    const Both both = part(seed);
    CHECK(is_closed_and_alike(both.refined));
    // Euler's number: neither a hole nor a handle is made.
    const auto euler = [](const tools::Surface& s) {
      return static_cast<int64_t>(s.vertices.size()) - static_cast<int64_t>(s.faces.size() / 2);
    };
    CHECK_EQ(euler(both.refined), euler(both.given));
  }
}

TEST(Refine_MachinedPart_HalvesLongEdgesOrAddsNothing) {
  uint32_t halved = 0;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    const Both both = part(seed);
    CHECK_LE(both.refined.faces.size(),
             static_cast<size_t>(tools::kMaxGrowth * double(both.given.faces.size())));
    const bool is_split = both.report.splits != 0;
    halved += is_split ? 1u : 0u;
    CHECK_EQ(both.refined.faces.size(), both.given.faces.size() + 2 * both.report.splits);
    // Beside slivers, edges must stay.
    if (is_split) CHECK_LE(long_edges(both.refined, both.given), both.given.faces.size() / 100);
  }
  CHECK_GT(halved, 2u);
}

TEST(Refine_MachinedPart_EachFaceLiesInThePlaneOfItsSource) {
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    const Both both = part(seed);
    CHECK_EQ(both.refined.source.size(), both.refined.faces.size());
    for (size_t f = 0; f < both.refined.faces.size(); ++f) {
      const tools::Face& source = both.given.faces[both.refined.source[f]];
      const Point a = corner(both.given, source, 0), ab = corner(both.given, source, 1) - a,
                  ac = corner(both.given, source, 2) - a, n = cross(ab, ac);
      if (length(n) < 1e-3 * dot(ab, ab)) continue;  // too thin to have a sound plane
      for (size_t k = 0; k < 3; ++k)
        CHECK_LE(std::fabs(dot(corner(both.refined, both.refined.faces[f], k) - a, n)) / length(n),
                 1e-4 * diagonal(both.given));
    }
  }
}

TEST(Refine_Scan_StaysAsItIs) {
  const Both both(tools::make_part(1, 5000));
  CHECK(!both.report.any());
  CHECK(both.refined.faces == both.given.faces);
}

TEST(Refine_NothingMayMove_LeavesAskewPartsFlat) {
  for (uint64_t seed = tools::kCadKinds; seed < kSeeds; ++seed) {
    const Both both(tools::to_surface(tools::make_cad(seed)), 0);
    CHECK_EQ(both.report.moved_m, 0.0);
    CHECK_LE(farthest(both.given, both.refined, seed), 1e-15);
  }
}

TEST(Refine_Fans_BecomeCompact) {
  const Both both(bar_of_fans(150));
  CHECK(is_closed_and_alike(both.given));
  CHECK_GT(largest_valence(both.given), 150u);
  CHECK(is_closed_and_alike(both.refined));
  CHECK_LT(largest_valence(both.refined), 20u);
}

TEST(Refine_LongRectangles_LongestEdgesBeginWhereTrianglesAreWide) {
  const tools::Surface mirrored = [] {
    tools::Surface turned = prism_of_tips(160);
    for (math::Vec3& v : turned.vertices) v.x = -v.x;
    for (tools::Face& face : turned.faces) std::swap(face[1], face[2]);
    return turned;
  }();
  const double tips = mean_reach(prism_of_tips(160)), wide_ends = mean_reach(mirrored);
  const double larger = std::max(tips, wide_ends), smaller = std::min(tips, wide_ends);
  CHECK_GT(larger, 0.66);
  CHECK_LT(smaller, 0.34);
  for (const tools::Surface& given : {prism_of_tips(160), mirrored}) {
    Both both(given);
    both.refined = both.given;
    tools::refine(both.refined, kMaxMove * diagonal(given), 1);
    CHECK(is_closed_and_alike(both.given));
    CHECK(is_closed_and_alike(both.refined));
    CHECK_LT(mean_reach(both.refined), 0.34);
  }
}

TEST(Refine_FansOfThousands_EndAndStayClosed) {
  const uint32_t count = long_run() ? 10000 : 2000;
  const Both both(bar_of_fans(count));
  CHECK_GT(both.report.flips, count);
  CHECK_LE(both.report.flips, 53 * both.given.faces.size());  // 32 for each of 1.65 times the faces
  CHECK(is_closed_and_alike(both.refined));
}
