#include "spline/spline_sink.hpp"

#include <algorithm>
#include <utility>

namespace firmtouch::tools {
namespace {

constexpr double kMaxCoordinate_m = 1e9;
constexpr double kMinExtent_m = 1e-6;
constexpr double kFlatness = 1e-9;  // of the extent

Point place_of(const ControlPoint& p) { return {p.x, p.y, p.z}; }

double extent_of(const std::vector<ControlPoint>& points) {
  Point low = place_of(points.front()), high = low;
  for (const ControlPoint& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

// Every point near the plane through the first, the one farthest from it, and the one farthest from
// the line through both.
bool lies_in_a_plane(const std::vector<ControlPoint>& points) {
  const Point origin = place_of(points.front());
  Point along, normal;
  for (const ControlPoint& p : points) {
    const Point d = place_of(p) - origin;
    if (dot(d, d) > dot(along, along)) along = d;
  }
  for (const ControlPoint& p : points) {
    const Point n = cross(along, place_of(p) - origin);
    if (dot(n, n) > dot(normal, normal)) normal = n;
  }
  const double size = length(normal), extent = extent_of(points);
  if (!(size > kFlatness * length(along) * extent)) return true;  // a straight line
  for (const ControlPoint& p : points)
    if (!(std::abs(dot(normal, place_of(p) - origin)) <= kFlatness * extent * size)) return false;
  return true;
}

// Whether its derivatives are parallel wherever they are looked at: what it covers is a curve.
bool has_no_area(const SplineSurface& s) {
  constexpr int kSamples = 9;     // of each parameter: within, so that borders may be points
  constexpr double kStep = 1e-4;  // of each parameter's range, to each side
  constexpr double kSine = 1e-6, kRounding = 1e-12;  // the latter of the extent
  const double least = kRounding * extent_of(s.points);
  const double du = s.u1 - s.u0, dv = s.v1 - s.v0;
  for (int j = 0; j < kSamples; ++j)
    for (int i = 0; i < kSamples; ++i) {
      const double u = s.u0 + du * (i + 0.47) / kSamples, v = s.v0 + dv * (j + 0.47) / kSamples;
      const Point a = point_at(s, u + kStep * du, v) - point_at(s, u - kStep * du, v);
      const Point b = point_at(s, u, v + kStep * dv) - point_at(s, u, v - kStep * dv);
      const double of_a = length(a), of_b = length(b);
      if (std::min(of_a, of_b) > least && length(cross(a, b)) > kSine * of_a * of_b) return false;
    }
  return true;
}

// Pieces that a range of knots is cut into.
size_t spans_within(const std::vector<double>& knots, double from, double to) {
  size_t spans = 0;
  for (size_t k = 1; k < knots.size(); ++k)
    spans += knots[k - 1] < knots[k] && knots[k] > from && knots[k - 1] < to;
  return spans;
}

}  // namespace

bool SplineSink::fail(const std::string& what) {
  if (!failed()) problem_ = path_ + ": " + what;
  return false;
}

bool SplineSink::fail(uint64_t line, const std::string& what) {
  if (!failed()) problem_ = path_ + ":" + std::to_string(line) + ": " + what;
  return false;
}

bool SplineSink::defect(uint64_t line, const std::string& kind, const std::string& what) {
  if (!failed()) kind_ = kind;
  if (failed() && kind_ != kind) {
    ++others_;
    return false;
  }
  fail(line, what);
  ++times_;
  last_line_ = line;
  return false;
}

void SplineSink::report_dropped(const std::string& where, size_t dropped, const char* what) {
  if (dropped == 0) return;
  note(where + ": left out " + std::to_string(dropped) +
       (dropped == 1 ? " piece that has" : " pieces that have") + " no " + what +
       ", because their control points coincide");
}

void SplineSink::add(SplineCurve curve, uint64_t line) {
  curve.piece = pieces_;
  const size_t spans = spans_within(curve.knots, curve.t0, curve.t1);
  const std::vector<BezierCurve> pieces = bezier_pieces(curve);
  if (pieces.empty() || !(extent_of(curve.points) >= kMinExtent_m)) {
    defect(line, "length",
           curve.where +
               " has no length (less than a thousandth of a millimetre): remove it, or "
               "check the unit");
    return;
  }
  report_dropped(curve.where, spans - pieces.size(), "length");
  curve.is_planar = lies_in_a_plane(curve.points);
  model_.curves.push_back(std::move(curve));
  ++pieces_;
}

void SplineSink::add(SplineSurface surface, uint64_t line) {
  surface.piece = pieces_;
  const size_t spans = spans_within(surface.knots_u, surface.u0, surface.u1) *
                       spans_within(surface.knots_v, surface.v0, surface.v1);
  const size_t kept = bezier_pieces(surface).size();
  if (kept == 0 || !(extent_of(surface.points) >= kMinExtent_m)) {
    defect(line, "length",
           surface.where +
               " has no extent (less than a thousandth of a millimetre): remove it, "
               "or check the unit");
    return;
  }
  if (has_no_area(surface)) {
    defect(line, "area",
           surface.where +
               " has no area: all of it lies on one curve, beside which no query could be exact; "
               "remove it");
    return;
  }
  report_dropped(surface.where, spans - kept, "extent");
  model_.surfaces.push_back(std::move(surface));
  ++pieces_;
}

SplineModel SplineSink::finish() {
  if (!failed() && pieces_ == 0)
    fail(
        "holds no curve and no surface that can be read: export NURBS curves (126) or untrimmed "
        "NURBS surfaces (128)");
  if (!failed()) return std::move(model_);
  SplineModel refused;
  refused.problem = problem_;
  if (times_ > 1)
    refused.problem +=
        " (" + std::to_string(times_) + " times, last in line " + std::to_string(last_line_) + ")";
  if (others_ > 0)
    refused.problem += "; " + std::to_string(others_) + " other problem" + (others_ > 1 ? "s" : "");
  return refused;
}

SplineDefect check_coordinates(const std::vector<ControlPoint>& points) {
  for (size_t i = 0; i < points.size(); ++i) {
    const ControlPoint& p = points[i];
    if (std::abs(p.x) <= kMaxCoordinate_m && std::abs(p.y) <= kMaxCoordinate_m &&
        std::abs(p.z) <= kMaxCoordinate_m)
      continue;
    return {"control point " + std::to_string(i) +
                " (from 0) lies more than 1e9 m from the origin: check its numbers and the unit",
            i};
  }
  return {};
}

}  // namespace firmtouch::tools
