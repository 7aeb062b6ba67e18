// The integers of a base hull's search never rule out what a segment meets: boxes against double,
// faces against exact arithmetic.
#include "firmtouch/hull/base_hull_segment.hpp"

#include <algorithm>
#include <cmath>

#include "../mesh/brute_force.hpp"
#include "bumpy_ring.hpp"
#include "firmtouch/mesh/exact_crossing.hpp"

namespace firmtouch::tools {
namespace {

using hull::BaseHullSegment;

struct Line {
  math::Vec3 a, b;
};

/// Points about a box, and segments that try the whole numbers.
class Lines {
 public:
  Lines(const hull::BaseHullHead& head, uint64_t seed) : random_(seed), head_(head) {}

  math::Vec3 about(double reach) {
    float p[3];
    for (uint32_t k = 0; k < 3; ++k) {
      const double low = double{head_.low_m[k]}, side = double{head_.high_m[k]} - low;
      p[k] = static_cast<float>(low + side * (0.5 + reach * random_.between(-1, 1)));
    }
    return {p[0], p[1], p[2]};
  }
  Line next(int i) {
    Line line{about(0.6), about(0.6)};
    const float side = head_.high_m[0] - head_.low_m[0];
    if (i % 8 == 0) line.b.x = line.a.x, line.b.y = line.a.y;
    if (i % 8 == 1) line.a.x = line.b.x = i % 16 == 1 ? head_.low_m[0] : head_.high_m[0];
    if (i % 8 == 2) line = through(about(0.5), 1e5);
    if (i % 8 == 3) line = through(about(0.5), 300);
    if (i % 8 == 4) line.b = {line.a.x + side * 1e-4f, line.a.y - side * 2e-4f, line.a.z};
    if (i % 8 == 6) line.a = about(i % 16 == 6 ? 1e7 : 1e9);
    if (i % 8 == 5) line.b = {line.a.x + side * 0.4f, line.a.y + side * 1e-3f, line.a.z};
    return line;
  }
  /// From so many boxes away through `aim_m`, and as far behind it.
  Line through(math::Vec3 aim_m, double reach) {
    const Point a = to_point(about(reach)), aim = to_point(aim_m);
    return {to_vec3(a), to_vec3(aim + (aim - a))};
  }
  double between(double low, double high) { return random_.between(low, high); }
  uint32_t below(uint32_t count) { return random_.below(count); }

 private:
  Random random_;
  const hull::BaseHullHead& head_;
};

/// The part of a segment within a box, in double; a box that is only touched counts as missed.
struct Inside {
  double first = 0, last = 1;
  Inside(const Line& line, const hull::Box& box) {
    const double a[3] = {double{line.a.x}, double{line.a.y}, double{line.a.z}};
    const double b[3] = {double{line.b.x}, double{line.b.y}, double{line.b.z}};
    for (uint32_t k = 0; k < 3; ++k) {
      const double off = 1e-12 * (std::fabs(a[k]) + std::fabs(b[k]));
      const double low = double{box.low_m[k]} + off - a[k],
                   high = double{box.high_m[k]} - off - a[k];
      const double step = b[k] - a[k];
      if (std::fabs(step) > 0) {
        first = std::fmax(first, std::fmin(low / step, high / step));
        last = std::fmin(last, std::fmax(low / step, high / step));
      } else if (low > 0 || high < 0) {
        last = -1;
      }
    }
  }
};

// A thin box at a point of the line: in 256ths of the whole box.
hull::NodeBox some_box(Lines& lines, const Line& line, const hull::BaseHullHead& head) {
  const Inside inside(line, hull::box_of(head));
  const double t = inside.first + (inside.last - inside.first) * lines.between(0, 1);
  const Point at = to_point(line.a) + (to_point(line.b) - to_point(line.a)) * t;
  const double point[3] = {at.x, at.y, at.z};
  hull::NodeBox box;
  for (uint32_t k = 0; k < 3; ++k) {
    const double low = double{head.low_m[k]}, side = double{head.high_m[k]} - low;
    const int cell = static_cast<int>(std::floor((point[k] - low) / side * 256));
    const int first = std::clamp(cell - static_cast<int>(lines.below(2)), 0, 255);
    const int end = std::clamp(first + 1 + static_cast<int>(lines.below(2)), 1, 256);
    box.low[k] = static_cast<uint8_t>(first);
    box.high[k] = static_cast<uint8_t>(256 - end);
  }
  return box;
}

void check_boxes(const hull::BaseHull& base_hull, int count) {
  Lines lines(base_hull.head(), 5);
  const hull::Box whole = hull::box_of(base_hull.head());
  int met = 0, passed = 0;
  for (int i = 0; i < count; ++i) {
    test::note("segment", i);
    const Line line = lines.next(i);
    const BaseHullSegment segment(base_hull, line.a, line.b);
    for (int n = 0; n < 40; ++n) {
      const hull::NodeBox box = some_box(lines, line, base_hull.head());
      const Inside inside(line, hull::child_box(whole, box));
      if (!(inside.first < inside.last)) {
        passed +=
            segment.misses() || segment.enter(box, BaseHullSegment::kEnd) == BaseHullSegment::kNever
                ? 1
                : 0;
        continue;
      }
      ++met;
      CHECK(!segment.misses());
      const int32_t until = segment.until(static_cast<float>(inside.first));
      CHECK_LE(segment.enter(box, BaseHullSegment::kEnd), until);
      CHECK_LE(segment.enter(box, until), until);
    }
  }
  CHECK_LT(10 * count, met);
  CHECK_LT(count, passed);
}

// Lines through a face, at a thousandth of its size from an edge or a corner, or much nearer.
void check_faces(const hull::BaseHull& base_hull, int count) {
  Lines lines(base_hull.head(), 9);
  int crossed = 0;
  for (int i = 0; i < count; ++i) {
    test::note("segment", i);
    const uint32_t face = lines.below(base_hull.face_count());
    math::Vec3 corner_m[3];
    for (uint32_t k = 0; k < 3; ++k)
      corner_m[k] =
          hull::vertex(base_hull, base_hull.vertex_of(face, (k + static_cast<uint32_t>(i)) % 3));
    const double near = std::pow(10.0, -lines.between(2, 7));
    const double along = i % 3 == 0 ? near : lines.between(0, 1 - near);
    const Point p = to_point(corner_m[0]), q = to_point(corner_m[1]), r = to_point(corner_m[2]);
    const Point aim = p + (q - p) * along + (r - p) * near;
    const double reach[] = {1, 1, 300, 1e4, 1e5, 8e6, 1e8};
    Line line = lines.through(to_vec3(aim), reach[i % 7]);
    if (i % 2 == 0) {  // ends just behind the face
      const Point way = aim - to_point(line.a);
      line.b = to_vec3(aim + way * (0.01 * length(q - p) / length(way)));
    }
    if (mesh::exact_crossing(line.a, line.b, corner_m[0], corner_m[1], corner_m[2]).direction == 0)
      continue;
    ++crossed;
    const BaseHullSegment segment(base_hull, line.a, line.b);
    CHECK(!segment.misses());
    const hull::BaseHull::Leaf leaf = base_hull.leaf(face / hull::kLeafFaces);
    BaseHullSegment::Corners corners;
    CHECK_EQ(segment.locate(base_hull, leaf, corners), 0u);
    CHECK(!segment.passes(corners, leaf.faces[face % hull::kLeafFaces]));
  }
  CHECK_LT(count / 5, crossed);
}

template <class Check>
void each_hull(const Check& check) {
  const Surface ring = bumpy_ring(8, 4, 0.2);
  check(BakedHull(ring, 200, 16).view.base_hull());
  check(BakedHull(ring, 200, 22).view.base_hull());
  check(BakedHull(ring, 100000, 16).view.base_hull());  // kept vertices alone
  check(BakedHull(mesh_test::moved(ring, 1e-6, {}), 200, 22).view.base_hull());
  check(BakedHull(mesh_test::moved(ring, 3, {900, -800, 700}), 200, 22).view.base_hull());
}

}  // namespace

// A baker's grid contains the mesh. One that does not, of a hull without collapses, passes all
// rules.
TEST(BaseHullSegment_VerticesBeyondTheGrid_AreRuledOutByNothing) {
  BakedHull baked(bumpy_ring(4, 2), 100000, 16);
  for (Section& section : baked.sections) {
    if (section.type != hull::kHeadSection) continue;
    hull::Head& head = *reinterpret_cast<hull::Head*>(section.bytes.data());
    for (uint32_t k = 0; k < 3; ++k) head.grid_low_m[k] = head.low_m[k];
    head.cell_m = 0x1p-19f;
  }
  hull::View view;
  CHECK_EQ(open_baked(baked.sections, "model", view).rule, 0);
  check_faces(view.base_hull(), 4000);
}

TEST(BaseHullSegment_EveryBoxThatItMeets_IsEnteredInTime) {
  each_hull([](const hull::BaseHull& base_hull) { check_boxes(base_hull, 1200); });
}

TEST(BaseHullSegment_NoFaceThatItCrosses_IsPassedBy) {
  each_hull([](const hull::BaseHull& base_hull) { check_faces(base_hull, 12000); });
}

}  // namespace firmtouch::tools
