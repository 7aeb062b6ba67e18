#include <algorithm>
#include <array>
#include <cstring>

#include "surface/mending.hpp"

namespace firmtouch::tools {
namespace {

using PositionKey = std::array<uint32_t, 3>;

// Equal positions have equal keys: -0 becomes +0.
PositionKey key_of(const math::Vec3& v) {
  const float coordinates[3] = {v.x + 0.0f, v.y + 0.0f, v.z + 0.0f};
  PositionKey key{};
  std::memcpy(key.data(), coordinates, sizeof key);
  return key;
}

// Of each vertex: the lowest vertex on the border of the surface at the same place; other vertices
// stand for themselves.
std::vector<uint32_t> border_twins(const Surface& surface, const Edges& edges) {
  std::vector<bool> on_border(surface.vertices.size(), false);
  for (const Edges::Edge& edge : edges.all()) {
    if (edge.count == 1) on_border[edge.low] = on_border[edge.high] = true;
  }
  std::vector<std::pair<PositionKey, uint32_t>> order;
  std::vector<uint32_t> twin(surface.vertices.size());
  for (uint32_t v = 0; v < twin.size(); ++v) {
    twin[v] = v;
    if (on_border[v]) order.push_back({key_of(surface.vertices[v]), v});
  }
  std::sort(order.begin(), order.end());
  for (size_t i = 1; i < order.size(); ++i) {
    if (order[i].first == order[i - 1].first) twin[order[i].second] = twin[order[i - 1].second];
  }
  return twin;
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

bool same_way_round(const Face& a, const Face& b) {
  for (uint32_t k = 0; k < 3; ++k) {
    if (a[0] == b[k]) return a[1] == b[(k + 1) % 3];
  }
  return false;
}

}  // namespace

void drop_pointlike_faces(Surface& surface, CheckReport& report) {
  std::vector<bool> dropped(surface.faces.size(), false);
  uint32_t count = 0, first = 0;
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    const Face& face = surface.faces[f];
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) continue;
    dropped[f] = true;  // its two sides are one edge: the neighbours close up over it
    if (count++ == 0) first = f;
  }
  if (count == 0) return;
  report.mended.push_back("dropped " + counted(count, "face that names", "faces that name") +
                          " a vertex twice, first " + named_face(surface, first));
  drop_faces(surface, dropped);
}

void weld_torn_vertices(Surface& surface, CheckReport& report) {
  const Edges edges(surface.faces);
  const uint32_t open = edges.open_count();
  if (open == 0) return;
  const std::vector<uint32_t> twin = border_twins(surface, edges);
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

void drop_duplicate_faces(Surface& surface, CheckReport& report) {
  std::vector<std::pair<Face, uint32_t>> order(surface.faces.size());
  for (uint32_t f = 0; f < order.size(); ++f) {
    order[f] = {surface.faces[f], f};
    std::sort(order[f].first.begin(), order[f].first.end());
  }
  std::sort(order.begin(), order.end());
  bool any = false;
  for (size_t i = 1; i < order.size(); ++i) any = any || order[i].first == order[i - 1].first;
  if (!any) return;

  std::vector<uint32_t> uses(surface.faces.size() * 3,
                             0);  // of each half-edge: the half-edges of its edge
  const Edges edges(surface.faces);
  for (const Edges::Edge& edge : edges.all()) {
    for (uint32_t k = 0; k < edge.count; ++k) uses[edge.half[k]] = edge.count;
  }
  std::vector<bool> dropped(surface.faces.size(), false);
  uint32_t count = 0, first = kNone;
  for (size_t i = 0, end = 0; i < order.size(); i = end) {
    for (end = i + 1; end < order.size() && order[end].first == order[i].first;) ++end;
    const uint32_t copies = static_cast<uint32_t>(end - i), f = order[i].second;
    if (copies == 1) continue;
    // One stays, unless two sheets back to back hang from a surface that closes without them.
    bool is_fin = !same_way_round(surface.faces[f], surface.faces[order[i + 1].second]);
    for (uint32_t k = 0; k < 3; ++k) is_fin = is_fin && uses[3 * f + k] == copies + 2;
    for (size_t j = is_fin ? i : i + 1; j < end; ++j) {
      dropped[order[j].second] = true;
      ++count;
      first = std::min(first, order[j].second);
    }
  }
  report.mended.push_back("dropped " +
                          counted(count, "face that repeats another", "faces that repeat others") +
                          ", first " + named_face(surface, first));
  drop_faces(surface, dropped);
}

}  // namespace firmtouch::tools
