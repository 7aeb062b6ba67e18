// A base hull is queried from its resident part alone: the asset may be unreadable.
#include <sys/mman.h>

#include <cstring>

#include "../surface/shapes.hpp"
#include "bake/asset/asset_views.hpp"
#include "bake/asset/asset_writer.hpp"
#include "bumpy_ring.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/hull/base_hull_cast.hpp"
#include "firmtouch/hull/base_hull_distance.hpp"
#include "firmtouch/hull/complete_cast.hpp"
#include "firmtouch/hull/loader.hpp"
#include "firmtouch/hull/vertices.hpp"
#include "firmtouch/mesh/exact_crossing.hpp"
#include "surface/make/make_part.hpp"

namespace firmtouch::tools {
namespace {

/// An asset in pages that can be locked, as flash that nobody may read.
class Flash {
 public:
  explicit Flash(const std::vector<uint8_t>& file) : size_(file.size()) {
    at_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    CHECK(at_ != MAP_FAILED);
    std::memcpy(at_, file.data(), size_);
  }
  Flash(const Flash&) = delete;
  Flash& operator=(const Flash&) = delete;
  ~Flash() { munmap(at_, size_); }
  core::Bytes bytes() const {
    return {static_cast<const uint8_t*>(at_), static_cast<uint32_t>(size_)};
  }
  void lock() { CHECK_EQ(mprotect(at_, size_, PROT_NONE), 0); }
  void unlock() { CHECK_EQ(mprotect(at_, size_, PROT_READ), 0); }

 private:
  void* at_;
  size_t size_;
};

struct Line {
  math::Vec3 a, b;
};
std::vector<Line> lines_about(const Surface& surface, int count) {
  Random random(21);
  float low[3] = {1e9f, 1e9f, 1e9f}, high[3] = {-1e9f, -1e9f, -1e9f};
  for (const math::Vec3& v : surface.vertices) {
    const float at[3] = {v.x, v.y, v.z};
    for (int k = 0; k < 3; ++k)
      low[k] = std::min(low[k], at[k]), high[k] = std::max(high[k], at[k]);
  }
  const auto anywhere = [&](float size) {
    float p[3];
    for (int k = 0; k < 3; ++k) {
      const float middle = (low[k] + high[k]) / 2, half = (high[k] - low[k]) / 2;
      p[k] = middle + half * size * static_cast<float>(random.between(-1, 1));
    }
    return math::Vec3{p[0], p[1], p[2]};
  };
  std::vector<Line> lines;
  for (int i = 0; i < count; ++i) {
    math::Vec3 a = anywhere(2);
    a.x = i % 2 == 0 ? low[0] - (high[0] - low[0]) : high[0] + (high[0] - low[0]);
    lines.push_back({a, anywhere(i % 3 == 0 ? 1 : 2)});
  }
  return lines;
}

}  // namespace

TEST(ABaseHullInFastMemoryAnswersWithTheAssetLocked) {
  const BakedHull baked(make_part(1, 3000), 300, 16);
  const AssetFile file = write_asset(baked.sections);
  CHECK(file.problem.empty());
  Flash flash(file.bytes);
  asset::Container container;
  CHECK(asset::open(flash.bytes(), container).ok());
  hull::View view;
  CHECK_EQ(asset::open_geometry(container, "model", view).rule, 0);
  const uint32_t resident = view.base_hull().resident_bytes();
  std::vector<uint32_t> fast(resident / 4);
  std::memcpy(fast.data(), container.find(hull::kBaseHullSection, "model").data(), resident);
  const core::Bytes copy{reinterpret_cast<const uint8_t*>(fast.data()), resident};
  const hull::BaseHull base_hull = view.base_hull().resident(copy);
  CHECK(base_hull.is_open());
  const std::vector<Line> lines = lines_about(baked.surface, 1000);
  std::vector<hull::BaseHullHit> reported;
  flash.lock();  // a read of the asset ends this program
  for (const Line& line : lines) {
    reported.push_back(hull::cast_base_hull(base_hull, line.a, line.b, query::kUnlimited));
    const hull::BaseHullDistance distance =
        hull::base_hull_distance(base_hull, line.a, query::kUnlimited);
    CHECK(distance.side == hull::BaseHullSide::kOutside);
  }
  flash.unlock();
  uint32_t free_lines = 0, hits = 0, ghosts = 0, unsure = 0;
  for (size_t i = 0; i < lines.size(); ++i) {
    test::note("segment", static_cast<int64_t>(i));
    const mesh::Hit truth = hull::cast_segment(view, lines[i].a, lines[i].b, query::kUnlimited);
    CHECK(reported[i].exact || reported[i].hit);
    if (truth.hit) CHECK(reported[i].hit && reported[i].t <= truth.t + 0x1p-17f);
    hits += truth.hit ? 1u : 0u;
    free_lines += reported[i].hit ? 0u : 1u;
    ghosts += reported[i].hit && !truth.hit ? 1u : 0u;
    unsure += reported[i].exact ? 0u : 1u;
  }
  CHECK_LT(100u, hits);
  CHECK_LT(300u, free_lines);
  CHECK_LT(ghosts * 10, free_lines);
  CHECK_LE(unsure, 3u);
}

// In the planes of faces too, where floats cannot decide when a face is crossed.
TEST(MoveOutsideTheBaseHull_MeetsNothing) {
  const BakedHull baked(make_part(1, 3000), 300, 16);
  const hull::BaseHull& base_hull = baked.view.base_hull();
  const float off_m = 0.02f * baked.view.mesh_head().diagonal_m;
  Random random(5);
  uint32_t moves = 0;
  for (int i = 0; i < 6000; ++i) {
    const uint32_t face = random.below(base_hull.face_count());
    const math::Vec3 p = hull::vertex(base_hull, base_hull.vertex_of(face, 0)),
                     q = hull::vertex(base_hull, base_hull.vertex_of(face, 1));
    const float along = static_cast<float>(random.between(-3, 3)),
                step = static_cast<float>(random.between(0.01, 0.3));
    const auto at = [&](float t) {
      return math::Vec3{p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t, p.z + (q.z - p.z) * t};
    };
    const math::Vec3 a = at(along), b = at(along + step);
    if (!(hull::base_hull_distance(base_hull, a, query::kUnlimited).lower_m > off_m)) continue;
    const math::Vec3 way{b.x - a.x, b.y - a.y, b.z - a.z};
    if (way.x * way.x + way.y * way.y + way.z * way.z > off_m * off_m) continue;
    test::note("move", i);
    ++moves;
    const hull::BaseHullHit hit = hull::cast_base_hull(base_hull, a, b, query::kUnlimited);
    CHECK(hit.exact && !hit.hit);
  }
  CHECK_LT(500u, moves);
}

TEST(ACopyThatIsNotTheBaseHullIsNotTaken) {
  const BakedHull baked(make_part(1, 2000), 300, 16);
  const hull::BaseHull& stored = baked.view.base_hull();
  std::vector<uint32_t> fast(stored.resident_bytes() / 4);
  std::memcpy(fast.data(), &stored.head(), stored.resident_bytes());
  const uint8_t* bytes = reinterpret_cast<const uint8_t*>(fast.data());
  CHECK(stored.resident({bytes, stored.resident_bytes()}).is_open());
  CHECK(!stored.resident({bytes, stored.resident_bytes() - 1}).is_open());
  CHECK(!hull::BaseHull().resident({bytes, stored.resident_bytes()}).is_open());
  for (size_t i = 0; i < fast.size(); i += 97) {
    fast[i] ^= 0x100;
    CHECK(!stored.resident({bytes, stored.resident_bytes()}).is_open());
    fast[i] ^= 0x100;
  }
}

TEST(ABaseHullWindsAroundEveryPointOfTheMesh) {
  const BakedHull baked(bumpy_ring(8, 4, 0.2), 200, 16);
  uint32_t inside = 0;
  for (const Face& face : baked.surface.faces) {
    const math::Vec3 p = baked.surface.vertices[face[0]], q = baked.surface.vertices[face[1]];
    const math::Vec3 middle{(p.x + q.x) / 2 * 0.999f, (p.y + q.y) / 2 * 0.999f,
                            (p.z + q.z) / 2 * 0.999f};
    if (winding_by_angles(baked.surface, to_point(middle)) < 0.9) continue;
    ++inside;
    int32_t winding;
    query::Work work(query::kUnlimited);
    CHECK(hull::wind_around(baked.view.base_hull(), middle, work, winding));
    CHECK_LE(1, winding);
  }
  CHECK_LT(100u, inside);
  int32_t winding = 9;
  query::Work work(query::kUnlimited);
  CHECK(hull::wind_around(baked.view.base_hull(), {0, 0, 0}, work, winding));
  CHECK_EQ(winding, 0);  // the hole of the ring
}

// Brute force over every face, in integers.
mesh::Hit first_of_all_faces(const hull::BaseHull& base_hull, const Line& line) {
  mesh::Hit first;
  for (uint32_t i = 0; i < base_hull.face_count(); ++i) {
    const mesh::Crossing crossing =
        mesh::exact_crossing(line.a, line.b, hull::vertex(base_hull, base_hull.vertex_of(i, 0)),
                             hull::vertex(base_hull, base_hull.vertex_of(i, 1)),
                             hull::vertex(base_hull, base_hull.vertex_of(i, 2)));
    if (crossing.direction == 0 || (first.hit && first.t <= crossing.t)) continue;
    first = {true, crossing.t, i, crossing.direction < 0, 0, true};
  }
  return first;
}

// Segments that try the whole numbers: along the axes, in planes of vertices, short, far too long,
// from afar, of almost no length.
std::vector<Line> hard_lines(const hull::BaseHull& base_hull, int count) {
  Random random(8);
  const hull::BaseHullHead& head = base_hull.head();
  const uint32_t vertices = head.made_count + head.kept_count;
  std::vector<Line> lines;
  for (int i = 0; i < count; ++i) {
    const auto some = [&](double reach) {
      float p[3];
      for (int k = 0; k < 3; ++k) {
        const double side = double{head.high_m[k]} - double{head.low_m[k]};
        p[k] = static_cast<float>(double{head.low_m[k]} +
                                  side * (0.5 + reach * random.between(-1, 1)));
      }
      return math::Vec3{p[0], p[1], p[2]};
    };
    Line line{some(0.6), some(0.6)};
    const math::Vec3 v = hull::vertex(base_hull, random.below(vertices));
    const math::Vec3 w = hull::vertex(base_hull, random.below(vertices));
    switch (i % 9) {
      case 0:
        line.b = {line.a.x, line.a.y, line.b.z};
        break;
      case 1:
        line.a.x = line.b.x = v.x;
        break;
      case 2:
        line = {{v.x, v.y, line.a.z}, {v.x, v.y, line.b.z}};
        break;
      case 3:
        line.a = some(1e5);
        break;
      case 4:
        line = {some(1e4), some(1e4)};
        line.b = {line.a.x + (v.x - line.a.x) * 2, line.a.y + (v.y - line.a.y) * 2,
                  line.a.z + (v.z - line.a.z) * 2};
        break;
      case 5:
        line.b = {line.a.x + 1e-4f, line.a.y - 2e-4f, line.a.z};
        break;
      case 6:
        line = {v, w};
        break;
      case 7:
        line.b = {v.x, v.y + 1e-7f, v.z};
        break;
      default:
        break;
    }
    lines.push_back(line);
  }
  return lines;
}

// First crossing of the base hull itself: never later than the true one, none missed; exact if
// stated.
void check_casts(const hull::BaseHull& base_hull, int count) {
  uint32_t hits = 0, misses = 0, unsure = 0;
  for (const Line& line : hard_lines(base_hull, count)) {
    test::note("segment", static_cast<int64_t>(hits + misses));
    const mesh::Hit truth = first_of_all_faces(base_hull, line);
    const hull::BaseHullHit reported =
        hull::cast_base_hull(base_hull, line.a, line.b, query::kUnlimited);
    if (truth.hit) CHECK(reported.hit && reported.t <= truth.t + 0x1p-17f);
    if (reported.exact) {
      CHECK_EQ(reported.hit, truth.hit);
      CHECK_LE(truth.t, reported.t + 0x1p-12f + 0x1p-17f);
    }
    (truth.hit ? hits : misses) += 1;
    unsure += reported.exact ? 0u : 1u;
  }
  CHECK_LT(static_cast<uint32_t>(count) / 5, hits);
  CHECK_LT(static_cast<uint32_t>(count) / 5, misses);
  CHECK_LT(unsure * 2, static_cast<uint32_t>(count));  // four in nine are laid to be hard
}

TEST(BaseHull_FirstCrossing_EqualsAllFacesTested) {
  check_casts(BakedHull(make_part(1, 3000), 300, 16).view.base_hull(), 900);
  check_casts(BakedHull(bumpy_ring(16, 8, 0.2), 200, 22).view.base_hull(), 900);
  check_casts(BakedHull(bumpy_ring(8, 4), 100000, 16).view.base_hull(),
              900);  // kept vertices alone
}

TEST(BaseHullCast_SegmentThatIsNotFinite_IsNoHitAndNotExact) {
  const BakedHull baked(bumpy_ring(4, 2), 100, 16);
  for (const float bad : {NAN, INFINITY, -INFINITY})
    for (int k = 0; k < 6; ++k) {
      float end[6] = {-3, 0, 0, 3, 0, 0};
      end[k] = bad;
      const hull::BaseHullHit hit =
          hull::cast_base_hull(baked.view.base_hull(), {end[0], end[1], end[2]},
                               {end[3], end[4], end[5]}, query::kUnlimited);
      CHECK(!hit.hit && !hit.exact && hit.steps == 0);
    }
}

// A corner at the origin, so that floats hold segments of almost no length about it, and of so much
// that their squares are none.
TEST(BaseHullCast_SegmentsOfAlmostNoLengthAndOfTooMuch_MissNoFace) {
  const Surface ring = bumpy_ring(4, 2, 0.2);
  Surface moved = ring;
  for (math::Vec3& v : moved.vertices) v = to_vec3(to_point(v) - to_point(ring.vertices[5]));
  const BakedHull baked(moved, 100000, 16);  // kept vertices alone
  Random random(14);
  uint32_t hits = 0;
  for (int i = 0; i < 1200; ++i) {
    test::note("segment", i);
    const auto off = [&](double size) {
      const double x = random.between(-size, size), y = random.between(-size, size);
      return to_vec3({x, y, random.between(-size, size)});
    };
    const double size =
        std::pow(10.0, i % 2 == 0 ? -random.between(10, 24) : random.between(8, 18));
    Line line{off(size), off(size)};
    if (i % 2 == 1) line.b = off(0.05);
    const mesh::Hit truth = first_of_all_faces(baked.view.base_hull(), line);
    hits += truth.hit ? 1u : 0u;
    const hull::BaseHullHit reported =
        hull::cast_base_hull(baked.view.base_hull(), line.a, line.b, query::kUnlimited);
    if (truth.hit) CHECK(reported.hit && reported.t <= truth.t + 0x1p-17f);
    if (reported.exact) CHECK_EQ(reported.hit, truth.hit);
  }
  CHECK_LT(150u, hits);
}

TEST(BaseHullCast_OutOfBudget_ReportsHitAtStart) {
  const BakedHull baked(bumpy_ring(8, 4), 200, 16);
  const hull::BaseHullHit hit =
      hull::cast_base_hull(baked.view.base_hull(), {-3, 0, 0}, {3, 0.1f, 0.2f}, {1});
  CHECK(hit.hit && !hit.exact);
  CHECK_EQ(hit.t, 0.0f);
  int32_t winding;
  query::Work work(query::Budget{1});
  CHECK(!hull::wind_around(baked.view.base_hull(), {0, 0, 0}, work, winding));
}

}  // namespace firmtouch::tools
