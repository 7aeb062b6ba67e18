#pragma once
// Curves of a few samples, built without the baker and without heap, so that the tests run on the
// controller too and a rule can be broken by hand.
#include <stdint.h>

#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/curve/derived.hpp"
#include "firmtouch/curve/view.hpp"
#include "harness/rules.hpp"

namespace firmtouch::curve_test {

using test::bytes;

/// A curve of up to `Most` samples and all that follows from them.
template <uint32_t Most>
struct CurveOf {
  curve::Head head{};
  curve::Sample samples[Most];
  float arcs[Most];
  uint32_t tree[Most];
  curve::Run runs[curve::run_count_of(Most, curve::kMinRunLevels)];
  uint16_t radii[Most / 2 + curve::parts_of(curve::kMaxRunLevels) + 1];  // of any levels
  curve::Box boxes[2 * curve::run_count_of(Most, curve::kMinRunLevels) - 1];

  template <uint32_t N>
  explicit CurveOf(const curve::Sample (&from)[N]) {
    static_assert(N >= 2 && N <= Most);
    build(from, N);
  }
  CurveOf(const curve::Sample* from, uint32_t count) { build(from, count); }

  curve::Sections sections() const {
    const uint32_t n = head.sample_count;
    return {bytes(&head, sizeof head),
            bytes(samples, n * 12),
            bytes(arcs, n * 4),
            bytes(tree, n * 4),
            bytes(boxes, (2 * run_count() - 1) * 12),
            bytes(runs, run_count() * uint32_t{sizeof(curve::Run)}),
            bytes(radii, run_count() * (curve::parts_of(levels()) + 1) * 2)};
  }
  curve::View view() const { return test::opened<curve::View>(sections()); }

  void build(const curve::Sample* from, uint32_t count) {
    head = {};
    for (uint32_t i = 0; i < count; ++i) samples[i] = from[i];
    head.sample_count = count;
    head.run_levels = 4;
    derive();
  }
  // Everything that follows from the samples.
  void derive() {
    const uint32_t n = head.sample_count;
    derive_head(n);
    double travelled_m = 0;
    for (uint32_t i = 1; i < n; ++i) travelled_m += spacing_m(i);
    head.length_m = static_cast<float>(travelled_m);
    head.longest_half_m = 0;
    for (uint32_t i = 1; i < n; ++i) {
      const float half_m = curve::half_segment_m(samples[i - 1], samples[i]);
      if (half_m > head.longest_half_m) head.longest_half_m = half_m;
    }
    double so_far_m = 0;
    for (uint32_t i = 0; i < n; ++i) {
      if (i > 0) so_far_m += spacing_m(i);
      arcs[i] = i + 1 == n ? 1.0f : static_cast<float>(so_far_m / travelled_m);
    }
    for (uint32_t i = 0; i < n; ++i) order_[i] = i;
    place(n);
    derive_runs();
  }
  /// Those of a damaged head would shift by more than a word has.
  uint32_t levels() const {
    return head.run_levels <= curve::kMaxRunLevels ? head.run_levels : curve::kMaxRunLevels;
  }
  uint32_t run_count() const { return curve::run_count_of(head.sample_count, levels()); }
  // Runs are leaves in turn: another tree than the baker's, as good to open().
  void derive_runs() {
    derive_grid();
    const uint32_t count = run_count();
    for (uint32_t r = 0; r < count; ++r) {
      runs[r].leaf = runs[r].run = count - 1 - r;
      const uint32_t levels = head.run_levels, parts = curve::parts_of(levels);
      for (uint32_t k = 0; k < parts; ++k) {
        const curve::Part part = curve::part_of(levels, r, k, head.sample_count - 1);
        radii[r * (parts + 1) + k] =
            curve::part_radius(track(), head.is_smooth != 0, part.first, part.last);
      }
      radii[r * (parts + 1) + parts] = 0;
      derive_box(boxes[2 * (count - 1) - r], curve::part_of(levels, r, 0, head.sample_count - 1));
    }
    for (uint32_t i = count - 1; i-- > 0;) {
      const curve::Box &a = boxes[2 * i + 1], &b = boxes[2 * i + 2];
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t low_a = query::low_of(a.side[k]), low_b = query::low_of(b.side[k]);
        const uint32_t high_a = query::high_of(a.side[k]), high_b = query::high_of(b.side[k]);
        boxes[i].side[k] =
            query::make_axis(low_a < low_b ? low_a : low_b, high_a > high_b ? high_a : high_b);
      }
    }
  }

  curve::Track track() const { return {samples, head.sample_count, head.is_closed != 0}; }

 private:
  double spacing_m(uint32_t i) const {
    return static_cast<double>(math::length(curve::vec(samples[i]) - curve::vec(samples[i - 1])));
  }
  void derive_head(uint32_t n) {
    for (uint32_t k = 0; k < 3; ++k) {
      head.low_m[k] = head.high_m[k] = (&samples[0].x_m)[k];
      for (uint32_t i = 1; i < n; ++i) {
        const float at = (&samples[i].x_m)[k];
        if (at < head.low_m[k]) head.low_m[k] = at;
        if (at > head.high_m[k]) head.high_m[k] = at;
      }
    }
    head.diagonal_m = curve::diagonal_m(head);
    const curve::Sample &a = samples[0], &b = samples[n - 1];
    head.is_closed = math::length(curve::vec(a) - curve::vec(b)) > 0.0f ? 0 : 1;
  }
  void derive_grid() {
    float extent_m = 0;
    for (uint32_t k = 0; k < 3; ++k) {
      const float side_m = head.high_m[k] - head.low_m[k];
      if (side_m > extent_m) extent_m = side_m;
    }
    head.cell_m = 0x1p-60f;
    const float room = head.is_smooth != 0 ? 0.5f : 0.125f;
    while (head.cell_m * 32767.0f < (1.0f + 2.0f * room) * extent_m) head.cell_m *= 2.0f;
    for (uint32_t k = 0; k < 3; ++k) head.grid_low_m[k] = head.low_m[k] - room * extent_m;
  }
  void derive_box(curve::Box& box, curve::Part part) const {
    for (uint32_t k = 0; k < 3; ++k) {
      uint32_t low = curve::kGridMax, high = 0;
      for (uint32_t s = part.first; s <= part.last; ++s) {
        const float cells = curve::cells_of(head, (&samples[s].x_m)[k], k);
        const auto down = static_cast<uint32_t>(cells);
        const uint32_t up = static_cast<float>(down) < cells ? down + 1 : down;
        low = down < low ? down : low;
        high = up > high ? up : high;
        if (head.is_smooth == 0 || s == part.last) continue;
        const curve::Cubic c = curve::cubic_of(track(), s);
        const math::Vec3 offs[] = {c.c1, c.c2};
        for (const math::Vec3& off : offs) {
          const float at = curve::cells_of(head, (&samples[s].x_m)[k], (&off.x)[k], k);
          const auto cell = static_cast<uint32_t>(at);
          low = cell - 1 < low ? cell - 1 : low;
          high = cell + 2 > high ? cell + 2 : high;
        }
      }
      box.side[k] = query::make_axis(low, high);
    }
  }
  // Axes in turn, by insertion sort: another tree than the baker's, as good to open().
  void place(uint32_t n) {
    struct Range {
      uint32_t node, begin, end;
    };
    Range open[32] = {{0, 0, n}};
    for (uint32_t count = 1; count > 0;) {
      const Range r = open[--count];
      uint32_t level = 0;
      for (uint32_t at = r.node; at != 0; at = curve::parent_of(at)) ++level;
      const uint32_t axis = level % 3;
      for (uint32_t i = r.begin + 1; i < r.end; ++i)
        for (uint32_t j = i; j > r.begin; --j) {
          if (!curve::comes_before(samples, axis, order_[j], order_[j - 1])) break;
          const uint32_t moved = order_[j];
          order_[j] = order_[j - 1];
          order_[j - 1] = moved;
        }
      uint32_t first = 0;  // nodes below the first child: those whose way up passes it
      for (uint32_t i = 0; i < n; ++i) first += is_below(i, 2 * r.node + 1) ? 1u : 0u;
      const uint32_t middle = r.begin + first;
      tree[r.node] = curve::make_node(order_[middle], axis);
      if (middle > r.begin) open[count++] = {2 * r.node + 1, r.begin, middle};
      if (middle + 1 < r.end) open[count++] = {2 * r.node + 2, middle + 1, r.end};
    }
  }
  static bool is_below(uint32_t node, uint32_t top) {
    while (node > top) node = curve::parent_of(node);
    return node == top;
  }

  uint32_t order_[Most];
};

using SmallCurve = CurveOf<8>;
using LongCurve = CurveOf<256>;  // 8 KB: for static memory

/// The one long curve of tests that need no other beside it: a controller has not the RAM for one
/// each. It stays until the next call.
inline LongCurve& shared_curve(const curve::Sample* from, uint32_t count) {
  static LongCurve curve(from, count);
  curve.build(from, count);
  return curve;
}

/// Squared distance to the polyline in double, over every segment.
template <uint32_t Most>
double brute_distance2(const CurveOf<Most>& c, math::Vec3 p) {
  const auto wide = [](float value) { return static_cast<double>(value); };
  double least = 1e300;
  for (uint32_t i = 0; i + 1 < c.head.sample_count; ++i) {
    const curve::Sample &a = c.samples[i], &b = c.samples[i + 1];
    const double e[3] = {wide(b.x_m) - wide(a.x_m), wide(b.y_m) - wide(a.y_m),
                         wide(b.z_m) - wide(a.z_m)};
    const double v[3] = {wide(p.x) - wide(a.x_m), wide(p.y) - wide(a.y_m), wide(p.z) - wide(a.z_m)};
    double t =
        (v[0] * e[0] + v[1] * e[1] + v[2] * e[2]) / (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    double d2 = 0;
    for (int k = 0; k < 3; ++k) d2 += (v[k] - t * e[k]) * (v[k] - t * e[k]);
    if (d2 < least) least = d2;
  }
  return least;
}

}  // namespace firmtouch::curve_test
