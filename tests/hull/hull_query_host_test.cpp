// Queries of baked hulls against brute force in extended precision, and base hulls of every size.
#include <algorithm>
#include <cmath>

#include "../surface/shapes.hpp"
#include "bake/hull/bake_base_hull.hpp"
#include "bumpy_ring.hpp"
#include "firmtouch/hull/complete_cast.hpp"
#include "firmtouch/hull/refinement.hpp"
#include "firmtouch/hull/vertices.hpp"
#include "firmtouch/mesh/segment_cast.hpp"
#include "harness/long.hpp"
#include "harness/test.hpp"
#include "refinement_faces.hpp"
#include "surface/make/make_part.hpp"

namespace firmtouch::tools {
namespace {

using test::is_long;

struct Line {
  math::Vec3 a, b;
};

using Real = long double;
Real volume(const Real (&u)[3], const Real (&v)[3], const Real (&w)[3]) {
  return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
         u[2] * (v[0] * w[1] - v[1] * w[0]);
}

// Every crossing's t, sorted; `is_clear` is false where one is too near an edge or end to decide.
std::vector<double> by_force(const Surface& mesh, const Line& line, bool& is_clear) {
  std::vector<double> found;
  is_clear = true;
  const auto seen = [&](math::Vec3 v, Real(&out)[3]) {
    out[0] = Real{v.x} - Real{line.a.x};
    out[1] = Real{v.y} - Real{line.a.y};
    out[2] = Real{v.z} - Real{line.a.z};
  };
  Real along[3];
  seen(line.b, along);
  for (const Face& face : mesh.faces) {
    Real p[3], q[3], r[3];
    seen(mesh.vertices[face[0]], p);
    seen(mesh.vertices[face[1]], q);
    seen(mesh.vertices[face[2]], r);
    const Real x = volume(along, p, q), y = volume(along, q, r), z = volume(along, r, p);
    const Real low = std::min({x, y, z}), high = std::max({x, y, z}), sum = x + y + z;
    const Real slack = 1e-12L * (std::fabs(x) + std::fabs(y) + std::fabs(z));
    if (low < -slack && high > slack) continue;
    const Real depth = volume(p, q, r), t = depth / sum;
    if (t < -1e-6L || t > 1 + 1e-6L) continue;
    if (!(low > slack || high < -slack) || std::fabs(t) < 1e-6L || std::fabs(t - 1) < 1e-6L)
      is_clear = false;
    found.push_back(static_cast<double>(t));
  }
  std::sort(found.begin(), found.end());
  return found;
}

class Lines {
 public:
  Lines(const Surface& mesh, uint64_t seed) : random_(seed) {
    low_ = high_ = to_point(mesh.vertices[0]);
    for (const math::Vec3& v : mesh.vertices) {
      low_ = {std::min(low_.x, double{v.x}), std::min(low_.y, double{v.y}),
              std::min(low_.z, double{v.z})};
      high_ = {std::max(high_.x, double{v.x}), std::max(high_.y, double{v.y}),
               std::max(high_.z, double{v.z})};
    }
  }
  /// Ends on two sides of the doubled box.
  Line from_outside() {
    const uint32_t one = random_.below(6), other = (one + 1 + random_.below(5)) % 6;
    return {on_side(one), on_side(other)};
  }
  Line anywhere() { return {in_box(), in_box()}; }

 private:
  math::Vec3 at(double x, double y, double z) const {
    const Point c = (low_ + high_) * 0.5, h = high_ - low_;
    return {static_cast<float>(c.x + x * h.x), static_cast<float>(c.y + y * h.y),
            static_cast<float>(c.z + z * h.z)};
  }
  math::Vec3 on_side(uint32_t side) {
    double q[3];
    for (double& each : q) each = random_.between(-1, 1);
    q[side / 2] = side % 2 == 0 ? -1 : 1;
    return at(q[0], q[1], q[2]);
  }
  math::Vec3 in_box() {
    const double x = random_.between(-0.55, 0.55), y = random_.between(-0.55, 0.55),
                 z = random_.between(-0.55, 0.55);
    return at(x, y, z);
  }
  Random random_;
  Point low_, high_;
};

template <class T>
core::Span<T> span(std::vector<T>& items) {
  return {items.data(), static_cast<uint32_t>(items.size())};
}

struct Memory {
  std::vector<uint32_t> bits, splits;
  std::vector<hull::Candidate> candidates;
  Memory(const hull::View& view, uint32_t most, uint32_t crossings)
      : bits(hull::bit_words(view.collapse_count())), splits(most), candidates(crossings) {}
  hull::RefinementMemory spans() { return {span(bits), span(splits), span(candidates)}; }
};

core::Bytes bytes_of_words(const std::vector<uint32_t>& words) {
  return {reinterpret_cast<const uint8_t*>(words.data()), static_cast<uint32_t>(4 * words.size())};
}

// Complete answers from outside and from anywhere: none missed, none made up.
void complete_against_force(const BakedHull& baked, uint32_t count) {
  Lines lines(baked.surface, 3);
  std::vector<mesh::SurfaceCrossing> buffer(256);
  size_t hits = 0, unclear = 0;
  for (uint32_t i = 0; i < count; ++i) {
    test::note("segment", i);
    const Line line = i % 2 == 0 ? lines.from_outside() : lines.anywhere();
    bool is_clear;
    const std::vector<double> wanted = by_force(baked.surface, line, is_clear);
    unclear += is_clear ? 0 : 1;
    if (!is_clear) continue;
    const mesh::Crossings all =
        hull::all_crossings(baked.view, line.a, line.b, query::kUnlimited, span(buffer));
    CHECK(all.exact);
    CHECK_EQ(all.found, wanted.size());
    for (size_t k = 0; k < std::min<size_t>(all.reported, wanted.size()); ++k)
      CHECK_LE(std::fabs(double{buffer[k].t} - wanted[k]), 4e-6);
    const mesh::Hit first = hull::cast_segment(baked.view, line.a, line.b, query::kUnlimited);
    CHECK_EQ(first.hit, !wanted.empty());
    if (first.hit) CHECK_EQ(first.triangle, buffer[0].triangle);
    hits += wanted.size();
  }
  CHECK_LT(count / 4, hits);
  CHECK_LT(unclear * 20, count);
}

void refined_against_complete(const BakedHull& baked, uint32_t base, uint32_t count) {
  const std::vector<uint32_t> words = cut_base_hull(baked.view, base);
  hull::BaseHull base_hull;
  CHECK_EQ(hull::open_base_hull(bytes_of_words(words), baked.view, base_hull).rule, 0);
  Memory memory(baked.view, baked.view.collapse_count(), 64);
  hull::Refinement refinement(baked.view, base_hull, memory.spans());
  Lines lines(baked.surface, 17);
  std::vector<mesh::SurfaceCrossing> all_room(256), buffer(256);
  for (uint32_t i = 0; i < count; ++i) {
    test::note("segment", i);
    const Line line = lines.from_outside();
    const mesh::Crossings all =
        hull::all_crossings(baked.view, line.a, line.b, query::kUnlimited, span(all_room));
    const hull::RefinedHit hit = refinement.first(line.a, line.b, query::kUnlimited);
    CHECK(hit.exact);
    CHECK_EQ(hit.hit, all.found != 0);
    if (all.found == 0) continue;
    CHECK_EQ(hit.triangle, all_room[0].triangle);
    const hull::RefinedCrossings found =
        refinement.all(line.a, line.b, query::kUnlimited, span(buffer));
    CHECK_LT(0u, found.found);
    if (found.found == 0) continue;
    CHECK_EQ(buffer[0].triangle, all_room[0].triangle);
    CHECK_EQ(buffer[found.reported - 1].triangle, all_room[all.reported - 1].triangle);
  }
}

void restores(const BakedHull& baked, uint32_t base) {
  test::note("base", base);
  const std::vector<uint32_t> words = cut_base_hull(baked.view, base);
  hull::BaseHull base_hull;
  CHECK_EQ(hull::open_base_hull(bytes_of_words(words), baked.view, base_hull).rule, 0);
  CHECK_LE(base_hull.face_count(), std::max(base, baked.view.base_hull().face_count()));
  Memory memory(baked.view, base_hull.head().cut + 1, 4);
  hull::Refinement refinement(baked.view, base_hull, memory.spans());
  for (uint32_t k = 0; k < base_hull.head().cut; ++k) CHECK(refinement.split(k));
  std::vector<Face> found, wanted = baked.surface.faces;
  for (hull_test::RefinementFaces faces(baked.view, base_hull, refinement); faces.next();)
    found.push_back({faces.number[0], faces.number[1], faces.number[2]});
  for (std::vector<Face>* faces : {&found, &wanted}) {
    for (Face& f : *faces)
      while (f[0] > f[1] || f[0] > f[2]) f = {f[1], f[2], f[0]};
    std::sort(faces->begin(), faces->end());
  }
  CHECK(found == wanted);
}

}  // namespace

TEST(CompleteAnswersAreThoseOfBruteForceFromOutsideAndFromAnywhere) {
  complete_against_force(BakedHull(make_part(1, 3000), 300, 22), is_long() ? 20000 : 800);
  complete_against_force(BakedHull(bumpy_ring(16, 8, 0.2), 200, 16), is_long() ? 20000 : 800);
}

TEST(FromEveryBaseFirstAndLastCrossingAreTheMeshs) {
  const BakedHull baked(make_part(1, 3000), 200, 16);
  for (const uint32_t base : {200u, 500u, 1500u, 2900u}) {
    test::note("base", base);
    refined_against_complete(baked, base, is_long() ? 10000 : 400);
  }
}

TEST(SplittingEverythingRestoresTheMeshFromEveryBaseHull) {
  const BakedHull baked(make_part(1, 3000), 200, 22);
  for (const uint32_t base : {4u, 200u, 700u, 1501u, 2500u, 1000000u}) restores(baked, base);
}

TEST(BaseHullOfTheAsset_IsTheCoarsest_SameBytesWhenCutAgain) {
  const BakedHull baked(bumpy_ring(8, 4), 100, 16);
  const std::vector<uint32_t> words = cut_base_hull(baked.view, 4);
  const core::Bytes stored = sections_of<hull::Sections>(baked.sections, "model").base_hull;
  CHECK_EQ(stored.size(), 4 * words.size());
  CHECK(std::memcmp(stored.data(), words.data(), stored.size()) == 0);
}

TEST(R549AHullsOwnBaseHullIsTheCoarsest) {
  const BakedHull baked(bumpy_ring(8, 4), 100, 16);
  const std::vector<uint32_t> finer = cut_base_hull(baked.view, 300);
  hull::Sections sections = sections_of<hull::Sections>(baked.sections, "model");
  sections.base_hull = bytes_of_words(finer);
  hull::View view;
  CHECK_EQ(hull::open(sections, view).rule, 549);
}

// What is stored is what was proven outside, to the bit.
TEST(StoredVerticesAreTheProvenOnes) {
  for (const uint32_t bits : {16u, 22u}) {
    const BakedHull baked(make_part(1, 2000), 200, bits);
    HullOptions options;
    options.target_faces = 200;
    options.grid_bits = bits;
    HullReport report;
    Surface surface = baked.surface;
    for (uint32_t f = 0; f < surface.faces.size(); ++f) surface.source.push_back(f);
    const ProgressiveHull built = build_hull(surface, options, report);
    CHECK_EQ(built.collapses.size(), baked.view.collapse_count());
    for (uint32_t n = 0; n < built.vertices_m.size(); ++n) {
      const math::Vec3 here = hull::vertex(baked.view, n), there = built.vertices_m[n];
      CHECK(std::memcmp(&here, &there, sizeof here) == 0);
    }
  }
}

TEST(MeshWithFewerFacesThanTarget_IsItsOwnHull) {
  const BakedHull baked(cube(), 1000, 22);
  CHECK_EQ(baked.view.collapse_count(), 0u);
  CHECK_EQ(baked.view.base_hull().face_count(), 12u);
  Memory memory(baked.view, 1, 8);
  hull::Refinement refinement(baked.view, baked.view.base_hull(), memory.spans());
  const hull::RefinedHit hit =
      refinement.first({-3, 0.1f, 0.2f}, {3, 0.1f, 0.2f}, query::kUnlimited);
  CHECK(hit.exact && hit.is_of_mesh);
  CHECK_LE(std::fabs(double{hit.t} - 1.0 / 3), 1e-6);
}

}  // namespace firmtouch::tools
