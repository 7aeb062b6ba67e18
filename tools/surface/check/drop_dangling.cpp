#include <algorithm>
#include <cstdio>

#include "surface/check/mending.hpp"
#include "surface/point.hpp"

// Patches are what edges of more than two faces part. One with a free border is a fin; one without
// that ends on such edges alone is a wall inside a solid. Both go where that mends the edges.

namespace firmtouch::tools {
namespace {

constexpr double kMaxShare = 0.1;  // of the area: beyond it the model would be another one
constexpr uint32_t kMaxRounds = 32;

struct Patch {
  double area = 0;
  bool is_open = false;     // has an edge of one face
  bool is_crowded = false;  // has an edge of more than two
  bool has_odd = false;     // of these, one with an odd number
};

double area_of(const Surface& surface, const Face& face) {
  const Point a = to_point(surface.vertices[face[0]]);
  return length(cross(to_point(surface.vertices[face[1]]) - a,
                      to_point(surface.vertices[face[2]]) - a)) /
         2;
}

// Marks patches to drop: the smaller ones first, no two at one edge. Result: their area.
double mark_patches(const Surface& surface, double most, std::vector<bool>& dropped) {
  const Edges edges(surface.faces);
  const uint32_t count = static_cast<uint32_t>(surface.faces.size());
  Sets sets(count);
  for (const Edges::Edge& edge : edges.all())
    if (edge.count == 2) sets.join(edge.half[0] / 3, edge.half[1] / 3);
  std::vector<Patch> patches(count);
  double total = 0;
  for (uint32_t f = 0; f < count; ++f) {
    const double area = area_of(surface, surface.faces[f]);
    patches[sets.find(f)].area += area;
    total += area;
  }
  std::vector<std::pair<uint32_t, uint32_t>> at_edge;  // patch, number of its crowded edge
  for (uint32_t e = 0; e < edges.all().size(); ++e) {
    const Edges::Edge& edge = edges.all()[e];
    for (uint32_t k = 0; k < edge.count && edge.count != 2; ++k) {
      const uint32_t p = sets.find(edge.half[k] / 3);
      patches[p].is_open = patches[p].is_open || edge.count == 1;
      if (edge.count == 1) continue;
      patches[p].is_crowded = true;
      patches[p].has_odd = patches[p].has_odd || edge.count % 2 == 1;
      at_edge.push_back({p, e});
    }
  }
  std::sort(at_edge.begin(), at_edge.end());
  std::vector<uint32_t> order;
  for (uint32_t p = 0; p < count; ++p) {
    const Patch& patch = patches[p];
    if (patch.is_crowded && (patch.is_open || patch.has_odd) && patch.area < total / 2)
      order.push_back(p);
  }
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    if (patches[a].is_open != patches[b].is_open) return patches[a].is_open;
    return patches[a].area < patches[b].area;
  });
  std::vector<bool> is_used(edges.all().size(), false), chosen(count, false);
  double area = 0;
  for (const uint32_t p : order) {
    const auto begin = std::lower_bound(at_edge.begin(), at_edge.end(), std::make_pair(p, 0u));
    auto end = begin;
    bool is_free = area + patches[p].area <= most;
    for (; end != at_edge.end() && end->first == p; ++end)
      is_free = is_free && !is_used[end->second];
    if (!is_free) continue;
    for (auto i = begin; i != end; ++i) is_used[i->second] = true;
    chosen[p] = true;
    area += patches[p].area;
  }
  dropped.assign(count, false);
  for (uint32_t f = 0; f < count; ++f) dropped[f] = chosen[sets.find(f)];
  return area;
}

}  // namespace

void drop_dangling_faces(Surface& surface, CheckReport& report) {
  double total = 0, gone = 0;
  for (const Face& face : surface.faces) total += area_of(surface, face);
  uint32_t count = 0;
  std::string first;
  for (uint32_t round = 0; round < kMaxRounds; ++round) {
    std::vector<bool> dropped;
    gone += mark_patches(surface, kMaxShare * total - gone, dropped);
    const auto begin = std::find(dropped.begin(), dropped.end(), true);
    if (begin == dropped.end()) break;
    if (count == 0) first = named_face(surface, static_cast<uint32_t>(begin - dropped.begin()));
    count += static_cast<uint32_t>(std::count(dropped.begin(), dropped.end(), true));
    drop_faces(surface, dropped);
  }
  if (count == 0) return;
  char share[40];
  std::snprintf(share, sizeof share, "%.2g", 100 * gone / total);
  report.mended.push_back("removed " + counted(count, "face", "faces") +
                          " of dangling sheets and inner walls (" + share +
                          " % of the area), first " + first);
}

}  // namespace firmtouch::tools
