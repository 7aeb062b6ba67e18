#include <algorithm>

#include "surface/check/mending.hpp"

namespace firmtouch::tools {
namespace {

// Boundary loops: open edges that hang together.
uint32_t count_loops(const Surface& surface, const Edges& edges) {
  Sets sets(surface.vertices.size());
  std::vector<bool> on_boundary(surface.vertices.size(), false);
  for (const Edges::Edge& edge : edges.all()) {
    if (edge.count != 1) continue;
    sets.join(edge.low, edge.high);
    on_boundary[edge.low] = on_boundary[edge.high] = true;
  }
  uint32_t loops = 0;
  for (uint32_t v = 0; v < on_boundary.size(); ++v) {
    if (on_boundary[v] && sets.find(v) == v) ++loops;
  }
  return loops;
}

void find_open_edges(const Surface& surface, const Edges& edges,
                     std::vector<std::string>& defects) {
  const uint32_t open = edges.open_count();
  if (open == 0) return;
  const auto first = std::find_if(edges.all().begin(), edges.all().end(),
                                  [](const auto& e) { return e.count == 1; });
  defects.push_back("has " + counted(open, "open edge", "open edges") + " around " +
                    counted(count_loops(surface, edges), "hole", "holes") + ", first " +
                    named_edge(surface, first->low, first->high) + " of face " +
                    std::to_string(surface.source[first->half[0] / 3]) +
                    ": close them in a modelling program, or with --close-holes");
}

void find_crowded_edges(const Surface& surface, const Edges& edges,
                        std::vector<std::string>& defects) {
  const uint32_t crowded = edges.crowded_count();
  if (crowded == 0) return;
  const auto first = std::find_if(edges.all().begin(), edges.all().end(),
                                  [](const auto& e) { return e.count > 2; });
  std::string faces;
  for (uint32_t k = 0; k < first->count && k < 4; ++k) {
    faces += (k == 0 ? "" : ", ") + std::to_string(surface.source[first->half[k] / 3]);
  }
  defects.push_back("has " +
                    counted(crowded, "edge that more than two faces share",
                            "edges that more than two faces share") +
                    " (non-manifold), first " + named_edge(surface, first->low, first->high) +
                    " of " + std::to_string(first->count) + " faces (" + faces +
                    (first->count > 4 ? ", ..." : "") +
                    "): separate the sheets or delete inner faces in a modelling program");
}

// Vertices where more than one fan of faces meets; those on an edge of more than two faces are
// reported with that edge.
void find_pinched_vertices(const Surface& surface, const Edges& edges,
                           std::vector<std::string>& defects) {
  Sets fans = corner_fans(surface.faces, edges.mates());
  std::vector<bool> skipped(surface.vertices.size(), false);
  for (const Edges::Edge& edge : edges.all()) {
    if (edge.count > 2) skipped[edge.low] = skipped[edge.high] = true;
  }
  std::vector<uint32_t> fan_count(surface.vertices.size(), 0);
  for (uint32_t c = 0; c < surface.faces.size() * 3; ++c) {
    if (fans.find(c) == c) ++fan_count[start_of(surface.faces, c)];
  }
  uint32_t pinched = 0, first = 0;
  for (uint32_t v = 0; v < fan_count.size(); ++v) {
    if (fan_count[v] < 2 || skipped[v]) continue;
    if (pinched++ == 0) first = v;
  }
  if (pinched == 0) return;
  defects.push_back("has " + counted(pinched, "vertex", "vertices") +
                    " where separate sheets touch (non-manifold), first " +
                    named_vertex(surface, first) + " of " + std::to_string(fan_count[first]) +
                    " sheets: give each sheet its own vertex in a modelling program");
}

}  // namespace

void find_topology_defects(const Surface& surface, std::vector<std::string>& defects) {
  const Edges edges(surface.faces);
  find_open_edges(surface, edges, defects);
  find_crowded_edges(surface, edges, defects);
  find_pinched_vertices(surface, edges, defects);
}

}  // namespace firmtouch::tools
