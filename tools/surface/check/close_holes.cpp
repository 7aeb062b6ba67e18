#include "surface/check/close_holes.hpp"

#include <algorithm>

#include "surface/check/hole_cap.hpp"
#include "surface/check/mending.hpp"
#include "surface/crossings.hpp"
#include "surface/edges.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

using Pairs = std::vector<std::pair<uint32_t, uint32_t>>;

// The loops of open edges. A border that meets itself at a vertex is parted there, so that each
// hole's vertices differ. Result: false where the open edges do not close up to loops.
bool find_holes(const Surface& surface, const Edges& edges, std::vector<Hole>& holes) {
  // A cap winds against the open half-edges: from the end of each to its start.
  std::vector<std::vector<uint32_t>> leaving(surface.vertices.size());
  for (const Edges::Edge& edge : edges.all()) {
    if (edge.count == 1) leaving[end_of(surface.faces, edge.half[0])].push_back(edge.half[0]);
  }
  constexpr uint32_t kOffPath = kNone;
  std::vector<uint32_t> on_path(surface.vertices.size(), kOffPath);
  for (uint32_t first = 0; first < leaving.size(); ++first) {
    std::vector<uint32_t> path;  // half-edges
    for (uint32_t v = first; !leaving[v].empty() || !path.empty();) {
      if (on_path[v] != kOffPath) {  // a loop is complete: off the path with it
        Hole hole;
        for (size_t k = on_path[v]; k < path.size(); ++k) {
          const uint32_t h = path[k];
          hole.border.push_back(end_of(surface.faces, h));
          hole.beyond.push_back(start_of(surface.faces, next_half(next_half(h))));
          on_path[hole.border.back()] = kOffPath;
        }
        path.resize(path.size() - hole.border.size());
        holes.push_back(hole);
        continue;
      }
      if (leaving[v].empty()) return false;
      on_path[v] = static_cast<uint32_t>(path.size());
      path.push_back(leaving[v].back());
      leaving[v].pop_back();
      v = start_of(surface.faces, path.back());
    }
  }
  return true;
}

std::string place_of(const Surface& surface, const Hole& hole) {
  Point low = to_point(surface.vertices[hole.border[0]]), high = low;
  for (const uint32_t v : hole.border) {
    const Point p = to_point(surface.vertices[v]);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Point centre = (low + high) * 0.5;
  return "a hole of " + std::to_string(hole.border.size()) + " edges about" +
         surface.frame.place_text(centre) + ", " + surface.frame.length_text(length(high - low)) +
         " across";
}

// Edges between two vertices of one hole's border or another's; caps must not make them again.
Pairs taken_edges(const Surface& surface, const Edges& edges, const std::vector<Hole>& holes) {
  std::vector<bool> on_border(surface.vertices.size(), false);
  for (const Hole& hole : holes) {
    for (const uint32_t v : hole.border) on_border[v] = true;
  }
  Pairs taken;
  for (const Edges::Edge& edge : edges.all()) {
    if (on_border[edge.low] && on_border[edge.high]) taken.push_back({edge.low, edge.high});
  }
  return taken;  // sorted, as Edges are
}

void add_edges(const std::vector<Face>& cap, Pairs& taken) {
  for (const Face& face : cap) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t a = face[k], b = face[(k + 1) % 3];
      taken.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(taken.begin(), taken.end());
  taken.erase(std::unique(taken.begin(), taken.end()), taken.end());
}

// Which hole each added face caps.
struct Closed {
  Surface surface;
  std::vector<size_t> hole_of;  // of the faces behind the surface's own
};

Closed with_caps(const Surface& surface, const std::vector<std::vector<Face>>& caps,
                 uint32_t first_source) {
  Closed closed{surface, {}};
  for (size_t h = 0; h < caps.size(); ++h) {
    for (const Face& face : caps[h]) {
      closed.surface.source.push_back(first_source + static_cast<uint32_t>(closed.hole_of.size()));
      closed.surface.faces.push_back(face);
      closed.hole_of.push_back(h);
    }
  }
  return closed;
}

// Of each hole: whether its cap passes through another face.
std::vector<bool> caps_that_cross(const Closed& closed, size_t own_faces, size_t holes) {
  std::vector<bool> crosses(holes, false);
  if (Edges(closed.surface.faces).open_count() != 0) return crosses;
  for (const auto& [f, g] : find_crossings(closed.surface).pairs) {
    for (const uint32_t face : {f, g}) {
      if (face >= own_faces) crosses[closed.hole_of[face - own_faces]] = true;
    }
  }
  return crosses;
}

std::vector<std::vector<Face>> make_caps(const Surface& surface, const std::vector<Hole>& holes,
                                         const Pairs& edges, const std::vector<CapRule>& rules) {
  std::vector<std::vector<Face>> caps;
  Pairs taken = edges;
  for (size_t h = 0; h < holes.size(); ++h) {
    caps.push_back(cap_of(surface, holes[h], taken, rules[h]));
    add_edges(caps.back(), taken);
  }
  return caps;
}

bool refuse_uncapped(const Surface& surface, const std::vector<Hole>& holes,
                     const std::vector<std::vector<Face>>& caps, CheckReport& report) {
  const char* remedy = ": close it in a modelling program";
  for (size_t h = 0; h < holes.size(); ++h) {
    const std::string place = "has " + place_of(surface, holes[h]);
    if (holes[h].border.size() > kMaxHoleEdges) {
      report.refused.push_back(place + ", more than the " + std::to_string(kMaxHoleEdges) +
                               " that --close-holes takes on" + remedy);
    } else if (caps[h].empty()) {
      report.refused.push_back(place +
                               " that no sheet of triangles between its vertices closes "
                               "without folding back" +
                               remedy);
    }
  }
  return report.usable();
}

}  // namespace

void close_holes(Surface& surface, uint32_t first_source, CheckReport& report) {
  const Edges edges(surface.faces);
  if (edges.open_count() == 0) return;
  std::vector<Hole> holes;
  if (!find_holes(surface, edges, holes)) {
    report.refused.push_back(
        "has open edges that form no closed borders, so that --close-holes "
        "cannot close them: mend it in a modelling program");
    return;
  }
  // Small holes first: what they take, a large one can leave.
  std::stable_sort(holes.begin(), holes.end(),
                   [](const Hole& a, const Hole& b) { return a.border.size() < b.border.size(); });
  const Pairs taken = taken_edges(surface, edges, holes);
  std::vector<CapRule> rules(holes.size(), CapRule::kMinBend);
  std::vector<std::vector<Face>> caps;
  for (const Hole& hole : holes)
    if (hole.border.size() > kMaxHoleEdges) caps.resize(holes.size());
  if (caps.empty()) caps = make_caps(surface, holes, taken, rules);
  if (!refuse_uncapped(surface, holes, caps, report)) return;

  Closed closed = with_caps(surface, caps, first_source);
  std::vector<bool> crosses = caps_that_cross(closed, surface.faces.size(), holes.size());
  if (std::find(crosses.begin(), crosses.end(), true) != crosses.end()) {
    for (size_t h = 0; h < holes.size(); ++h)
      if (crosses[h]) rules[h] = CapRule::kMinArea;
    caps = make_caps(surface, holes, taken, rules);
    if (!refuse_uncapped(surface, holes, caps, report)) return;
    closed = with_caps(surface, caps, first_source);
    crosses = caps_that_cross(closed, surface.faces.size(), holes.size());
    for (size_t h = 0; h < holes.size(); ++h) {
      if (crosses[h])
        report.refused.push_back("has " + place_of(surface, holes[h]) +
                                 " whose cap would pass through the surface: close it in a "
                                 "modelling program");
    }
    if (!report.usable()) return;
  }
  report.mended.push_back("closed " + counted(holes.size(), "hole", "holes") + " with " +
                          counted(closed.hole_of.size(), "triangle", "triangles") +
                          ", numbered from " + std::to_string(first_source) + " on");
  constexpr size_t kShown = 20;
  for (size_t h = 0; h < holes.size() && h < kShown; ++h)
    report.mended.push_back("closed " + place_of(surface, holes[h]));
  if (holes.size() > kShown)
    report.mended.push_back("closed " + std::to_string(holes.size() - kShown) + " holes more");
  surface = std::move(closed.surface);
}

}  // namespace firmtouch::tools
