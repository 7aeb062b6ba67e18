#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/check/mending.hpp"
#include "surface/point.hpp"

// Where more than two faces share an edge, or several fans a vertex, the sheets are parted: around
// an edge the faces that enclose the same wedge of solid belong together.
// Source: Gueziec, Taubin, Lazarus, Horn 1998, "Converting sets of polygons to manifold surfaces by
//         cutting and stitching".

namespace firmtouch::tools {
namespace {

constexpr double kApart = 1e-5;        // of the surface's reach: how far parted sheets move
constexpr double kApartOfEdge = 0.05;  // at most, of the shortest edge there

struct Spoke {
  double angle;  // of its face about the edge, from the lower vertex to the higher one
  uint32_t half;
  bool is_forward;  // runs from the lower vertex to the higher one: solid before it, not behind
};

std::vector<Spoke> spokes_of(const Surface& surface, const Edges::Edge& edge) {
  const Point low = to_point(surface.vertices[edge.low]);
  const Point along = to_point(surface.vertices[edge.high]) - low;
  const Point axis = along * (1 / std::max(length(along), 1e-300));
  Point aside =
      cross(axis, std::fabs(axis.x) <= std::fabs(axis.y) ? Point{1, 0, 0} : Point{0, 1, 0});
  aside = aside * (1 / std::max(length(aside), 1e-300));
  const Point up = cross(axis, aside);
  std::vector<Spoke> spokes;
  for (uint32_t k = 0; k < edge.count; ++k) {
    const uint32_t h = edge.half[k];
    const uint32_t apex = start_of(surface.faces, next_half(next_half(h)));
    const Point p = to_point(surface.vertices[apex]) - low;
    spokes.push_back(
        {std::atan2(dot(p, up), dot(p, aside)), h, start_of(surface.faces, h) == edge.low});
  }
  std::stable_sort(spokes.begin(), spokes.end(),
                   [](const Spoke& a, const Spoke& b) { return a.angle < b.angle; });
  return spokes;
}

// As brackets, around the edge: a face with solid behind it, then one with solid before it.
void pair_spokes(const std::vector<Spoke>& spokes, std::vector<uint32_t>& mates) {
  std::vector<uint32_t> open;
  for (size_t k = 0; k < 2 * spokes.size(); ++k) {
    const Spoke& spoke = spokes[k % spokes.size()];
    if (mates[spoke.half] != kNone) continue;
    if (!spoke.is_forward) {
      if (k < spokes.size()) open.push_back(spoke.half);
    } else if (!open.empty()) {
      mates[spoke.half] = open.back();
      mates[open.back()] = spoke.half;
      open.pop_back();
    }
  }
}

// Moves the vertices of parted sheets into their solids, so that the sheets touch no more.
void move_apart(Surface& surface, const std::vector<bool>& moves) {
  std::vector<Point> normal(surface.vertices.size());
  std::vector<double> shortest_m(surface.vertices.size(), std::numeric_limits<double>::max());
  double reach_m = 0;
  for (const Face& face : surface.faces) {
    const Point a = to_point(surface.vertices[face[0]]), b = to_point(surface.vertices[face[1]]),
                c = to_point(surface.vertices[face[2]]);
    const Point of_face = cross(b - a, c - a);
    const double edge_m = std::min({length(b - a), length(c - b), length(a - c)});
    reach_m = std::max(reach_m, length(b - to_point(surface.vertices[surface.faces[0][0]])));
    for (const uint32_t v : face) {
      normal[v] = normal[v] + of_face;
      shortest_m[v] = std::min(shortest_m[v], edge_m);
    }
  }
  for (uint32_t v = 0; v < moves.size(); ++v) {
    const double size = length(normal[v]);
    if (!moves[v] || !(size > 0)) continue;
    const double by_m = std::min(kApart * reach_m, kApartOfEdge * shortest_m[v]);
    surface.vertices[v] = to_vec3(to_point(surface.vertices[v]) - normal[v] * (by_m / size));
  }
}

}  // namespace

void split_sheets(Surface& surface, CheckReport& report) {
  const Edges edges(surface.faces);
  std::vector<uint32_t> mates = edges.mates();
  for (const Edges::Edge& edge : edges.all())
    if (edge.count > 2) pair_spokes(spokes_of(surface, edge), mates);
  Sets fans = corner_fans(surface.faces, mates);
  std::vector<uint32_t> owner(surface.vertices.size(), kNone), vertex_of(surface.faces.size() * 3);
  std::vector<uint32_t> of_corner;  // the vertex as it was
  for (uint32_t c = 0; c < vertex_of.size(); ++c) of_corner.push_back(start_of(surface.faces, c));
  uint32_t split = 0, added = 0, first = kNone;
  std::vector<bool> is_split(surface.vertices.size(), false);
  for (uint32_t c = 0; c < vertex_of.size(); ++c) {
    const uint32_t v = start_of(surface.faces, c), fan = fans.find(c);
    if (fan != c) {
      vertex_of[c] = vertex_of[fan];  // a fan is named by its lowest corner
      continue;
    }
    vertex_of[c] = v;
    if (owner[v] == kNone) {
      owner[v] = fan;
      continue;
    }
    if (!is_split[v]) ++split;
    is_split[v] = true;
    first = std::min(first, v);
    vertex_of[c] = static_cast<uint32_t>(surface.vertices.size());
    const math::Vec3 twin = surface.vertices[v];
    surface.vertices.push_back(twin);
    ++added;
  }
  if (added == 0) return;
  report.mended.push_back("gave separate sheets vertices of their own at " +
                          counted(split, "vertex", "vertices") + ", first " +
                          named_vertex(surface, first) + ": " + std::to_string(added) +
                          " added, each moved into its solid by at most 1e-5 of the size");
  for (uint32_t c = 0; c < vertex_of.size(); ++c) surface.faces[c / 3][c % 3] = vertex_of[c];
  is_split.resize(surface.vertices.size(), false);
  for (uint32_t c = 0; c < vertex_of.size(); ++c)
    if (is_split[of_corner[c]]) is_split[vertex_of[c]] = true;
  move_apart(surface, is_split);
}

}  // namespace firmtouch::tools
