#include "surface/read/weld.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "surface/check/mending.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

constexpr uint32_t kMaxNeighbours = 64;  // looked at in one column: welding stays linear
constexpr double kMaxOfEdge = 0.25;      // of the mean open edge: details are not welded away

using PositionKey = std::array<uint32_t, 3>;

// Equal positions have equal keys: -0 becomes +0.
PositionKey key_of(const math::Vec3& v) {
  const float coordinates[3] = {v.x + 0.0f, v.y + 0.0f, v.z + 0.0f};
  PositionKey key{};
  std::memcpy(key.data(), coordinates, sizeof key);
  return key;
}

// Of each vertex that is `chosen`: the lowest of them at the same place; others stand for
// themselves.
std::vector<uint32_t> twins_of(const Surface& surface, const std::vector<bool>& chosen) {
  std::vector<std::pair<PositionKey, uint32_t>> order;
  std::vector<uint32_t> twin(surface.vertices.size());
  for (uint32_t v = 0; v < twin.size(); ++v) {
    twin[v] = v;
    if (chosen[v]) order.push_back({key_of(surface.vertices[v]), v});
  }
  std::sort(order.begin(), order.end());
  for (size_t i = 1; i < order.size(); ++i) {
    if (order[i].first == order[i - 1].first) twin[order[i].second] = twin[order[i - 1].second];
  }
  return twin;
}

std::vector<bool> on_border(const Surface& surface, const Edges& edges) {
  std::vector<bool> chosen(surface.vertices.size(), false);
  for (const Edges::Edge& edge : edges.all()) {
    if (edge.count == 1) chosen[edge.low] = chosen[edge.high] = true;
  }
  return chosen;
}

// Where two bodies only touch at a welded vertex, each gets a vertex of its own again: one of the
// group's own.
void part_touching_fans(std::vector<Face>& faces, const std::vector<uint32_t>& twin) {
  const Edges edges(faces);
  std::vector<bool> parted(twin.size(), false);
  std::vector<std::vector<uint32_t>> group(twin.size());
  for (uint32_t v = 0; v < twin.size(); ++v) {
    if (twin[v] != v) parted[twin[v]] = true;
  }
  for (uint32_t v = 0; v < twin.size(); ++v) {
    if (parted[twin[v]]) group[twin[v]].push_back(v);
  }
  for (const Edges::Edge& edge : edges.all()) {
    if (edge.count > 2) parted[edge.low] = parted[edge.high] = false;  // its faces are no fans
  }
  Sets fans = corner_fans(faces, edges.mates());
  std::vector<uint32_t> seen(twin.size(), 0), number(faces.size() * 3, 0);
  for (uint32_t c = 0; c < faces.size() * 3; ++c) {
    const uint32_t v = start_of(faces, c);
    if (parted[v] && fans.find(c) == c) number[c] = seen[v]++;
  }
  for (uint32_t c = 0; c < faces.size() * 3; ++c) number[c] = number[fans.find(c)];
  for (uint32_t c = 0; c < faces.size() * 3; ++c) {
    uint32_t& v = faces[c / 3][c % 3];
    if (!parted[v] || number[c] == 0) continue;
    v = group[v][std::min<size_t>(number[c], group[v].size() - 1)];
  }
}

bool is_pointlike(const Face& face) {
  return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
}

// Vertices that no face uses go; the others keep their order.
void compact(Surface& surface) {
  std::vector<uint32_t> to(surface.vertices.size(), kNone);
  for (const Face& face : surface.faces) {
    for (const uint32_t v : face) to[v] = v;
  }
  uint32_t left = 0;
  for (uint32_t v = 0; v < to.size(); ++v) {
    if (to[v] == kNone) continue;
    surface.vertices[left] = surface.vertices[v];
    to[v] = left++;
  }
  surface.vertices.resize(left);
  for (Face& face : surface.faces) {
    for (uint32_t& v : face) v = to[v];
  }
}

}  // namespace

void weld_corners(Surface& surface) {
  const std::vector<uint32_t> twin =
      twins_of(surface, std::vector<bool>(surface.vertices.size(), true));
  std::vector<Face> solid;
  std::vector<size_t> place;
  for (size_t f = 0; f < surface.faces.size(); ++f) {
    for (uint32_t& v : surface.faces[f]) v = twin[v];
    if (is_pointlike(surface.faces[f])) continue;  // the check will drop it
    solid.push_back(surface.faces[f]);
    place.push_back(f);
  }
  part_touching_fans(solid, twin);
  for (size_t i = 0; i < place.size(); ++i) surface.faces[place[i]] = solid[i];
  compact(surface);
}

namespace {

// Of each vertex that is `chosen`: the lowest of those that hang together by steps of at most
// `reach_m`.
std::vector<uint32_t> near_twins_of(const Surface& surface, const std::vector<bool>& chosen,
                                    double reach_m) {
  using Cell = std::array<int64_t, 3>;
  const auto cell_of = [&](uint32_t v) {
    const math::Vec3 p = surface.vertices[v];
    return Cell{std::llround(static_cast<double>(p.x) / reach_m),
                std::llround(static_cast<double>(p.y) / reach_m),
                std::llround(static_cast<double>(p.z) / reach_m)};
  };
  std::vector<std::pair<Cell, uint32_t>> order;
  for (uint32_t v = 0; v < chosen.size(); ++v)
    if (chosen[v]) order.push_back({cell_of(v), v});
  std::sort(order.begin(), order.end());
  Sets sets(chosen.size());
  for (const auto& [cell, v] : order) {
    // Cells of one column are neighbours in the order: nine columns around each vertex.
    for (int64_t k = 0; k < 9; ++k) {
      const Cell from{cell[0] + k / 3 - 1, cell[1] + k % 3 - 1, cell[2] - 1};
      auto other = std::lower_bound(order.begin(), order.end(), std::make_pair(from, 0u));
      for (uint32_t looked = 0; other != order.end() && looked < kMaxNeighbours;
           ++other, ++looked) {
        const Cell& at = other->first;
        if (at[0] != from[0] || at[1] != from[1] || at[2] > from[2] + 2) break;
        const Point apart =
            to_point(surface.vertices[v]) - to_point(surface.vertices[other->second]);
        if (length(apart) <= reach_m) sets.join(v, other->second);
      }
    }
  }
  std::vector<uint32_t> twin(chosen.size());
  for (uint32_t v = 0; v < twin.size(); ++v) twin[v] = sets.find(v);
  return twin;
}

double mean_open_edge_m(const Surface& surface, const Edges& edges) {
  double sum = 0;
  uint32_t count = 0;
  for (const Edges::Edge& edge : edges.all()) {
    if (edge.count != 1) continue;
    sum += length(to_point(surface.vertices[edge.low]) - to_point(surface.vertices[edge.high]));
    ++count;
  }
  return sum / std::max(count, 1u);
}

}  // namespace

void weld_near_vertices(Surface& surface, CheckReport& report) {
  const Edges edges(surface.faces);
  const uint32_t open = edges.open_count();
  if (open == 0) return;
  Point low = to_point(surface.vertices[0]), high = low;
  for (const math::Vec3& v : surface.vertices) {
    const Point p = to_point(v);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double diagonal_m = length(high - low), edge_m = mean_open_edge_m(surface, edges);
  const std::vector<bool> border = on_border(surface, edges);
  Surface best;
  CheckReport best_report;
  uint32_t best_open = open;
  for (const double share : {1e-6, 1e-5, 1e-4, 1e-3}) {
    const double reach_m = share * diagonal_m;
    if (!(reach_m > 0 && reach_m < kMaxOfEdge * edge_m) || best_open == 0) break;
    const std::vector<uint32_t> twin = near_twins_of(surface, border, reach_m);
    Surface welded = surface;
    uint32_t count = 0;
    for (Face& face : welded.faces)
      for (uint32_t& v : face) v = twin[v];
    for (uint32_t v = 0; v < twin.size(); ++v) count += twin[v] != v ? 1u : 0u;
    CheckReport after = report;
    drop_pointlike_faces(welded, after);
    if (welded.faces.empty()) break;
    const uint32_t left = Edges(welded.faces).open_count();
    if (left >= best_open) continue;
    after.mended.push_back("welded " + counted(count, "vertex", "vertices") + " to others within " +
                           surface.frame.length_text(reach_m) + ": that closed " +
                           std::to_string(open - left) + " of " +
                           counted(open, "open edge", "open edges"));
    best_open = left;
    best = std::move(welded);
    best_report = std::move(after);
  }
  if (best_open == open) return;
  surface = std::move(best);
  report = std::move(best_report);
}

void weld_torn_vertices(Surface& surface, CheckReport& report) {
  const Edges edges(surface.faces);
  const uint32_t open = edges.open_count();
  if (open == 0) return;
  const std::vector<uint32_t> twin = twins_of(surface, on_border(surface, edges));
  Surface welded = surface;
  for (Face& face : welded.faces) {
    for (uint32_t& v : face) v = twin[v];
  }
  CheckReport after = report;
  drop_pointlike_faces(welded, after);
  part_touching_fans(welded.faces, twin);
  const uint32_t left = Edges(welded.faces).open_count();
  if (left >= open) return;

  uint32_t count = 0, first = 0;
  for (uint32_t v = 0; v < twin.size(); ++v) {
    if (twin[v] != v && count++ == 0) first = v;
  }
  report = std::move(after);
  report.mended.push_back("welded " + counted(count, "vertex", "vertices") +
                          " to others at the same place, first " + named_vertex(surface, first) +
                          " to vertex " + std::to_string(twin[first]) + ": that closed " +
                          std::to_string(open - left) + " of " +
                          counted(open, "open edge", "open edges"));
  surface = std::move(welded);
}

}  // namespace firmtouch::tools
