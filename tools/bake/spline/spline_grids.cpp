#include <algorithm>
#include <array>
#include <cmath>

#include "bake/spline/spline_pole.hpp"
#include "bake/spline/spline_tree.hpp"
#include "bake/tree/left_filled.hpp"
#include "bake/tree/principal_axes.hpp"
#include "bake/tree/widest_axis.hpp"
#include "firmtouch/math/isa.hpp"
#include "firmtouch/spline/proof/patch_radius.hpp"
#include "firmtouch/spline/surface/patch_grid.hpp"

namespace firmtouch::tools {
namespace {

struct Cut {
  StoredPiece stored;
  std::vector<spline::LeafShape> shapes;  // of its leaves, row by row
  std::vector<spline::LeafPoints> points;
  std::array<float, 3> middle_m;
  uint32_t order;  // in the file
};

struct Range {
  uint32_t node, begin, end;
};

std::vector<Cut> cuts_of(const std::vector<StoredPiece>& pieces) {
  std::vector<Cut> cuts;
  for (const StoredPiece& stored : pieces) {
    Cut cut{stored, {}, {}, {}, static_cast<uint32_t>(cuts.size())};
    const spline::Piece& piece = stored.piece;
    for (size_t k = 0; k < 3; ++k) cut.middle_m[k] = piece.origin_m[k];
    for (uint32_t v = 0; v < 1u << piece.level_v; ++v)
      for (uint32_t u = 0; u < 1u << piece.level_u; ++u) {
        cut.shapes.push_back(shape_of(stored, piece.level_u, u, piece.level_v, v));
        cut.points.emplace_back(cut.shapes.back());
      }
    cuts.push_back(std::move(cut));
  }
  return cuts;
}

// From its middle.
Point at(const spline::LeafShape& shape, double x, double y) {
  Point sum{};
  double w = 0, py = 1;
  for (uint32_t j = 0; j <= shape.degree_v; ++j, py *= y) {
    double px = py;
    for (uint32_t i = 0; i <= shape.degree_u; ++i, px *= x) {
      const uint32_t k = j * (shape.degree_u + 1) + i;
      sum = sum + to_point(shape.c[k]) * px;
      w += static_cast<double>(shape.w[k]) * px;
    }
  }
  return sum * (1 / w);
}

double volume(const spline::Box& box, double min_m) {
  double product = 1;
  for (const float half_m : box.half_m) product *= static_cast<double>(half_m) + min_m;
  return product;
}

// Along the principal axes of points of the pieces, or along the model's, whichever is smaller.
spline::Box box_around(const std::vector<Cut>& cuts, uint32_t begin, uint32_t end) {
  std::vector<Point> samples;
  for (uint32_t i = begin; i < end; ++i)
    for (const spline::LeafShape& shape : cuts[i].shapes)
      for (const double y : {-1.0, 0.0, 1.0})
        for (const double x : {-1.0, 0.0, 1.0})
          samples.push_back(to_point(shape.middle_m) + at(shape, x, y));
  spline::Box best{};
  double least = HUGE_VAL;
  for (const bool is_own : {true, false}) {
    const Frame frame = is_own ? principal_axes(samples) : Frame{};
    double low[3], high[3];
    for (size_t k = 0; k < 3; ++k) {
      low[k] = HUGE_VAL, high[k] = -HUGE_VAL;
      for (const Point& s : samples) {
        low[k] = std::min(low[k], dot(s, frame.axis[k]));
        high[k] = std::max(high[k], dot(s, frame.axis[k]));
      }
    }
    spline::Box box{};
    Point centre{};
    for (size_t k = 0; k < 3; ++k) centre = centre + frame.axis[k] * (0.5 * (low[k] + high[k]));
    const math::Vec3 c = to_vec3(centre);
    box.centre_m[0] = c.x, box.centre_m[1] = c.y, box.centre_m[2] = c.z;
    for (size_t k = 0; k < 2; ++k) {
      const math::Vec3 axis = to_vec3(frame.axis[k] * (1 - 0x1p-21));
      box.axis[k][0] = axis.x, box.axis[k][1] = axis.y, box.axis[k][2] = axis.z;
    }
    for (uint32_t i = begin; i < end; ++i)
      for (const spline::LeafShape& shape : cuts[i].shapes) spline::enlarge(shape, box);
    const double size =
        volume(box, 1e-3 * static_cast<double>(box.half_m[0] + box.half_m[1] + box.half_m[2]));
    if (size < least) {
      least = size;
      best = box;
    }
  }
  return best;
}

// Pieces in the order of a tree whose levels are filled from the left, with the boxes of its inner
// nodes.
std::vector<spline::Box> build_tree(std::vector<Cut>& cuts) {
  const auto count = static_cast<uint32_t>(cuts.size());
  std::vector<spline::Box> boxes(count - 1);
  std::vector<Cut> ordered(count);
  std::vector<Range> open{{0, 0, count}};
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    const uint32_t size = range.end - range.begin;
    if (size == 1) {
      ordered[range.node - (count - 1)] = std::move(cuts[range.begin]);
      continue;
    }
    boxes[range.node] = box_around(cuts, range.begin, range.end);
    const uint32_t middle = range.begin + (first_size(2 * size - 1) + 1) / 2;
    const size_t axis =
        widest_axis(cuts, range.begin, range.end, [](const Cut& c) { return c.middle_m; });
    std::sort(cuts.begin() + range.begin, cuts.begin() + range.end,
              [axis](const Cut& a, const Cut& b) {
                if (a.middle_m[axis] < b.middle_m[axis]) return true;
                if (b.middle_m[axis] < a.middle_m[axis]) return false;
                return a.order < b.order;
              });
    open.push_back({spline::first_child(range.node), range.begin, middle});
    open.push_back({spline::first_child(range.node) + 1, middle, range.end});
  }
  cuts = std::move(ordered);
  return boxes;
}

// Corners stand off the surface, along its normal, by half of what the leaves about them sag in the
// middle: so a leaf lies on both sides of its quad, half as far from it.
void place_corners(const Cut& cut, spline::Grid& grid, std::vector<spline::Corner>& corners) {
  const uint32_t columns = 1u << cut.stored.piece.level_u, rows = 1u << cut.stored.piece.level_v;
  std::vector<Point> places;
  double most = 0;
  for (uint32_t v = 0; v <= rows; ++v)
    for (uint32_t u = 0; u <= columns; ++u) {
      Point sum{};
      double count = 0;
      for (uint32_t j = v == 0 ? 0 : v - 1; j < std::min(v + 1, rows); ++j)
        for (uint32_t i = u == 0 ? 0 : u - 1; i < std::min(u + 1, columns); ++i) {
          const spline::LeafShape& shape = cut.shapes[j * columns + i];
          const Point on = at(shape, i < u ? 1 : -1, j < v ? 1 : -1);
          Point sag{};
          for (const double x : {-1.0, 1.0})
            for (const double y : {-1.0, 1.0}) sag = sag + at(shape, x, y) * 0.25;
          const Point normal = cross(to_point(shape.c[1]), to_point(shape.c[shape.degree_u + 1]));
          const double length2 = dot(normal, normal);
          sag = length2 > 0 ? normal * (dot(normal, sag) / length2) : Point{};
          sum = sum + to_point(shape.local_m) + on - sag * 0.5;
          count += 1;
        }
      places.push_back(sum * (1 / count));
      most = std::max({most, std::fabs(places.back().x), std::fabs(places.back().y),
                       std::fabs(places.back().z)});
    }
  double step_m = 0x1p-90;
  while (step_m * 32767 < most) step_m *= 2;
  grid.step_m = static_cast<float>(step_m);
  const auto steps = [step_m](double x) { return static_cast<int16_t>(std::lround(x / step_m)); };
  for (const Point& p : places) corners.push_back({steps(p.x), steps(p.y), steps(p.z)});
}

// The largest unit whose bytes reach up to the value: so the least of its others is 2^-31 of it.
float unit_for(float most) {
  constexpr float kMin = 0x1p-100f;
  const uint32_t bits = math::bits_of(most) + 0xFFFFFu, least = math::bits_of(kMin);
  const uint32_t below = bits >= (255u << 20) ? bits - (255u << 20) : 0;
  return below < least ? kMin : math::float_of(below & ~0xFFFFFu);
}

// Cells as large as may be, except where weights vary too much on them.
std::vector<spline::CellBends> cells_of(const Cut& cut, uint32_t least, spline::Grid& grid) {
  const spline::Piece& piece = cut.stored.piece;
  for (uint32_t level = least;; ++level) {
    grid.cell_level = level;
    const spline::Halvings cell = spline::cell_levels(piece, grid);
    std::vector<spline::CellBends> cells;
    bool has_weight = true;
    for (uint32_t v = 0; v < 1u << cell.v; ++v)
      for (uint32_t u = 0; u < 1u << cell.u; ++u) {
        spline::CellBends bends;
        has_weight = bound_cell(cut.stored, cell, u, v, bends) && has_weight;
        cells.push_back(bends);
      }
    if (has_weight || (cell.u == piece.level_u && cell.v == piece.level_v)) return cells;
  }
}

void store_bends(const Cut& cut, uint32_t cell_level, spline::Grid& grid,
                 std::vector<spline::PatchBend>& bends) {
  const StoredPiece& stored = cut.stored;
  Point pole_m;
  // Beside a pole the derivatives along its ring vanish: the less of the rest a cell holds, the
  // less they are.
  const uint32_t least = has_pole(stored.piece, stored.coefficients.data(), pole_m)
                             ? spline::kMaxHalvingsAcross
                             : cell_level + stored.piece.is_rational;
  const std::vector<spline::CellBends> cells = cells_of(cut, least, grid);
  float fixed = 0, turning = 0;
  for (const spline::CellBends& cell : cells)
    for (uint32_t k = 0; k < 5; ++k) {
      fixed = std::max(fixed, cell.fixed[k]);
      turning = std::max(turning, cell.turning[k]);
    }
  grid.fixed_unit_m2 = unit_for(fixed);
  grid.turning_unit_m = unit_for(turning);
  for (const spline::CellBends& cell : cells) {
    spline::PatchBend bend{};
    for (uint32_t k = 0; k < 5; ++k) {
      bend.fixed[k] = static_cast<uint8_t>(spline::byte_above(grid.fixed_unit_m2, cell.fixed[k]));
      bend.turning[k] =
          static_cast<uint8_t>(spline::byte_above(grid.turning_unit_m, cell.turning[k]));
    }
    bends.push_back(bend);
  }
}

struct Bounds {
  std::vector<uint8_t> radii, overlaps;
};

// The radii of all parts: of each what the farthest of its leaves needs.
void store_radii(const Cut& cut, uint32_t number, spline::Grid& grid,
                 const std::vector<spline::Corner>& corners, Bounds& bounds) {
  const spline::Piece& piece = cut.stored.piece;
  const uint32_t depth = 0u + piece.level_u + piece.level_v, columns = 1u << piece.level_u;
  const size_t first = bounds.radii.size();
  std::vector<float> needed_m(2 * cut.shapes.size() - 1);
  for (uint32_t i = 0; i < cut.shapes.size(); ++i) {
    const spline::Patch leaf{number, depth, i % columns, i / columns};
    for (spline::Patch part = leaf;; part = spline::parent_of(piece, part)) {
      const spline::Quad quad = spline::stored_quad(piece, grid, corners.data(), part);
      const float radius_m =
          spline::radius_for(cut.points[i], quad, spline::own_of(piece, part, leaf));
      float& max_m =
          needed_m[radius_of(grid, part, spline::halvings_of(piece, part.depth)) - first];
      max_m = std::max(max_m, radius_m);
      if (part.depth == 0) break;
    }
  }
  grid.radius_unit_m = unit_for(*std::max_element(needed_m.begin(), needed_m.end()));
  for (const float radius_m : needed_m)
    bounds.radii.push_back(static_cast<uint8_t>(spline::byte_above(grid.radius_unit_m, radius_m)));
}

// With which each leaf lies within the radii about its halves of the parts above it: about the
// least. What one leaf needs may be too much for how another is seen to lie, so that all are tested
// until none needs more; halves that are the whole hold all.
void store_overlaps(const Cut& cut, uint32_t number, const spline::Grid& grid,
                    const std::vector<spline::Corner>& corners, Bounds& bounds) {
  constexpr uint32_t kWhole = 128;
  const spline::Piece& piece = cut.stored.piece;
  const uint32_t depth = 0u + piece.level_u + piece.level_v, columns = 1u << piece.level_u;
  bounds.overlaps.resize(bounds.overlaps.size() + cut.shapes.size() - 1);
  const auto fits = [&](uint32_t i, const spline::Patch& leaf, const spline::Patch& above,
                        uint32_t overlap) {
    const uint32_t at = radius_of(grid, above, spline::halvings_of(piece, above.depth));
    const float needed_m = spline::radius_for(
        cut.points[i], spline::stored_quad(piece, grid, corners.data(), above),
        spline::own_of(piece, above, leaf), spline::half_of(piece, above, leaf, overlap));
    return needed_m <= spline::in_units(grid.radius_unit_m, bounds.radii[at]);
  };
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (uint32_t i = 0; i < cut.shapes.size(); ++i) {
      const spline::Patch leaf{number, depth, i % columns, i / columns};
      for (spline::Patch above = leaf; above.depth != 0;) {
        above = spline::parent_of(piece, above);
        uint8_t& byte =
            bounds.overlaps[overlap_of(grid, above, spline::halvings_of(piece, above.depth))];
        for (; byte < kWhole && !fits(i, leaf, above, byte); ++byte) has_changed = true;
      }
    }
  }
}

}  // namespace

SplineGrids build_spline_grids(std::vector<StoredPiece>& pieces, uint32_t cell_level) {
  SplineGrids made;
  std::vector<Cut> cuts = cuts_of(pieces);
  for (const Cut& cut : cuts)
    for (const spline::LeafShape& shape : cut.shapes)
      for (uint32_t k = 0; k < 5; ++k)
        if (!(shape.fixed[k] <= 0x1p90f && shape.turning[k] <= 0x1p90f)) return made;
  made.boxes = build_tree(cuts);
  uint32_t leaves = 0;
  Bounds bounds;
  for (size_t i = 0; i < cuts.size(); ++i) {
    spline::Grid grid{};
    grid.first_corner = static_cast<uint32_t>(made.corners.size());
    grid.first_leaf = leaves;
    grid.first_cell = static_cast<uint32_t>(made.bends.size());
    leaves += static_cast<uint32_t>(cuts[i].shapes.size());
    place_corners(cuts[i], grid, made.corners);
    store_bends(cuts[i], cell_level, grid, made.bends);
    store_radii(cuts[i], static_cast<uint32_t>(i), grid, made.corners, bounds);
    store_overlaps(cuts[i], static_cast<uint32_t>(i), grid, made.corners, bounds);
    made.grids.push_back(grid);
    pieces[i] = cuts[i].stored;
  }
  made.radii = std::move(bounds.radii);
  made.radii.insert(made.radii.end(), bounds.overlaps.begin(), bounds.overlaps.end());
  return made;
}

}  // namespace firmtouch::tools
