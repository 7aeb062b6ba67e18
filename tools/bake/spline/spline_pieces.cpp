#include "bake/spline/spline_pieces.hpp"

#include "firmtouch/spline/proof/bend_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace firmtouch::tools {
namespace {

using Four = std::array<double, 4>;  // weighted x, y, z and the weight

double choose(int n, int k) {
  double product = 1;
  for (int i = 0; i < k; ++i) product = product * (n - i) / (i + 1);
  return product;
}

// Bernstein coefficients over 0 to 1 become powers of s = 2 t - 1, row by row.
void to_powers(std::vector<Four>& c, int degree, size_t first, size_t stride) {
  std::vector<Four> power(static_cast<size_t>(degree) + 1, Four{});
  for (int k = 0; k <= degree; ++k)
    for (size_t d = 0; d < 4; ++d) {
      double sum = 0;  // of t^k
      for (int j = 0; j <= k; ++j)
        sum += ((k - j) % 2 == 0 ? 1 : -1) * choose(k, j) *
               c[first + static_cast<size_t>(j) * stride][d];
      power[static_cast<size_t>(k)][d] = choose(degree, k) * sum;
    }
  for (int low = 0; low < degree; ++low)  // t = 1 / 2 + s / 2
    for (int k = degree - 1; k >= low; --k)
      for (size_t d = 0; d < 4; ++d)
        power[static_cast<size_t>(k)][d] += 0.5 * power[static_cast<size_t>(k) + 1][d];
  double scale = 1;
  for (int k = 0; k <= degree; ++k, scale *= 0.5)
    for (size_t d = 0; d < 4; ++d)
      c[first + static_cast<size_t>(k) * stride][d] = scale * power[static_cast<size_t>(k)][d];
}

void halve(const std::vector<Four>& whole, int degree, size_t first, size_t stride,
           std::vector<Four>& low, std::vector<Four>& high) {
  std::vector<Four> row;
  for (int k = 0; k <= degree; ++k) row.push_back(whole[first + static_cast<size_t>(k) * stride]);
  for (int k = 0; k <= degree; ++k) {
    low[first + static_cast<size_t>(k) * stride] = row.front();
    high[first + static_cast<size_t>(degree - k) * stride] = row.back();
    for (size_t i = 0; i + 1 < row.size(); ++i)
      for (size_t d = 0; d < 4; ++d) row[i][d] = 0.5 * (row[i][d] + row[i + 1][d]);
    row.pop_back();
  }
}

std::vector<Four> weighted(const BezierPatch& patch) {
  std::vector<Four> c;
  for (const ControlPoint& p : patch.points) c.push_back({p.x * p.w, p.y * p.w, p.z * p.w, p.w});
  return c;
}

BezierPatch with_points(const BezierPatch& patch, const std::vector<Four>& c) {
  BezierPatch made = patch;
  for (size_t i = 0; i < c.size(); ++i)
    made.points[i] = {c[i][0] / c[i][3], c[i][1] / c[i][3], c[i][2] / c[i][3], c[i][3]};
  return made;
}

double length(const Four& c) { return std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]); }

}  // namespace

BezierPatch turned_over(const BezierPatch& patch) {
  BezierPatch made = patch;
  const auto wide = static_cast<std::ptrdiff_t>(patch.degree_u) + 1;
  for (auto row = made.points.begin(); row != made.points.end(); row += wide)
    std::reverse(row, row + wide);
  std::swap(made.u0, made.u1);
  return made;
}

BezierPatch as_patch(const BezierCurve& curve) {
  BezierPatch patch;
  patch.degree_u = curve.degree;
  patch.points = curve.points;
  patch.u0 = curve.t0;
  patch.u1 = curve.t1;
  patch.v0 = patch.v1 = 0;
  patch.piece = curve.piece;
  return patch;
}

std::vector<BezierPatch> halves_of(const BezierPatch& patch, bool along_v) {
  const std::vector<Four> c = weighted(patch);
  std::vector<Four> low = c, high = c;
  const size_t columns = static_cast<size_t>(patch.degree_u) + 1;
  const size_t rows = static_cast<size_t>(patch.degree_v) + 1;
  for (size_t k = 0; k < (along_v ? columns : rows); ++k)
    halve(c, along_v ? patch.degree_v : patch.degree_u, along_v ? k : k * columns,
          along_v ? columns : 1, low, high);
  std::vector<BezierPatch> made{with_points(patch, low), with_points(patch, high)};
  if (along_v)
    made[0].v1 = made[1].v0 = 0.5 * (patch.v0 + patch.v1);
  else
    made[0].u1 = made[1].u0 = 0.5 * (patch.u0 + patch.u1);
  return made;
}

StoredPiece store_piece(const BezierPatch& patch, bool is_surface) {
  StoredPiece stored;
  spline::Piece& piece = stored.piece;
  const bool weighs = is_rational(patch.points);
  piece.degree_u = static_cast<uint8_t>(patch.degree_u);
  piece.degree_v = static_cast<uint8_t>(patch.degree_v);
  piece.is_rational = weighs ? 1 : 0;
  piece.entity = static_cast<uint32_t>(patch.piece);
  piece.middle_u = static_cast<float>(0.5 * (patch.u0 + patch.u1));
  piece.half_u = static_cast<float>(0.5 * (patch.u1 - patch.u0));
  piece.middle_v = static_cast<float>(0.5 * (patch.v0 + patch.v1));
  piece.half_v = static_cast<float>(0.5 * (patch.v1 - patch.v0));
  const Point middle = point_at(patch, 0.5, is_surface ? 0.5 : 0);
  const double origin_m[3] = {middle.x, middle.y, middle.z};
  for (size_t k = 0; k < 3; ++k) piece.origin_m[k] = static_cast<float>(origin_m[k]);

  std::vector<Four> c;
  double least = HUGE_VAL;
  for (const ControlPoint& p : patch.points) {
    const double w = weighs ? p.w : 1;
    c.push_back({w * (p.x - static_cast<double>(piece.origin_m[0])),
                 w * (p.y - static_cast<double>(piece.origin_m[1])),
                 w * (p.z - static_cast<double>(piece.origin_m[2])), w});
    least = std::min(least, w);
  }
  const size_t columns = static_cast<size_t>(patch.degree_u) + 1;
  const size_t rows = static_cast<size_t>(patch.degree_v) + 1;
  for (size_t j = 0; j < rows; ++j) to_powers(c, patch.degree_u, j * columns, 1);
  for (size_t i = 0; i < columns; ++i) to_powers(c, patch.degree_v, i, columns);
  const double scale = 1 / c[0][3];  // a weight of 1 in the middle
  least *= scale;
  double moved_m = 0, moved_weight = 0, reach_m = 0;
  for (Four& f : c) {
    Four off{};
    for (size_t d = 0; d < (weighs ? 4u : 3u); ++d) {
      f[d] *= scale;
      stored.coefficients.push_back(static_cast<float>(f[d]));
      off[d] = static_cast<double>(stored.coefficients.back()) - f[d];
    }
    moved_m += length(off);
    moved_weight += std::fabs(off[3]);
    reach_m += length(f);
  }
  // The doubles themselves are good to a few 1e-16 of what they are computed from.
  stored.deviation_m = (moved_m + moved_weight * reach_m / least + 1e-13 * reach_m) / least;
  return stored;
}

spline::LeafShape shape_of(const StoredPiece& stored, uint32_t level_u, uint32_t index_u,
                           uint32_t level_v, uint32_t index_v) {
  spline::Piece piece = stored.piece;
  piece.level_u = static_cast<uint8_t>(level_u & 15u);
  piece.level_v = static_cast<uint8_t>(level_v & 15u);
  const spline::Region part = spline::region_of(piece, index_u, index_v);
  spline::LeafShape shape;
  spline::derive(piece, stored.coefficients.data(), part, shape);
  if (shape.min_weight > 0.0f) spline::bound_bends(part, shape);
  return shape;
}

bool bound_cell(const StoredPiece& stored, const spline::Halvings& levels, uint32_t index_u,
                uint32_t index_v, spline::CellBends& bends) {
  const spline::Region cell = spline::region_of(levels, index_u, index_v);
  const float* const coefficients = stored.coefficients.data();
  bool has_weight = spline::begin_bends(stored.piece, coefficients, cell, bends);
  for (uint32_t k = 0; k < spline::kFineCells && has_weight; ++k)
    has_weight = spline::add_bends(stored.piece, coefficients, cell, k, bends);
  return has_weight;
}

}  // namespace firmtouch::tools
