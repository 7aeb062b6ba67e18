#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "surface/check/mending.hpp"
#include "surface/check/near_sheets.hpp"
#include "surface/edges.hpp"
#include "surface/exact_side.hpp"
#include "surface/near_faces.hpp"
#include "surface/point.hpp"

// A corner or an edge that touches the surface elsewhere, decided without rounding. A point
// inside whose nearest point is the contact may get the sign of either sheet. Nothing inside is
// nearest to a convex corner or edge: where only such meet there is no harm.

namespace firmtouch::tools {
namespace {

using math::Vec3;

// Sides of doubles below this, beside the products they are made of, are not sure.
constexpr double kRounding = 1e-14;

double coordinate(Vec3 v, size_t axis) {
  return static_cast<double>(axis == 0 ? v.x : axis == 1 ? v.y : v.z);
}

// A plane to look at the faces of, along the axis that their normal is nearest to.
struct Look {
  size_t axis = 0;
  double sign = 1;  // of the normal on it

  explicit Look(Point normal) {
    const double size[3] = {std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)};
    axis = size[0] > size[1] ? (size[0] > size[2] ? 0 : 2) : (size[1] > size[2] ? 1 : 2);
    sign = (axis == 0 ? normal.x : axis == 1 ? normal.y : normal.z) < 0 ? -1 : 1;
  }

  // 1 where c lies to the left of the way from a to b, seen against the normal; -1 to the right.
  int exact_turn(Vec3 a, Vec3 b, Vec3 c) const {
    Vec3 over = a;
    float& x = axis == 0 ? over.x : axis == 1 ? over.y : over.z;
    const bool is_below = x >= 1;  // away from a, never farther from 0 than exact_side() takes
    x = is_below ? 0 : x + 2;
    const int side = exact_side(a, b, c, over);
    return (sign < 0) != is_below ? -side : side;
  }
  // The same, 0 where doubles are not sure.
  int sure_turn(Vec3 a, Vec3 b, Vec3 c) const {
    const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double bu = coordinate(b, u) - coordinate(a, u), bv = coordinate(b, v) - coordinate(a, v);
    const double cu = coordinate(c, u) - coordinate(a, u), cv = coordinate(c, v) - coordinate(a, v);
    const double turn = sign * (bu * cv - bv * cu);
    const double doubt = kRounding * (std::fabs(bu * cv) + std::fabs(bv * cu));
    return turn > doubt ? 1 : turn < -doubt ? -1 : 0;
  }
  int turn(Vec3 a, Vec3 b, Vec3 c) const {
    const int sure = sure_turn(a, b, c);
    return sure != 0 ? sure : exact_turn(a, b, c);
  }
};

enum class Where { kElsewhere, kOnEdge, kInside };

class Touches {
 public:
  Touches(const Surface& surface, const std::vector<uint32_t>& mates)
      : surface_(surface), mates_(mates), half_of_(surface.vertices.size()) {
    for (uint32_t h = 0; h < mates_.size(); ++h) half_of_[start_of(surface.faces, h)] = h;
  }

  // `near`: the faces above f that may meet it.
  void look_at(uint32_t f, const std::vector<uint32_t>& near) {
    for (const uint32_t g : near) {
      for (uint32_t k = 0; k < 3; ++k) look_at_corner(f, k, g), look_at_corner(g, k, f);
      for (uint32_t k = 0; k < 3; ++k) look_at_edge(f, k, g), look_at_edge(g, k, f);
      if (has_same_places(f, g)) faces.insert(f);
    }
  }

  // What touches, with the first face that it touches.
  std::map<uint32_t, uint32_t> corners;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> edges;
  std::set<uint32_t> faces;

 private:
  Vec3 at(uint32_t f, uint32_t k) const { return surface_.vertices[surface_.faces[f][k % 3]]; }
  Point point(uint32_t f, uint32_t k) const { return to_point(at(f, k)); }
  static bool is_same(Vec3 a, Vec3 b) {
    return !(a.x < b.x || a.x > b.x || a.y < b.y || a.y > b.y || a.z < b.z || a.z > b.z);
  }
  bool has(uint32_t f, uint32_t v) const {
    const Face& face = surface_.faces[f];
    return face[0] == v || face[1] == v || face[2] == v;
  }
  Look look(uint32_t f) const {
    return Look(cross(point(f, 1) - point(f, 0), point(f, 2) - point(f, 0)));
  }
  int side(uint32_t f, Vec3 p) const { return exact_side(at(f, 0), at(f, 1), at(f, 2), p); }

  // Where on face g the point lies, and on which of its edges; at a corner it is elsewhere.
  Where where_on(uint32_t g, Vec3 p, uint32_t& edge) const {
    const Look from = look(g);
    for (uint32_t k = 0; k < 3; ++k)
      if (is_same(p, at(g, k)) || from.sure_turn(at(g, k), at(g, k + 1), p) < 0)
        return Where::kElsewhere;
    if (side(g, p) != 0) return Where::kElsewhere;
    Where where = Where::kInside;
    for (uint32_t k = 0; k < 3; ++k) {
      const int turn = from.turn(at(g, k), at(g, k + 1), p);
      if (turn < 0) return Where::kElsewhere;
      if (turn == 0) where = Where::kOnEdge, edge = 3 * g + k;
    }
    return where;
  }

  void look_at_corner(uint32_t f, uint32_t k, uint32_t g) {
    const uint32_t v = surface_.faces[f][k];
    if (has(g, v)) return;
    uint32_t edge = kNone;
    const Where where = where_on(g, surface_.vertices[v], edge);
    if (where == Where::kElsewhere) return;
    if (where == Where::kOnEdge && is_convex_edge(edge) && is_pointed(v)) return;
    const uint32_t first = corners.emplace(v, g).first->second;
    corners[v] = std::min(first, g);
  }

  void look_at_edge(uint32_t f, uint32_t k, uint32_t g) {
    const uint32_t half = 3 * f + k;
    if (has(g, surface_.faces[f][k]) && has(g, surface_.faces[f][(k + 1) % 3])) return;
    const Vec3 p = at(f, k), q = at(f, k + 1);
    const bool lies_in_plane = side(g, p) == 0 && side(g, q) == 0;
    if (lies_in_plane && runs_inside(p, q, g)) return add(half, g);
    for (uint32_t j = 0; j < 3; ++j) {
      const Vec3 r = at(g, j), s = at(g, j + 1);
      // Edges with a common end are crossed nowhere else; to decide that exactly would take
      // longest.
      if (is_same(p, r) || is_same(p, s) || is_same(q, r) || is_same(q, s)) continue;
      if (is_crossed(p, q, r, s) && !(is_convex_edge(half) && is_convex_edge(3 * g + j)))
        return add(half, g);
    }
  }

  void add(uint32_t half, uint32_t g) {
    const uint32_t a = start_of(surface_.faces, half), b = end_of(surface_.faces, half);
    const std::pair<uint32_t, uint32_t> edge{std::min(a, b), std::max(a, b)};
    const uint32_t first = edges.emplace(edge, g).first->second;
    edges[edge] = std::min(first, g);
  }

  // Whether both pass through one point that is an end of neither.
  static bool is_crossed(Vec3 p, Vec3 q, Vec3 r, Vec3 s) {
    const Point normal = cross(to_point(q) - to_point(p), to_point(s) - to_point(r));
    if (!(dot(normal, normal) > 0)) return false;
    const Look from(normal);
    const int a = from.sure_turn(p, q, r), b = from.sure_turn(p, q, s);
    const int c = from.sure_turn(r, s, p), d = from.sure_turn(r, s, q);
    if ((a != 0 && a == b) || (c != 0 && c == d)) return false;
    if (exact_side(p, q, r, s) != 0) return false;
    return from.turn(p, q, r) * from.turn(p, q, s) < 0 &&
           from.turn(r, s, p) * from.turn(r, s, q) < 0;
  }

  // Of an edge in the plane of g: whether a part of it lies inside g, not along its edges.
  bool runs_inside(Vec3 p, Vec3 q, uint32_t g) const {
    const Look from = look(g);
    const size_t u = (from.axis + 1) % 3, v = (from.axis + 2) % 3;
    double begin = 0, end = 1;
    for (uint32_t k = 0; k < 3; ++k) {
      const Vec3 a = at(g, k), b = at(g, k + 1);
      const int first = from.turn(a, b, p), last = from.turn(a, b, q);
      if (first <= 0 && last <= 0) return false;
      if (first >= 0 && last >= 0) continue;
      const auto height = [&](Vec3 c) {
        return (coordinate(b, u) - coordinate(a, u)) * (coordinate(c, v) - coordinate(a, v)) -
               (coordinate(b, v) - coordinate(a, v)) * (coordinate(c, u) - coordinate(a, u));
      };
      const double t = height(p) / (height(p) - height(q));
      if (first < 0) begin = std::max(begin, t);
      if (last < 0) end = std::min(end, t);
    }
    return end - begin > 1e-9;
  }

  bool has_same_places(uint32_t f, uint32_t g) const {
    for (uint32_t k = 0; k < 3; ++k) {
      const Vec3 p = at(f, k);
      if (!(is_same(p, at(g, 0)) || is_same(p, at(g, 1)) || is_same(p, at(g, 2)))) return false;
    }
    return true;
  }

  bool is_convex_edge(uint32_t half) const {
    const uint32_t mate = mates_[half];
    if (mate == kNone) return false;
    return side(half / 3, at(mate / 3, mate % 3 + 2)) < 0;
  }

  // A convex corner, and not one in the middle of a flat place.
  bool is_pointed(uint32_t v) const {
    std::vector<uint32_t> star;
    uint32_t h = half_of_[v];
    do {
      star.push_back(h / 3);
      h = next_half(mates_[h]);
    } while (h != half_of_[v]);
    bool is_flat = true;
    for (const uint32_t f : star) {
      for (const uint32_t g : star) {
        for (const uint32_t w : surface_.faces[g]) {
          const int above = side(f, surface_.vertices[w]);
          if (above > 0) return false;
          is_flat = is_flat && above == 0;
        }
      }
    }
    return !is_flat;
  }

  const Surface& surface_;
  const std::vector<uint32_t>& mates_;
  std::vector<uint32_t> half_of_;  // of each vertex, one that leaves it
};

}  // namespace

void refuse_touches(const Surface& surface, CheckReport& report) {
  const std::vector<uint32_t> mates = Edges(surface.faces).mates();
  const NearFaces near_faces(surface);
  Touches touches(surface, mates);
  NearSheets sheets(surface, near_faces, mates);
  std::vector<uint32_t> near;
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    near_faces.within(f, sheets.unresolved_m(), near);
    sheets.look_at(f, near);
    near_faces.keep_above(f, near);
    touches.look_at(f, near);
  }
  const size_t corners = touches.corners.size(), edges = touches.edges.size();
  if (!touches.faces.empty()) {
    report.refused.push_back(
        "has " + counted(touches.faces.size(), "face", "faces") +
        " on another face with the same corners, first " +
        named_face(surface, *touches.faces.begin()) +
        ": the sign is ambiguous there; unite the parts in a modelling program");
  }
  if (corners + edges == 0) {
    if (touches.faces.empty()) sheets.refuse(report);
    return;
  }
  const auto edge = touches.edges.cbegin();
  const std::string first = corners != 0
                                ? named_vertex(surface, touches.corners.cbegin()->first)
                                : named_edge(surface, edge->first.first, edge->first.second);
  const uint32_t on = corners != 0 ? touches.corners.cbegin()->second : edge->second;
  report.refused.push_back(
      "has " + counted(corners, "vertex", "vertices") + " and " + counted(edges, "edge", "edges") +
      " that touch a face or an edge elsewhere, first " + first + " on " + named_face(surface, on) +
      ": the sign is ambiguous there; unite or part the sheets in a modelling "
      "program");
}

}  // namespace firmtouch::tools
