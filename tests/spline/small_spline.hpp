#pragma once
// Spline models of two pieces and four leaves, built without the baker and without heap, so that
// the tests run on the controller too and a rule can be broken by hand.
#include <stdint.h>

#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/proof/bend_bounds.hpp"
#include "firmtouch/spline/proof/leaf_shape.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "firmtouch/spline/proof/patch_radius.hpp"
#include "firmtouch/spline/surface/patch_grid.hpp"
#include "harness/rules.hpp"
#include "spline/stored_point.hpp"

namespace firmtouch::spline_test {

using test::bytes;

/// Two cubics in space that meet with a corner, or two patches (cubic by quadratic) beside each
/// other; each cut into two leaves along u.
struct SmallSpline {
  spline::Head head{};
  spline::Piece pieces[2] = {};
  float coefficients[2 * 48] = {};
  uint16_t leaves[4] = {0, 0, 1, 1};
  spline::CurveBend bends[2] = {};
  float points[5 * 3] = {};  // x and y of each, then z
  uint8_t curve_radii[7] = {};
  spline::Grid grids[2] = {};
  spline::Corner corners[12] = {};
  uint8_t radii[8] = {};                  // and two overlaps
  spline::PatchBend patch_bends[3] = {};  // one cell of the first piece, two of the second
  spline::Box boxes[1] = {};

  bool is_flat = false;  // its points are stored without z: a curve whose numbers must allow it

  explicit SmallSpline(bool is_surface, bool is_rational = false) {
    head.is_surface = is_surface ? 1 : 0;
    head.is_rational = is_rational ? 1 : 0;
    put_piece(0, {0, 0, 0}, is_surface, is_rational);
    put_piece(1, {2.0625f, 0.375f, 0x1p-6f}, is_surface, is_rational);
    derive();
  }

  spline::Sections sections() const {
    spline::Sections made;
    made.head = bytes(&head, sizeof head);
    made.pieces = bytes(pieces, sizeof pieces);
    made.coefficients = bytes(coefficients, head.coefficient_count * 4);
    if (head.is_surface != 0) {
      made.bends = bytes(patch_bends, sizeof patch_bends);
      made.nodes = bytes(boxes, sizeof boxes);
      made.points = bytes(corners, sizeof corners);
      made.grids = bytes(grids, sizeof grids);
      made.radii = bytes(radii, sizeof radii);
    } else {
      made.leaves = bytes(leaves, sizeof leaves);
      made.bends = bytes(bends, sizeof bends);
      made.points = bytes(points, is_flat ? 5 * sizeof(spline::Point) : sizeof points);
      made.radii = bytes(curve_radii, sizeof curve_radii);
    }
    return made;
  }
  spline::View view() const { return test::opened<spline::View>(sections()); }
  spline::LeafShape shape(uint32_t leaf) const {
    return shape(leaf / 2, spline::region_of(pieces[leaf / 2], leaf % 2, 0));
  }
  spline::LeafShape shape(uint32_t of, const spline::Region& part) const {
    spline::LeafShape made;
    spline::derive(pieces[of], coefficients + pieces[of].coefficients, part, made);
    if (head.is_surface != 0) spline::bound_bends(part, made);
    return made;
  }

  /// Everything that follows from the pieces.
  void derive() {
    const bool is_surface = head.is_surface != 0;
    head.piece_count = 2;
    head.leaf_count = 4;
    head.point_count = is_surface ? 12 : 5;
    head.extent_m = 3.9f;
    head.worst_steps = 100;
    head.loss_m = 0;
    for (uint32_t k = 0; k < 3; ++k) head.low_m[k] = 1e6f, head.high_m[k] = -1e6f;
    for (uint32_t i = 0; i < 4; ++i) {
      const spline::LeafShape s = shape(i);
      if (s.loss_m > head.loss_m) head.loss_m = s.loss_m;
      widen(s);
    }
    if (is_surface)
      derive_grids();
    else
      derive_curves();
  }

  // A point of a piece, in double.
  void point(uint32_t piece, double s, double t, double (&at)[3]) const {
    stored_point(pieces[piece], coefficients, s, t, at);
  }

 private:
  void put_piece(uint32_t i, math::Vec3 origin_m, bool is_surface, bool is_rational) {
    // s, s^2, s^3; t and t^2; s t.
    static const float kFirst[][3] = {{0, 0, 0},       {1, 0, 0},       {0, 0.125f, 0},
                                      {0, 0, 0x1p-6f}, {0, 0, 0.125f},  {0, 0x1p-6f, 0},
                                      {0, 0, 0},       {0, 0x1p-7f, 0}, {0, 0x1p-5f, 0},
                                      {0, 0x1p-8f, 0}, {0, 0, 0},       {0, 0, 0}};
    static const float kSecond[][3] = {
        {0, 0, 0},       {1, 0.25f, 0}, {-0x1p-4f, 0, 0}, {0, 0, 0},       {0, 0x1p-5f, 0.125f},
        {0x1p-6f, 0, 0}, {0, 0, 0},     {0, 0, 0},        {0x1p-6f, 0, 0}, {0, 0, 0x1p-7f},
        {0, 0, 0},       {0, 0, 0}};
    static const float kWeights[12] = {1, 0.0625f, 0.03125f, 0, 0.03125f};
    spline::Piece& piece = pieces[i];
    piece.degree_u = 3;
    piece.degree_v = is_surface ? 2 : 0;
    piece.level_u = 1;
    piece.is_rational = is_rational ? 1 : 0;
    piece.entity = i + 5;
    piece.origin_m[0] = origin_m.x, piece.origin_m[1] = origin_m.y, piece.origin_m[2] = origin_m.z;
    piece.middle_u = static_cast<float>(i) + 0.5f;
    piece.half_u = 0.5f;
    piece.coefficients = head.coefficient_count;
    for (uint32_t k = 0; k < (is_surface ? 12u : 4u); ++k) {
      for (uint32_t d = 0; d < 3; ++d)
        coefficients[head.coefficient_count++] = (i == 0 ? kFirst : kSecond)[k][d];
      if (is_rational) coefficients[head.coefficient_count++] = kWeights[k];
    }
  }

  void widen(const spline::LeafShape& s) {
    const math::Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (uint32_t k = 0; k < 3; ++k) {
      const spline::Extent e = spline::extent_along(s, {}, axes[k]);
      if (e.low < head.low_m[k]) head.low_m[k] = e.low;
      if (e.high > head.high_m[k]) head.high_m[k] = e.high;
    }
  }

  // Leaf i is node 4 + i; node 1 is the root, nodes 2 and 3 hold two leaves each.
  void derive_curves() {
    head.radius_unit_m = 0x1p-24f;
    for (uint32_t i = 0; i < 5; ++i) {
      double at[3];
      point(i < 4 ? i / 2 : 1, i % 2 == 0 ? (i == 4 ? 1.0 : -1.0) : 0.0, 0, at);
      points[2 * i] = static_cast<float>(at[0]);
      points[2 * i + 1] = static_cast<float>(at[1]);
      points[10 + i] = static_cast<float>(at[2]);
    }
    for (uint32_t p = 0; p < 2; ++p) {
      spline::CurveBends needed;
      for (uint32_t k = 0; k < spline::kFineSteps; ++k)
        (void)spline::add_bends(pieces[p], coefficients + pieces[p].coefficients, k, needed);
      bends[p] = needed.stored();
      bends[p].first_leaf = 2 * p;
    }
    static const uint32_t kEnds[7][2] = {{0, 4}, {0, 2}, {2, 4}, {0, 1}, {1, 2}, {2, 3}, {3, 4}};
    for (uint32_t node = 7; node > 0; --node) {
      const uint32_t(&ends)[2] = kEnds[node - 1];
      uint8_t& radius = curve_radii[node - 1] = 0;
      for (uint32_t leaf = ends[0]; leaf < ends[1]; ++leaf) {
        const float leaf_m = spline::in_units(head.radius_unit_m, curve_radii[3 + leaf]);
        const uint8_t needed = byte(
            head.radius_unit_m, node >= 4 ? spline::radius_for(shape(leaf), at(leaf), at(leaf + 1))
                                          : spline::radius_above(leaf_m, at(leaf), at(leaf + 1),
                                                                 at(ends[0]), at(ends[1])));
        if (needed > radius) radius = needed;
      }
    }
  }
  math::Vec3 at(uint32_t i) const { return {points[2 * i], points[2 * i + 1], points[10 + i]}; }

  void derive_grids() {
    for (uint32_t p = 0; p < 2; ++p) {
      spline::Grid& grid = grids[p];
      grid = {6 * p, 2 * p, p, p, 0x1p-13f, 0x1p-28f, 0x1p-26f, 0x1p-26f};
      for (uint32_t i = 0; i < 6; ++i) {
        double at[3];
        point(p, static_cast<double>(i % 3) - 1.0, i < 3 ? -1.0 : 1.0, at);
        int16_t* const to = &corners[6 * p + i].x;
        for (uint32_t k = 0; k < 3; ++k)
          to[k] = static_cast<int16_t>((at[k] - static_cast<double>(pieces[p].origin_m[k])) * 8192);
      }
      for (uint32_t i = 0; i < p + 1; ++i) {
        const spline::Region part = spline::region_of(spline::cell_levels(pieces[p], grid), i, 0);
        const float* const from = coefficients + pieces[p].coefficients;
        spline::CellBends needed;
        (void)spline::begin_bends(pieces[p], from, part, needed);
        for (uint32_t k = 0; k < spline::kFineCells; ++k)
          (void)spline::add_bends(pieces[p], from, part, k, needed);
        for (uint32_t k = 0; k < 5; ++k) {
          patch_bends[p + i].fixed[k] = byte(grid.fixed_unit_m2, needed.fixed[k]);
          patch_bends[p + i].turning[k] = byte(grid.turning_unit_m, needed.turning[k]);
        }
      }
      const spline::Patch whole{p, 0, 0, 0};
      for (uint32_t u = 0; u < 2; ++u) {
        const spline::LeafShape s = shape(2 * p + u);
        const spline::Patch leaf{p, 1, u, 0};
        const auto needed = [&](const spline::Patch& part) {
          const spline::RegionOfQuad own = spline::own_of(pieces[p], part, leaf);
          return byte(grid.radius_unit_m,
                      spline::radius_for(spline::LeafPoints(s), around(part), own));
        };
        radii[3 * p + 1 + u] = needed(leaf);
        const uint8_t above = needed(whole);
        if (u == 0 || above > radii[3 * p]) radii[3 * p] = above;
      }
      uint8_t& overlap = radii[6 + p];
      for (overlap = 0; !halves_hold(p, overlap);) ++overlap;
    }
    derive_box();
  }
  bool halves_hold(uint32_t p, uint32_t overlap) const {
    const spline::Patch whole{p, 0, 0, 0};
    const float stored_m = spline::in_units(grids[p].radius_unit_m, radii[3 * p]);
    for (uint32_t u = 0; u < 2; ++u) {
      const spline::Patch leaf{p, 1, u, 0};
      const spline::RegionOfQuad half = spline::half_of(pieces[p], whole, leaf, overlap);
      const spline::RegionOfQuad own = spline::own_of(pieces[p], whole, leaf);
      const spline::LeafShape s = shape(2 * p + u);
      const float needed_m = spline::radius_for(spline::LeafPoints(s), around(whole), own, half);
      if (!(needed_m <= stored_m)) return false;
    }
    return true;
  }
  spline::Quad around(const spline::Patch& p) const {
    return spline::stored_quad(pieces[p.piece], grids[p.piece], corners, p);
  }
  static uint8_t byte(float unit, float value) {
    return static_cast<uint8_t>(spline::byte_above(unit, value));
  }

  void derive_box() {
    constexpr float kShort = 1.0f - 0x1p-21f;
    spline::Box& box = boxes[0];
    box = {};
    const math::Vec3 middle_m = shape(0).middle_m;
    box.centre_m[0] = middle_m.x, box.centre_m[1] = middle_m.y, box.centre_m[2] = middle_m.z;
    box.axis[0][0] = 0.6f * kShort, box.axis[0][1] = 0.8f * kShort;
    box.axis[1][0] = -0.8f * kShort, box.axis[1][1] = 0.6f * kShort;
    for (uint32_t i = 0; i < 4; ++i) spline::enlarge(shape(i), box);
  }
};

/// Squared distance to the model in double, by sampling and refining about the best samples.
inline double sampled_distance(const SmallSpline& model, math::Vec3 p) {
  const bool is_surface = model.head.is_surface != 0;
  const int most = is_surface ? 24 : 200;
  double best2 = 1e300;
  for (uint32_t piece = 0; piece < 2; ++piece) {
    double u = 0, v = 0, d2 = 1e300;
    const auto look = [&](double s, double t) {
      s = s < -1 ? -1 : s > 1 ? 1 : s;
      t = t < -1 ? -1 : t > 1 ? 1 : t;
      double at[3];
      model.point(piece, s, t, at);
      const double x = at[0] - static_cast<double>(p.x), y = at[1] - static_cast<double>(p.y),
                   z = at[2] - static_cast<double>(p.z), found = x * x + y * y + z * z;
      if (!(found < d2)) return false;
      d2 = found, u = s, v = t;
      return true;
    };
    for (int i = -most; i <= most; ++i)
      for (int j = is_surface ? -most : 0; j <= (is_surface ? most : 0); ++j)
        (void)look(static_cast<double>(i) / most, static_cast<double>(j) / most);
    for (double step = 1.0 / most; step > 1e-9; step *= 0.5)
      for (bool moved = true; moved;) {
        moved = false;
        for (int i = -1; i <= 1; ++i)
          for (int j = is_surface ? -1 : 0; j <= (is_surface ? 1 : 0); ++j)
            moved = look(u + i * step, v + j * step) || moved;
      }
    if (d2 < best2) best2 = d2;
  }
  double root = best2 < 1 ? 1 : best2;  // Heron's method: no library here
  for (int i = 0; i < 60; ++i) root = 0.5 * (root + best2 / root);
  return root;
}

}  // namespace firmtouch::spline_test
