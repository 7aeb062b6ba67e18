// Segments against exact arithmetic, brute force in double, and what must hold on closed surfaces.
#include <algorithm>
#include <cmath>

#include "baked_mesh.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/segment_cast.hpp"
#include "firmtouch/mesh/segment_frame.hpp"
#include "harness/test.hpp"
#include "surface/make/make_part.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT
using math::Vec3;
using Room = std::vector<mesh::SurfaceCrossing>;

// Points where it hurts: corners, middles and other points of edges, points of faces (as near as
// floats come), and anywhere in a box twice the model's.
class Aims {
 public:
  Aims(const BakedMesh& baked, uint64_t seed) : baked_(baked), random_(seed) {
    for (const Vec3& v : baked.surface.vertices)
      centre_ = centre_ + wide(v) * (1.0 / static_cast<double>(baked.surface.vertices.size()));
  }

  Vec3 next() {
    const tools::Surface& s = baked_.surface;
    const tools::Face& f = s.faces[random_.below(static_cast<uint32_t>(s.faces.size()))];
    const Point a = wide(s.vertices[f[0]]), b = wide(s.vertices[f[1]]), c = wide(s.vertices[f[2]]);
    const double u = random_.between(0, 1), v = random_.between(0, 1 - u);
    switch (random_.below(6)) {
      case 0:
        return s.vertices[f[0]];
      case 1:
        return narrow((a + b) * 0.5);
      case 2:
        return narrow(a + (b - a) * u);
      case 3:
        return narrow(a + (b - a) * u + (c - a) * v);
      default:
        return anywhere();
    }
  }
  Vec3 anywhere() {
    const double r = baked_.size * 0.8;
    return narrow(centre_ +
                  Point{random_.between(-r, r), random_.between(-r, r), random_.between(-r, r)});
  }
  /// Where a straight line from `from` through `through` goes on to.
  static Vec3 beyond(Vec3 from, Vec3 through) {
    return narrow(wide(from) + (wide(through) - wide(from)) * 2.0);
  }

 private:
  const BakedMesh& baked_;
  Random random_;
  Point centre_;
};

// Crossings outward less crossings inward.
int balance(const BakedMesh& baked, Vec3 a, Vec3 b, Room& buffer) {
  const mesh::Crossings all = mesh::all_crossings(
      baked.view, a, b, query::kUnlimited, {buffer.data(), static_cast<uint32_t>(buffer.size())});
  CHECK(all.exact);
  CHECK_EQ(all.found, all.reported);
  int sum = 0;
  for (uint32_t i = 0; i < all.reported; ++i) {
    sum += buffer[i].enters ? -1 : 1;
    if (i > 0) CHECK(buffer[i - 1].t <= buffer[i].t);
  }
  return sum;
}

// On a closed surface a closed chain of segments comes in as often as it goes out, whatever it
// passes through and wherever its joints lie.
void no_leaks(const BakedMesh& baked, size_t segments, uint64_t seed) {
  Aims aims(baked, seed);
  Room buffer(4096);
  size_t leaks = 0;
  for (size_t i = 0; i + 4 <= segments; i += 4) {
    const Vec3 a = aims.next(), b = aims.next(), c = Aims::beyond(a, b), d = aims.next();
    const int sum = balance(baked, a, b, buffer) + balance(baked, b, c, buffer) +
                    balance(baked, c, d, buffer) + balance(baked, d, a, buffer);
    if (sum != 0 && leaks++ == 0) test::note("first leak at segment", static_cast<int64_t>(i));
  }
  CHECK_EQ(leaks, size_t{0});
}

void no_leaks_in_real_model(const char* file, size_t daily, size_t whole) {
  if (models_folder().empty()) return test::skip("FIRMTOUCH_MODELS names no folder of real models");
  const BakedMesh baked(real_model(file));
  CHECK(!baked.surface.faces.empty());
  if (!baked.surface.faces.empty()) no_leaks(baked, long_run() ? whole : daily, 21);
}

// An oracle in 128-bit integers: the segment really is moved, by 2^-12, 2^-24 and 2^-36 of the
// grid's unit, less than any determinant of small integers resolves.
__extension__ typedef __int128 Integer;
struct Grid3 {
  Integer x, y, z;
};
Grid3 operator-(Grid3 a, Grid3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Integer volume(Grid3 u, Grid3 v, Grid3 w) {
  return u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) +
         u.z * (v.x * w.y - v.y * w.x);
}
int sign_of(Integer i) { return i > 0 ? 1 : i < 0 ? -1 : 0; }
Grid3 on_grid(Vec3 v, bool moved) {
  const Integer unit = Integer{1} << 36;
  const auto whole = [&](float x) { return static_cast<Integer>(x) * unit; };
  if (!moved) return {whole(v.x), whole(v.y), whole(v.z)};
  return {whole(v.x) + (Integer{1} << 24), whole(v.y) + (Integer{1} << 12), whole(v.z) + 1};
}
int direction_in_integers(Vec3 a, Vec3 b, const Vec3 (&corner)[3]) {
  const Grid3 from = on_grid(a, true), to = on_grid(b, true);
  const Grid3 p = on_grid(corner[0], false), q = on_grid(corner[1], false),
              r = on_grid(corner[2], false);
  const int before = sign_of(volume(p - from, q - from, r - from));
  const int after = -sign_of(volume(p - to, q - to, r - to));
  const int pq = sign_of(volume(to - from, p - from, q - from));
  const int qr = sign_of(volume(to - from, q - from, r - from));
  const int rp = sign_of(volume(to - from, r - from, p - from));
  const bool crosses = pq == qr && qr == rp && pq == before && before == after;
  return crosses ? pq : 0;
}

mesh::Head head_of(const Vec3* points, size_t count) {
  mesh::Head head{};
  for (uint32_t k = 0; k < 3; ++k) {
    head.low_m[k] = 3e38f;
    head.high_m[k] = -3e38f;
    for (size_t i = 0; i < count; ++i) {
      const float at = k == 0 ? points[i].x : k == 1 ? points[i].y : points[i].z;
      head.low_m[k] = std::min(head.low_m[k], at);
      head.high_m[k] = std::max(head.high_m[k], at);
    }
  }
  return head;
}

}  // namespace

TEST(EveryDegenerateCrossingIsDecidedAsIfTheSegmentWereMoved) {
  Random random(5);
  const auto small = [&] { return static_cast<float>(static_cast<int>(random.between(-3, 4))); };
  const auto point = [&] { return Vec3{small(), small(), small()}; };
  size_t crossed = 0, wrong = 0;
  for (int i = 0; i < (long_run() ? 20000000 : 300000); ++i) {
    const Vec3 a = point(), b = point(), corner[3] = {point(), point(), point()};
    const int expected = direction_in_integers(a, b, corner);
    const mesh::Crossing exact = mesh::exact_crossing(a, b, corner[0], corner[1], corner[2]);
    const mesh::SegmentFrame frame(head_of(corner, 3), a, b);
    const mesh::Crossing fast = frame.crossing(corner[0], corner[1], corner[2]);
    const mesh::Crossing back = mesh::exact_crossing(b, a, corner[0], corner[1], corner[2]);
    if (exact.direction != expected || fast.direction != expected || back.direction != -expected)
      ++wrong;
    if (expected != 0 && std::fabs(exact.t + back.t - 1.0f) > 1e-6f) ++wrong;
    crossed += expected != 0 ? 1 : 0;
  }
  CHECK_EQ(wrong, size_t{0});
  CHECK(crossed > 1000);
}

TEST(FloatsDecideAsIntegersDo) {
  Random random(6);
  const auto point = [&](double reach) {
    return Point{random.between(-reach, reach), random.between(-reach, reach),
                 random.between(-reach, reach)};
  };
  size_t wrong = 0, crossed = 0;
  double worst = 0;
  for (int i = 0; i < (long_run() ? 20000000 : 200000); ++i) {
    const double scale = std::pow(10.0, random.between(-8, 6)), far = i % 3 == 0 ? 1000.0 : 1.0;
    const Point slot = point(far * scale);
    Vec3 corner[3];
    for (Vec3& c : corner) c = narrow(slot + point(scale));
    // Through the triangle, one of its edges or one of its corners, all but rounding.
    const double u = i % 4 == 1 ? 0 : random.between(0, 1),
                 v = i % 4 == 2 ? 0 : random.between(0, 1 - u);
    const Point aim = wide(corner[0]) + (wide(corner[1]) - wide(corner[0])) * u +
                      (wide(corner[2]) - wide(corner[0])) * v;
    const Point way = point(scale * std::pow(10.0, random.between(-3, 3)));
    const Vec3 a = narrow(aim - way), b = narrow(aim + way * random.between(-0.1, 2));
    const mesh::Crossing exact = mesh::exact_crossing(a, b, corner[0], corner[1], corner[2]);
    const mesh::SegmentFrame frame(head_of(corner, 3), a, b);
    const mesh::Crossing fast = frame.crossing(corner[0], corner[1], corner[2]);
    if (exact.direction != fast.direction) ++wrong;
    if (exact.direction == 0) continue;
    ++crossed;
    worst = std::max(worst, std::fabs(double{exact.t} - double{fast.t}));
  }
  CHECK_EQ(wrong, size_t{0});
  CHECK_LE(worst, double{mesh::kTimeError} + 0x1p-22);
  CHECK(crossed > 20000);
}

// Past an edge as near as floats come, along a diagonal, with triangles as large as the distance:
// where the error of a side is largest beside its bound.
TEST(FloatsDecideAsIntegersDo_WhereTheErrorOfASideIsLargest) {
  Random random(26);
  const auto sign = [&] { return random.below(2) == 0 ? -1.0 : 1.0; };
  size_t wrong = 0, sure = 0;
  for (int i = 0; i < (long_run() ? 20000000 : 3000000); ++i) {
    Vec3 corner[3];
    for (Vec3& c : corner)
      c = narrow({random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)});
    const Point aim = wide(corner[0]) + (wide(corner[1]) - wide(corner[0])) * random.between(0, 1);
    const Point way{sign(), sign() * random.between(0.7, 1), sign() * random.between(0.7, 1)};
    const double reach = i % 8 == 0 ? 2048 : 3, past = 0x1p-24 * random.between(-reach, reach);
    const Point off{past * random.between(-1, 1), past * random.between(-1, 1),
                    past * random.between(-1, 1)};
    const Vec3 a = narrow(aim + off - way * random.between(2, 4));
    const Vec3 b = narrow(aim + off + way * random.between(0.1, 1.5));
    const mesh::Crossing exact = mesh::exact_crossing(a, b, corner[0], corner[1], corner[2]);
    const mesh::SegmentFrame frame(head_of(corner, 3), a, b);
    mesh::Crossing fast;
    float early = 0;
    if (!frame.decides(corner[0], corner[1], corner[2], fast, early)) continue;
    ++sure;
    if (exact.direction != fast.direction) ++wrong;
  }
  CHECK_EQ(wrong, size_t{0});
  CHECK(sure > 1000);
}

TEST(NothingLeaksThroughThePart) { no_leaks(part(), long_run() ? 40000000 : 100000, 20); }
TEST(NothingLeaksThroughSpot) { no_leaks_in_real_model("spot.obj", 40000, 20000000); }
TEST(NothingLeaksThroughTheRockerArm) { no_leaks_in_real_model("rocker-arm.off", 40000, 20000000); }
TEST(NothingLeaksThroughFandisk) { no_leaks_in_real_model("fandisk.obj", 40000, 10000000); }
TEST(NothingLeaksThroughTheHorse) { no_leaks_in_real_model("horse.ply", 20000, 10000000); }

TEST(NothingLeaksThroughTinyHugeOrFarModels) {
  const size_t count = long_run() ? 2000000 : 10000;
  const tools::Surface model = tools::make_part(1, 1000);
  const double unit = 1 / diagonal(model);
  no_leaks(BakedMesh(moved(model, 1e-6 * unit, {})), count, 31);
  no_leaks(BakedMesh(moved(model, 1e6 * unit, {})), count, 32);
  no_leaks(BakedMesh(moved(model, unit, {200, -300, 100})), count, 33);
}

TEST(CrossingsAreThoseOfBruteForceInDouble) {
  const BakedMesh& baked = part();
  Aims aims(baked, 40);
  Room buffer(4096);
  size_t compared = 0, missed = 0;
  double worst = 0;
  for (int i = 0; i < (long_run() ? 40000 : 2000); ++i) {
    const Vec3 a = aims.anywhere(), b = aims.anywhere();
    std::vector<double> truth;
    bool grazes = false;
    for (const tools::Face& f : baked.surface.faces) {
      const Point p = wide(baked.surface.vertices[f[0]]), o = wide(a), d = wide(b) - o;
      const Point e = wide(baked.surface.vertices[f[1]]) - p,
                  g = wide(baked.surface.vertices[f[2]]) - p, n = cross(e, g);
      const double rate = dot(n, d), t = dot(n, p - o) / rate;
      const Point at = o + d * t - p;
      const double u = dot(cross(at, g), n) / dot(n, n), v = dot(cross(e, at), n) / dot(n, n);
      const double inside = std::min({u, v, 1 - u - v, t, 1 - t});
      if (std::fabs(inside) < 1e-5) grazes = true;
      if (inside > 0) truth.push_back(t);
    }
    if (grazes) continue;
    std::sort(truth.begin(), truth.end());
    const mesh::Crossings all = mesh::all_crossings(
        baked.view, a, b, query::kUnlimited, {buffer.data(), static_cast<uint32_t>(buffer.size())});
    if (all.found != truth.size()) {
      ++missed;
      continue;
    }
    ++compared;
    for (size_t k = 0; k < truth.size(); ++k)
      worst = std::max(worst, std::fabs(truth[k] - double{buffer[k].t}));
    const mesh::Hit first = mesh::cast_segment(baked.view, a, b, query::kUnlimited);
    const mesh::Hit any = mesh::any_crossing(baked.view, a, b, query::kUnlimited);
    CHECK_EQ(first.hit, !truth.empty());
    CHECK_EQ(any.hit, !truth.empty());
    CHECK(first.exact && any.exact);
    if (!first.hit) continue;
    CHECK_EQ(first.t, buffer[0].t);
    CHECK_EQ(first.triangle, buffer[0].triangle);
    CHECK_EQ(first.enters, buffer[0].enters);
    CHECK(any.steps <= first.steps);
  }
  CHECK_EQ(missed, size_t{0});
  CHECK(compared > 1000);
  CHECK_LE(worst, double{mesh::kTimeError});
}

TEST(CrossingParity_IsTheSign) {
  const BakedMesh& baked = part();
  Random random(50);
  Aims aims(baked, 50);
  Room buffer(4096);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 a = aims.anywhere(), b = aims.anywhere();
    mesh::Hint cold, other;
    const int at_a = mesh::closest_point(baked.view, a, query::kUnlimited, cold).certificate.sign;
    const int at_b = mesh::closest_point(baked.view, b, query::kUnlimited, other).certificate.sign;
    if (at_a == 0 || at_b == 0) continue;
    CHECK_EQ(2 * balance(baked, a, b, buffer), at_b - at_a);
  }
}

TEST(AFullRoomKeepsTheFirstCrossingsAndCountsAll) {
  const BakedMesh& baked = part();
  Aims aims(baked, 60);
  Room buffer(4096), few(4096);
  size_t several = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 a = aims.anywhere(), b = aims.anywhere();
    const mesh::Crossings all = mesh::all_crossings(
        baked.view, a, b, query::kUnlimited, {buffer.data(), static_cast<uint32_t>(buffer.size())});
    several += all.found > 1 ? 1 : 0;
    for (uint32_t size = 0; size < 4; ++size) {
      const mesh::Crossings some =
          mesh::all_crossings(baked.view, a, b, query::kUnlimited, {few.data(), size});
      CHECK_EQ(some.found, all.found);
      CHECK_EQ(some.reported, std::min(size, all.found));
      CHECK_EQ(some.steps, all.steps);
      CHECK(some.exact);
      for (uint32_t k = 0; k < some.reported; ++k) {
        CHECK_EQ(few[k].t, buffer[k].t);
        CHECK_EQ(few[k].triangle, buffer[k].triangle);
      }
    }
  }
  CHECK(several > 100);
}

TEST(EveryBudget_ReturnsTrueCrossingsAndWhetherComplete) {
  const BakedMesh& baked = part();
  Aims aims(baked, 70);
  Room buffer(4096), some(4096);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = aims.next(), b = aims.next();
    const mesh::Crossings all = mesh::all_crossings(
        baked.view, a, b, query::kUnlimited, {buffer.data(), static_cast<uint32_t>(buffer.size())});
    const mesh::Hit truth = mesh::cast_segment(baked.view, a, b, query::kUnlimited);
    float last = 2;
    for (uint32_t budget = 1; budget < 2 * all.steps; budget *= 2) {
      const mesh::Hit hit = mesh::cast_segment(baked.view, a, b, {budget});
      CHECK(hit.steps <= budget);
      CHECK_EQ(hit.exact, budget >= truth.steps);
      CHECK(hit.t <= last && hit.t >= truth.t);
      last = hit.t;
      const mesh::Crossings part_of = mesh::all_crossings(
          baked.view, a, b, {budget}, {some.data(), static_cast<uint32_t>(some.size())});
      CHECK_EQ(part_of.exact, budget >= all.steps);
      for (uint32_t k = 0; k < part_of.reported; ++k) {
        const bool is_there =
            std::any_of(buffer.begin(), buffer.begin() + all.reported, [&](const auto& c) {
              return c.triangle == some[k].triangle && test::equal(c.t, some[k].t);
            });
        CHECK(is_there);
      }
      const mesh::Hit any = mesh::any_crossing(baked.view, a, b, {budget});
      if (any.hit) CHECK(all.found > 0 && any.exact);
      if (any.exact) CHECK_EQ(any.hit, all.found > 0);
    }
  }
}
