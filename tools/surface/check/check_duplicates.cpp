#include <algorithm>

#include "surface/check/mending.hpp"

namespace firmtouch::tools {
namespace {

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
