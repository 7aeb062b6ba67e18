#include "curve/curve_points.hpp"

#include <cmath>
#include <cstdio>

#include "firmtouch/curve/layout.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

// A little above what opening requires, because it computes in float32.
constexpr double kMinSpacing_m = double{curve::kMinSpacing_m} * (1 + 1e-6);
constexpr double kMinDiagonal_m = double{curve::kMinDiagonal_m} * (1 + 2e-6);

double square(float a, float b) {
  const double difference = double{a} - double{b};
  return difference * difference;
}

double distance_m(math::Vec3 a, math::Vec3 b) {
  return std::sqrt(square(a.x, b.x) + square(a.y, b.y) + square(a.z, b.z));
}

std::string place_of(const CurvePoints& points, size_t i) {
  if (i < points.lines.size()) return "line " + std::to_string(points.lines[i]);
  return "row " + std::to_string(points.rows[i]) + " (from 0)";
}

void drop_repeated(CurvePoints& points) {
  size_t kept = 0, dropped = 0;
  std::string first_dropped;
  for (size_t i = 0; i < points.samples_m.size(); ++i) {
    if (kept > 0 && distance_m(points.samples_m[kept - 1], points.samples_m[i]) < kMinSpacing_m) {
      if (dropped++ == 0) first_dropped = place_of(points, i);
      continue;
    }
    points.samples_m[kept] = points.samples_m[i];
    if (!points.lines.empty()) points.lines[kept] = points.lines[i];
    points.rows[kept++] = points.rows[i];
  }
  points.samples_m.resize(kept);
  points.rows.resize(kept);
  if (!points.lines.empty()) points.lines.resize(kept);
  if (dropped == 0) return;
  points.notes.push_back("dropped " + std::to_string(dropped) +
                         (dropped == 1 ? " sample that repeats" : " samples that repeat") +
                         " the one before (first: " + first_dropped + ")");
}

// A ring computed in floating point (sin 2 pi = -2.4e-16) ends beside its first sample.
void close_ring(CurvePoints& points) {
  if (points.samples_m.size() < 3) return;
  const math::Vec3 first = points.samples_m.front();
  math::Vec3& last = points.samples_m.back();
  float largest_m = 0;
  for (const math::Vec3& s : points.samples_m)
    largest_m =
        std::fmax(largest_m, std::fmax(std::fabs(s.x), std::fmax(std::fabs(s.y), std::fabs(s.z))));
  const double gap_m = distance_m(first, last);
  if (!(gap_m > 0) || !(gap_m <= double{largest_m} * 0x1p-23)) return;
  char text[96];
  std::snprintf(text, sizeof text, "closed: the last row is %.2g m from the first, within rounding",
                gap_m);
  points.notes.push_back(text);
  last = first;
}

bool fits(float value) { return std::abs(value) <= curve::kMaxCoordinate_m; }

}  // namespace

void mend_curve(CurvePoints& points, const std::string& name) {
  if (!points.problem.empty()) return;
  for (size_t i = 0; i < points.samples_m.size(); ++i) {
    const math::Vec3& s = points.samples_m[i];
    if (fits(s.x) && fits(s.y) && fits(s.z)) continue;
    points.problem = name + ": " + place_of(points, i) +
                     " lies more than 1e9 m from the origin: check its numbers and --unit";
    return;
  }
  const size_t rows = points.samples_m.size();
  close_ring(points);
  drop_repeated(points);
  if (rows < 2) {
    points.problem = name + ": " + (rows == 0 ? "no samples" : "only one sample") +
                     " below the header: a curve needs at least two";
  } else if (points.samples_m.size() < 2) {
    points.problem = name + ": all " + std::to_string(rows) +
                     " samples are the same point: the curve has no length; record it anew";
  } else if (points.samples_m.size() > curve::kMaxSamples) {
    points.problem = name + ": " + std::to_string(points.samples_m.size()) +
                     " samples are more than " + std::to_string(curve::kMaxSamples) +
                     ": thin the recording or cut it";
  } else if (!(diagonal_m(points.samples_m) >= kMinDiagonal_m)) {
    points.problem = name +
                     ": the whole curve is smaller than a thousandth of a millimetre: check "
                     "the unit (coordinates are metres unless --unit says otherwise)";
  }
}

}  // namespace firmtouch::tools
