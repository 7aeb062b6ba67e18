#include "footpoint/critical_grid.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::tools {
namespace {

double reach(Point b, Point half) {
  return std::fabs(b.x) * half.x + std::fabs(b.y) * half.y + std::fabs(b.z) * half.z;
}

struct Range {
  double low, high;
  bool has_zero() const { return low <= 0 && high >= 0; }
};

// Values of a - <P, b> over a box of P and all of the parameters, by its coefficients.
Range range_of(const Scalars& a, const Points& b, Point middle, Point half) {
  Range r{1e300, -1e300};
  for (size_t k = 0; k < a.c.size(); ++k) {
    const double value = a.c[k] - dot(middle, b.c[k]), slack = reach(b.c[k], half);
    r.low = std::min(r.low, value - slack), r.high = std::max(r.high, value + slack);
  }
  return r;
}

Range times(Range a, Range b) {
  const double p[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
  return {*std::min_element(p, p + 4), *std::max_element(p, p + 4)};
}

// Both halves of a polynomial with points for coefficients.
void split(Points& low, Points& high, bool along_v) {
  Scalars part(low.degree_u, low.degree_v), other;
  high = low;
  double Point::*const kAxes[] = {&Point::x, &Point::y, &Point::z};
  for (const auto axis : kAxes) {
    for (size_t k = 0; k < low.c.size(); ++k) part.c[k] = low.c[k].*axis;
    if (along_v)
      split_v(part, other);
    else
      split_u(part, other);
    for (size_t k = 0; k < low.c.size(); ++k) {
      low.c[k].*axis = part.c[k];
      high.c[k].*axis = other.c[k];
    }
  }
}

void split(Scalars& low, Scalars& high, bool along_v) {
  if (along_v)
    split_v(low, high);
  else
    split_u(low, high);
}

}  // namespace

// A part of a piece's parameters, the equations there and their derivatives.
struct CriticalGrid::Work {
  uint32_t piece;
  Point origin;
  Scalars a[2];
  Points b[2];
  bool splits_v;  // next
};

CriticalGrid::CriticalGrid(const Footpoints& feet, int levels, double margin) : levels_(levels) {
  Point low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  const auto grow = [&](const std::vector<ControlPoint>& points) {
    for (const ControlPoint& p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  };
  for (const CurveSystem& c : feet.curves()) grow(c.piece.points);
  for (const SurfaceSystem& s : feet.patches()) grow(s.patch.points);
  is_flat_ = !(high.z > low.z);
  side_ = feet.extent_m() * (1 + 2 * margin);
  const Point middle = (low + high) * 0.5;
  low_ = middle - Point{side_, side_, side_} * 0.5;
  count_ = size_t{1} << levels;
  lists_.resize(count_ * count_ * (is_flat_ ? 1 : count_));
  if (is_flat_) low_.z = middle.z;
  for (size_t k = 0; k < feet.curves().size(); ++k) {
    mark_curve(k, feet.curves()[k]);
    if (feet.previous_of(k) != Footpoints::kNone) mark_joint(feet.previous_of(k), k, feet);
  }
  for (size_t k = 0; k < feet.patches().size(); ++k)
    mark_patch(k + feet.curves().size(), feet.patches()[k]);
}

Point CriticalGrid::middle_of(int level, size_t x, size_t y, size_t z, Point& half) const {
  const double size = side_ / static_cast<double>(size_t{1} << level);
  half = {0.5 * size, 0.5 * size, is_flat_ ? 0 : 0.5 * size};
  return low_ + Point{(static_cast<double>(x) + 0.5) * size, (static_cast<double>(y) + 0.5) * size,
                      is_flat_ ? 0 : (static_cast<double>(z) + 0.5) * size};
}

void CriticalGrid::mark(size_t x, size_t y, size_t z, uint32_t piece) {
  std::vector<uint32_t>& list = lists_[(z * count_ + y) * count_ + x];
  if (std::find(list.begin(), list.end(), piece) == list.end()) list.push_back(piece);
}

void CriticalGrid::mark_curve(size_t piece, const CurveSystem& system) {
  Work work{static_cast<uint32_t>(piece), system.origin, {system.a, {}}, {system.b, {}}, false};
  descend(work, 0, 0, 0, 0);
}

void CriticalGrid::descend(Work& work, int level, size_t x, size_t y, size_t z) {
  Point half;
  const Point middle = middle_of(level, x, y, z, half) - work.origin;
  if (!range_of(work.a[0], work.b[0], middle, half).has_zero() ||
      !range_of(derivative_u(work.a[0]), derivative_u(work.b[0]), middle, half).has_zero())
    return;
  if (level == levels_) return mark(x, y, z, work.piece);
  Work low = work, high = work;
  split(low.a[0], high.a[0], false);
  split(low.b[0], high.b[0], false);
  for (size_t k = 0; k < (is_flat_ ? 4u : 8u); ++k) {
    for (Work* part : {&low, &high})
      descend(*part, level + 1, 2 * x + (k & 1), 2 * y + (k >> 1 & 1), 2 * z + (k >> 2));
  }
}

// Where a point on the normal of a joint sees the derivative change its sign over it.
void CriticalGrid::mark_joint(size_t from, size_t to, const Footpoints& feet) {
  const CurveSystem &a = feet.curves()[from], &b = feet.curves()[to];
  for (size_t cell = 0; cell < lists_.size(); ++cell) {
    Point half;
    const size_t x = cell % count_, y = cell / count_ % count_, z = cell / count_ / count_;
    const Point middle = middle_of(levels_, x, y, z, half);
    const auto at = [&](double value, Point gradient, Point origin) {
      const double v = value - dot(middle - origin, gradient), slack = reach(gradient, half);
      return Range{v - slack, v + slack};
    };
    if (!at(b.a.c.front(), b.b.c.front(), b.origin).has_zero()) continue;
    const Range before = at(a.a_slope.c.back(), a.b_slope.c.back(), a.origin);
    const Range after = at(b.a_slope.c.front(), b.b_slope.c.front(), b.origin);
    if ((before.low > 0 && after.low > 0) || (before.high < 0 && after.high < 0)) continue;
    mark(x, y, z, static_cast<uint32_t>(from));
    mark(x, y, z, static_cast<uint32_t>(to));
  }
}

void CriticalGrid::mark_patch(size_t index, const SurfaceSystem& system) {
  Work work{static_cast<uint32_t>(index),
            system.origin,
            {system.a[0], system.a[1]},
            {system.b[0], system.b[1]},
            false};
  descend_patch(work, 0, 0, 0, 0);
}

void CriticalGrid::descend_patch(Work& work, int level, size_t x, size_t y, size_t z) {
  Point half;
  const Point middle = middle_of(level, x, y, z, half) - work.origin;
  Range slope[2][2];
  for (size_t k = 0; k < 2; ++k) {
    if (!range_of(work.a[k], work.b[k], middle, half).has_zero()) return;
    slope[k][0] = range_of(derivative_u(work.a[k]), derivative_u(work.b[k]), middle, half);
    slope[k][1] = range_of(derivative_v(work.a[k]), derivative_v(work.b[k]), middle, half);
  }
  const Range plus = times(slope[0][0], slope[1][1]), minus = times(slope[0][1], slope[1][0]);
  if (!Range{plus.low - minus.high, plus.high - minus.low}.has_zero()) return;
  if (level == levels_) return mark(x, y, z, work.piece);
  std::vector<Work> parts(4, work);
  for (size_t k = 0; k < 2; ++k) {
    split(parts[0].a[k], parts[1].a[k], false);
    split(parts[0].b[k], parts[1].b[k], false);
    for (size_t i = 0; i < 2; ++i) {
      split(parts[i].a[k], parts[i + 2].a[k], true);
      split(parts[i].b[k], parts[i + 2].b[k], true);
    }
  }
  for (size_t k = 0; k < (is_flat_ ? 4u : 8u); ++k)
    for (Work& part : parts)
      descend_patch(part, level + 1, 2 * x + (k & 1), 2 * y + (k >> 1 & 1), 2 * z + (k >> 2));
}

bool CriticalGrid::cell_of(Point p_m, size_t& cell) const {
  const double scale = static_cast<double>(count_) / side_;
  const double x = (p_m.x - low_.x) * scale, y = (p_m.y - low_.y) * scale,
               z = is_flat_ ? 0 : (p_m.z - low_.z) * scale;
  const auto most = static_cast<double>(count_);
  if (!(x >= 0 && x < most && y >= 0 && y < most && z >= 0 && z < most)) return false;
  cell =
      (static_cast<size_t>(z) * count_ + static_cast<size_t>(y)) * count_ + static_cast<size_t>(x);
  return true;
}

bool CriticalGrid::cells_between(Point a_m, Point b_m, std::vector<size_t>& cells) const {
  size_t low = 0, high = 0;
  cells.clear();
  if (!cell_of({std::min(a_m.x, b_m.x), std::min(a_m.y, b_m.y), std::min(a_m.z, b_m.z)}, low) ||
      !cell_of({std::max(a_m.x, b_m.x), std::max(a_m.y, b_m.y), std::max(a_m.z, b_m.z)}, high))
    return false;
  const size_t square = count_ * count_;
  for (size_t z = low / square; z <= high / square; ++z)
    for (size_t y = low / count_ % count_; y <= high / count_ % count_; ++y)
      for (size_t x = low % count_; x <= high % count_; ++x)
        cells.push_back((z * count_ + y) * count_ + x);
  return true;
}

size_t CriticalGrid::marked() const {
  size_t n = 0;
  for (const std::vector<uint32_t>& list : lists_) n += !list.empty();
  return n;
}

void CriticalGrid::box_of(size_t cell, Point& low, Point& high) const {
  Point half;
  const Point middle =
      middle_of(levels_, cell % count_, cell / count_ % count_, cell / count_ / count_, half);
  low = middle - half, high = middle + half;
}

}  // namespace firmtouch::tools
