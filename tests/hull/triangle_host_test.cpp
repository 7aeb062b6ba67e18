// Triangles and rays against brute force.
#include <array>
#include <cmath>
#include <map>

#include "../surface/shapes.hpp"
#include "bumpy_ring.hpp"
#include "firmtouch/hull/base_hull_cast.hpp"
#include "firmtouch/hull/complete_cast.hpp"
#include "firmtouch/hull/ray.hpp"
#include "firmtouch/hull/refinement.hpp"
#include "firmtouch/hull/triangle_cast.hpp"
#include "surface/make/make_part.hpp"

namespace firmtouch::tools {
namespace {

using Real = long double;
struct At {
  Real x, y, z;
};
At at(math::Vec3 v) { return {Real{v.x}, Real{v.y}, Real{v.z}}; }
At operator-(At a, At b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Real volume(At u, At v, At w) {
  return u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) +
         u.z * (v.x * w.y - v.y * w.x);
}

struct Three {
  math::Vec3 corner[3];
};

// Whether a segment passes through a triangle; `is_clear` is false where that is near an edge or
// end.
bool passes(At a, At b, At p, At q, At r, bool& is_clear) {
  const At way = b - a;
  const Real x = volume(way, p - a, q - a), y = volume(way, q - a, r - a),
             z = volume(way, r - a, p - a), slack = 1e-13L;
  if (std::min({x, y, z}) < -slack && std::max({x, y, z}) > slack) return false;
  const Real depth = volume(p - a, q - a, r - a), t = depth / (x + y + z);
  if (t < -1e-6L || t > 1 + 1e-6L) return false;
  if (!(std::min({x, y, z}) > slack || std::max({x, y, z}) < -slack) || t < 1e-6L || t > 1 - 1e-6L)
    is_clear = false;
  return true;
}

bool crosses(const Three& one, const Three& other, bool& is_clear) {
  bool found = false;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    found |= passes(at(one.corner[i]), at(one.corner[j]), at(other.corner[0]), at(other.corner[1]),
                    at(other.corner[2]), is_clear);
    found |= passes(at(other.corner[i]), at(other.corner[j]), at(one.corner[0]), at(one.corner[1]),
                    at(one.corner[2]), is_clear);
  }
  return found;
}

Three face_of(const hull::View& view, uint32_t i) {
  const mesh::Triangle<uint32_t> t = view.triangle(i);
  return {{view.mesh_vertex(t.corner[0]), view.mesh_vertex(t.corner[1]),
           view.mesh_vertex(t.corner[2])}};
}

// Large and small ones, about the box and within it.
class Threes {
 public:
  Threes(const mesh::Head& head, uint64_t seed) : head_(head), random_(seed) {}
  math::Vec3 somewhere(double reach) {
    float p[3];
    for (int k = 0; k < 3; ++k) {
      const double low = double{head_.low_m[k]}, side = double{head_.high_m[k]} - low;
      p[k] = static_cast<float>(low + side * (0.5 + reach * random_.between(-1, 1)));
    }
    return {p[0], p[1], p[2]};
  }
  Three next(int i) {
    if (i % 2 == 0) return {{somewhere(0.8), somewhere(0.8), somewhere(0.8)}};
    const math::Vec3 a = somewhere(0.55);
    const auto beside = [&] {
      const math::Vec3 b = somewhere(0.06), middle = somewhere(0);
      return math::Vec3{a.x + b.x - middle.x, a.y + b.y - middle.y, a.z + b.z - middle.z};
    };
    const math::Vec3 b = beside(), c = beside();
    return {{a, b, c}};
  }

 private:
  const mesh::Head& head_;
  Random random_;
};

// A cube from -1 to 1, squares of a quarter, two triangles each.
Surface grid_cube() {
  Surface surface;
  std::map<std::array<int, 3>, uint32_t> numbers;
  const auto vertex = [&](std::array<int, 3> k) {
    const auto [found, is_new] = numbers.insert({k, static_cast<uint32_t>(numbers.size())});
    if (is_new)
      surface.vertices.push_back({0.25f * static_cast<float>(k[0]) - 1,
                                  0.25f * static_cast<float>(k[1]) - 1,
                                  0.25f * static_cast<float>(k[2]) - 1});
    return found->second;
  };
  for (size_t axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      for (int i = 0; i < 64; ++i) {
        const auto corner = [&](int a, int b) {
          std::array<int, 3> k{};
          k[axis] = 8 * side;
          k[(axis + 1) % 3] = i % 8 + (side == 1 ? a : b);
          k[(axis + 2) % 3] = i / 8 + (side == 1 ? b : a);
          return vertex(k);
        };
        surface.faces.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
        surface.faces.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
      }
    }
  }
  for (uint32_t i = 0; i < surface.faces.size(); ++i) surface.source.push_back(i);
  return surface;
}

void check_triangles(const BakedHull& baked, int count) {
  const hull::View& view = baked.view;
  const uint32_t faces = view.head().mesh_triangle_count;
  Threes threes(view.mesh_head(), 17);
  std::vector<uint32_t> buffer(faces), bits(hull::bit_words(view.collapse_count())),
      splits(view.collapse_count() + 1);
  std::vector<hull::Candidate> candidates(8192);
  const auto size = [](const auto& items) { return static_cast<uint32_t>(items.size()); };
  hull::Refinement refinement(view, view.base_hull(),
                              {{bits.data(), size(bits)},
                               {splits.data(), size(splits)},
                               {candidates.data(), size(candidates)}});
  std::vector<mesh::SurfaceCrossing> met(faces);
  uint32_t unclear = 0, crossed = 0, free_of_it = 0, sure_of_it = 0, any_steps = 0, all_steps = 0;
  uint32_t all_found = 0, refined_found = 0;
  for (int i = 0; i < count; ++i) {
    test::note("triangle", i);
    const Three three = threes.next(i);
    std::vector<uint32_t> truth;
    bool is_clear = true;
    for (uint32_t k = 0; k < faces; ++k)
      if (crosses(three, face_of(view, k), is_clear)) truth.push_back(k);
    if (!is_clear) {
      ++unclear;
      continue;
    }
    const hull::TriangleHits all =
        hull::all_crossed(view, three.corner, query::kUnlimited, {buffer.data(), faces});
    CHECK(all.exact);
    CHECK_EQ(all.found, truth.size());
    CHECK(all.reported == truth.size() && std::equal(truth.begin(), truth.end(), buffer.begin()));
    const hull::TriangleHit any = hull::any_crossed(view, three.corner, query::kUnlimited);
    CHECK(any.exact);
    CHECK_EQ(any.hit, !truth.empty());
    CHECK_LE(any.steps, all.steps);
    any_steps += any.hit ? any.steps : 0;
    all_steps += any.hit ? all.steps : 0;
    if (any.hit) CHECK(std::binary_search(truth.begin(), truth.end(), any.triangle));
    for (const uint32_t room : {0u, 1u, 2u}) {
      uint32_t few[4] = {9, 9, 9, 9};
      const hull::TriangleHits some =
          hull::all_crossed(view, three.corner, query::kUnlimited, {few, room});
      CHECK_EQ(some.found, truth.size());
      CHECK_EQ(some.reported, std::min<size_t>(room, truth.size()));
      for (uint32_t k = 0; k < some.reported; ++k) CHECK_EQ(few[k], truth[k]);
      for (uint32_t k = room; k < 4; ++k) CHECK_EQ(few[k], 9u);
    }
    // If the base hull reports none there is none. Refinement reports no crossing that is none.
    const hull::TriangleHit of_base_hull =
        hull::base_hull_crossed(view.base_hull(), three.corner, query::kUnlimited);
    CHECK(of_base_hull.exact);
    if (!of_base_hull.hit) CHECK(truth.empty());
    int32_t winding = 0;
    query::Work to_begin(query::kUnlimited);
    CHECK(hull::wind_around(view.base_hull(), three.corner[0], to_begin, winding));
    CHECK_LE(to_begin.visits(), of_base_hull.steps);
    if (winding == 0 && of_base_hull.hit) CHECK_LT(to_begin.visits(), of_base_hull.steps);
    const hull::RefinedCrossings refined =
        refinement.all(three.corner, query::kUnlimited, {met.data(), faces});
    CHECK(refined.exact);
    for (uint32_t k = 0; k < refined.reported; ++k)
      CHECK(std::binary_search(truth.begin(), truth.end(), met[k].triangle));
    const hull::RefinedHit refined_any = refinement.any(three.corner, query::kUnlimited);
    CHECK_EQ(refined_any.hit, refined.found != 0);
    all_found += all.found;
    refined_found += refined.found;
    if (refined_any.hit)
      CHECK(std::binary_search(truth.begin(), truth.end(), refined_any.triangle));
    (truth.empty() ? free_of_it : crossed) += 1;
    sure_of_it += of_base_hull.hit ? 0u : 1u;
  }
  CHECK_LT(all_found, refined_found * 2);  // the rest is met inside the hull alone
  CHECK_LT(any_steps * 2, all_steps);
  CHECK_LT(unclear * 20, static_cast<uint32_t>(count));
  CHECK_LT(static_cast<uint32_t>(count) / 8, crossed);
  CHECK_LT(static_cast<uint32_t>(count) / 8, free_of_it);
  CHECK_LT(static_cast<uint32_t>(count) / 16, sure_of_it);
}

}  // namespace

TEST(TrianglesCrossWhatBruteForceSaysAndTheBaseHullRulesOutNone) {
  check_triangles(BakedHull(make_part(1, 2000), 300, 16), 260);
  check_triangles(BakedHull(bumpy_ring(16, 8, 0.2), 120, 22), 260);
}

// Quarters, moved by so little that no sign changes but of what is 0: in whole numbers.
__extension__ using Whole = __int128;
struct Place {
  Whole x, y, z;
};
Place operator-(Place a, Place b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Place whole(math::Vec3 v, bool is_moved) {
  const auto of = [](float c) {
    return static_cast<Whole>(static_cast<int64_t>(c * 4.0f)) * (1 << 30);
  };
  const Whole moved = is_moved ? 1 : 0;
  return {of(v.x) + (moved << 20), of(v.y) + (moved << 10), of(v.z) + moved};
}
int side(Place u, Place v, Place w) {
  const Whole sum =
      u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) + u.z * (v.x * w.y - v.y * w.x);
  return sum > 0 ? 1 : sum < 0 ? -1 : 0;
}
bool passes(Place a, Place b, Place p, Place q, Place r) {
  const int x = side(b - a, p - a, q - a), y = side(b - a, q - a, r - a),
            z = side(b - a, r - a, p - a);
  return x == y && y == z && side(p - a, q - a, r - a) != side(p - b, q - b, r - b);
}

TEST(TrianglesThatTouchAreAnsweredAsIfMoved) {
  const BakedHull baked(grid_cube(), 60, 16);
  const hull::View& view = baked.view;
  Random random(3);
  uint32_t crossed = 0, buffer[1024];
  for (int i = 0; i < 500; ++i) {
    test::note("triangle", i);
    Three three;
    Place moved[3];
    for (int k = 0; k < 3; ++k) {
      const auto quarter = [&] { return 0.25f * static_cast<float>(random.below(13)) - 1.5f; };
      const float x = quarter(), y = quarter(), z = quarter();
      three.corner[k] = {x, y, i % 4 == 0 ? 1.0f : z};  // or in the plane of a side
      moved[k] = whole(three.corner[k], true);
    }
    std::vector<uint32_t> truth;
    for (uint32_t f = 0; f < view.head().mesh_triangle_count; ++f) {
      const Three face = face_of(view, f);
      bool is_crossed = false;
      for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const Place p[3] = {whole(face.corner[0], false), whole(face.corner[1], false),
                            whole(face.corner[2], false)};
        is_crossed |= passes(moved[k], moved[next], p[0], p[1], p[2]) ||
                      passes(p[k], p[next], moved[0], moved[1], moved[2]);
      }
      if (is_crossed) truth.push_back(f);
    }
    const hull::TriangleHits reported =
        hull::all_crossed(view, three.corner, query::kUnlimited, {buffer});
    CHECK_EQ(reported.found, truth.size());
    for (uint32_t k = 0; k < reported.reported && k < truth.size(); ++k)
      CHECK_EQ(buffer[k], truth[k]);
    crossed += truth.empty() ? 0u : 1u;
  }
  CHECK_LT(200u, crossed);
}

TEST(ARayIsTheSegmentToBeyondAllThatItMayMeet) {
  const BakedHull baked(make_part(1, 2000), 300, 16);
  const hull::View& view = baked.view;
  Threes threes(view.mesh_head(), 4);
  uint32_t hits = 0;
  for (int i = 0; i < 1500; ++i) {
    test::note("ray", i);
    const math::Vec3 from = threes.somewhere(i % 3 == 0 ? 40 : 0.7), to = threes.somewhere(0.5);
    const float scale = i % 2 == 0 ? 1e-3f : 7.0f;
    const math::Vec3 direction{(to.x - from.x) * scale, (to.y - from.y) * scale,
                               (to.z - from.z) * scale};
    hull::RaySegment ray;
    CHECK(hull::segment_of_ray(view.head().low_m, view.head().high_m, from, direction, ray));
    const mesh::Hit hit = hull::cast_segment(view, ray.from_m, ray.to_m, query::kUnlimited);
    // Where the ray is, by plain arithmetic.
    double least = 1e300;
    for (uint32_t k = 0; k < view.head().mesh_triangle_count; ++k) {
      const Three face = face_of(view, k);
      const At a = at(from), way = at(direction);
      const At p = at(face.corner[0]) - a, q = at(face.corner[1]) - a, r = at(face.corner[2]) - a;
      const Real x = volume(way, p, q), y = volume(way, q, r), z = volume(way, r, p);
      if (std::min({x, y, z}) < 0 && std::max({x, y, z}) > 0) continue;
      const Real t = volume(p, q, r) / (x + y + z);
      if (t > 0 && static_cast<double>(t) < least) least = static_cast<double>(t);
    }
    hits += hit.hit ? 1u : 0u;
    CHECK_EQ(hit.hit, least < 1e300);
    if (!hit.hit) continue;
    const double reported = double{hit.t} * double{ray.reach}, off = double{ray.reach} * 4e-6;
    CHECK_LE(std::fabs(reported - least), off);
  }
  CHECK_LT(900u, hits);
  hull::RaySegment none;
  const float nan = __builtin_nanf("");
  const auto refuses = [&](math::Vec3 from, math::Vec3 direction) {
    return !hull::segment_of_ray(view.head().low_m, view.head().high_m, from, direction, none);
  };
  CHECK(refuses({0, 0, 0}, {0, 0, 0}));
  CHECK(refuses({0, nan, 0}, {0, 0, 1}));
  CHECK(refuses({0, 0, 0}, {0, 0, nan}));
  CHECK(refuses({3e38f, 3e38f, 0}, {0, 0, 1}));
  const math::Vec3 hostile[3] = {{0, 0, 0}, {0, nan, 0}, {1, 1, 1}};
  CHECK(!hull::any_crossed(view, hostile, query::kUnlimited).exact);
  CHECK(!hull::base_hull_crossed(view.base_hull(), hostile, query::kUnlimited).exact);
}

}  // namespace firmtouch::tools
