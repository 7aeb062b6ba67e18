#include "footpoint/border.hpp"

#include <cmath>
#include <utility>

#include "footpoint/curve_system.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kSame = 1e-9;    // of the extent, beside the gap
constexpr double kSmooth = 1e-6;  // sine between normals or tangents, beside 1000 gaps

struct Edge {
  Border border;
  BezierCurve inner;  // the row of points beside it
};

Point place_of(const ControlPoint& p) { return {p.x, p.y, p.z}; }

// Side 0: v = v0, 1: v = v1, 2: u = u0, 3: u = u1.
Edge edge_of(const BezierPatch& s, size_t patch, int side) {
  const auto wide = static_cast<size_t>(s.degree_u) + 1, high = static_cast<size_t>(s.degree_v) + 1;
  const bool is_row = side < 2, is_far = side % 2 == 1;
  const size_t last = (is_row ? high : wide) - 1, fixed = is_far ? last : 0;
  const size_t beside = is_far ? last - 1 : 1;
  Edge e;
  e.border.patch = patch;
  e.border.side = side;
  e.border.curve.degree = e.inner.degree = is_row ? s.degree_u : s.degree_v;
  e.border.curve.piece = e.inner.piece = s.piece;
  for (size_t k = 0; k < (is_row ? wide : high); ++k) {
    e.border.curve.points.push_back(s.points[is_row ? fixed * wide + k : k * wide + fixed]);
    e.inner.points.push_back(s.points[is_row ? beside * wide + k : k * wide + beside]);
  }
  const double u = is_far ? s.u1 : s.u0, v = is_far ? s.v1 : s.v0;
  e.border.u0 = is_row ? s.u0 : u, e.border.u1 = is_row ? s.u1 : u;
  e.border.v0 = is_row ? v : s.v0, e.border.v1 = is_row ? v : s.v1;
  return e;
}

bool is_point(const BezierCurve& c, double tolerance) {
  for (const ControlPoint& p : c.points)
    if (length(place_of(p) - place_of(c.points.front())) > tolerance) return false;
  return true;
}

bool coincide(const BezierCurve& a, const BezierCurve& b, bool is_turned, double tolerance) {
  if (a.degree != b.degree) return false;
  const size_t n = a.points.size();
  const double ratio = b.points[is_turned ? n - 1 : 0].w / a.points[0].w;
  for (size_t k = 0; k < n; ++k) {
    const ControlPoint& p = b.points[is_turned ? n - 1 - k : k];
    if (length(place_of(a.points[k]) - place_of(p)) > tolerance) return false;
    if (std::fabs(p.w - ratio * a.points[k].w) > 1e-5 * p.w) return false;
  }
  return true;
}

// Whether the surface goes on across two edges that coincide: its normals agree, and the inner rows
// lie on either side.
bool is_smooth(const Edge& a, const Edge& b, bool is_turned, double sine) {
  const CurveSystem along(a.border.curve);
  for (int k = 0; k <= 16; ++k) {
    const double s = k / 16.0, t = is_turned ? 1 - s : s;
    const Point tangent = along.gradient(s);
    const Point into_a = point_at(a.inner, s) - point_at(a.border.curve, s);
    const Point into_b = point_at(b.inner, t) - point_at(b.border.curve, t);
    const Point m = cross(tangent, into_a), n = cross(tangent, into_b);
    const double size = length(m) * length(n);
    if (!(size > 1e-12 * dot(tangent, tangent) * length(into_a) * length(into_b))) continue;
    if (!(dot(m, n) < 0) || length(cross(m, n)) > sine * size) return false;
  }
  return true;
}

// Direction in which a border leaves its end.
Point leaving(const Border& border, bool at_end) {
  const Point d = CurveSystem(border.curve).gradient(at_end ? 1 : 0);
  return at_end ? d * -1.0 : d;
}

}  // namespace

void find_borders(const std::vector<BezierPatch>& patches, double gap, double extent_m,
                  std::vector<Border>& borders, std::vector<Corner>& corners,
                  std::vector<Joint>& joints, std::vector<std::array<Neighbour, 4>>& neighbours) {
  neighbours.assign(patches.size(), {});
  const double tolerance = (kSame + gap) * extent_m, sine = kSmooth + 1000 * gap;
  const auto add_corner = [&](const Corner& c) {
    for (const Corner& known : corners)
      if (length(known.at - c.at) <= tolerance) return;
    corners.push_back(c);
  };
  std::vector<Edge> edges;
  for (size_t k = 0; k < patches.size(); ++k) {
    for (int side = 0; side < 4; ++side) {
      Edge e = edge_of(patches[k], k, side);
      if (is_point(e.border.curve, tolerance)) {
        add_corner(
            {place_of(e.border.curve.points.front()), patches[k].piece, e.border.u0, e.border.v0});
      } else {
        edges.push_back(std::move(e));
      }
    }
  }
  std::vector<Point> middles;
  for (const Edge& e : edges) middles.push_back(point_at(e.border.curve, 0.5));
  for (size_t a = 0; a < edges.size(); ++a) {
    size_t others = 0;
    bool goes_on = false;
    Neighbour neighbour;
    for (size_t b = 0; b < edges.size(); ++b) {
      if (a == b || length(middles[a] - middles[b]) > tolerance) continue;
      const BezierCurve &p = edges[a].border.curve, &q = edges[b].border.curve;
      const bool straight = coincide(p, q, false, tolerance);
      const bool turned = !straight && coincide(p, q, true, tolerance);
      if (!straight && !turned) continue;
      ++others;
      goes_on = is_smooth(edges[a], edges[b], turned, sine);
      neighbour = {edges[b].border.patch, edges[b].border.side, turned};
    }
    const Border& border = edges[a].border;
    if (others != 1 || !goes_on) {
      borders.push_back(border);
      continue;
    }
    neighbours[border.patch][static_cast<size_t>(border.side)] = neighbour;
    if (std::pair(border.patch, border.side) < std::pair(neighbour.patch, neighbour.side))
      joints.push_back({border, neighbour});
  }
  for (const Border& border : borders) {
    for (const bool at_end : {false, true}) {
      const Point at = place_of(at_end ? border.curve.points.back() : border.curve.points.front());
      const Point out = leaving(border, at_end);
      size_t meeting = 0;
      bool goes_on = false;
      for (const Border& other : borders) {
        for (const bool other_end : {false, true}) {
          if (&other == &border && other_end == at_end) continue;
          const ControlPoint& p =
              other_end ? other.curve.points.back() : other.curve.points.front();
          if (length(place_of(p) - at) > tolerance) continue;
          ++meeting;
          const Point d = leaving(other, other_end);
          goes_on |= dot(d, out) < 0 && length(cross(d, out)) <= sine * length(d) * length(out);
        }
      }
      if (meeting != 1 || !goes_on)
        add_corner({at, border.curve.piece, at_end ? border.u1 : border.u0,
                    at_end ? border.v1 : border.v0});
    }
  }
}

}  // namespace firmtouch::tools
