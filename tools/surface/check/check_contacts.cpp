#include <algorithm>
#include <array>

#include "surface/box_tree.hpp"
#include "surface/check/mending.hpp"
#include "surface/point.hpp"
#include "surface/winding_number.hpp"

// Where bodies touch, one nearest point belongs to both, and each gives its own sign. That
// does no harm where convex corners meet: nothing inside a body is nearest to such a corner. Faces
// on faces, and corners in pits, would give wrong signs at any depth.

namespace firmtouch::tools {
namespace {

constexpr double kLift = 1e-10;    // of the reach: far above rounding, far below a gap that counts
constexpr double kConvex = 1e-12;  // of the lengths: rounding of flat corners

Point at(const Surface& surface, uint32_t v) { return to_point(surface.vertices[v]); }

Box box_of(const Surface& surface, const Face& face) {
  const Point a = at(surface, face[0]), b = at(surface, face[1]), c = at(surface, face[2]);
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

// A sheet alone parts winding w from w - 1, also where it crosses another; two sheets on one
// another part other numbers.
bool lies_on_another(const Surface& surface, const WindingNumber& winding, const Face& face,
                     double lift_m) {
  const Point a = at(surface, face[0]), b = at(surface, face[1]), c = at(surface, face[2]);
  const Point normal = cross(b - a, c - a), middle = (a + b + c) * (1.0 / 3);
  const double size = length(normal);
  if (!(size > 0)) return false;
  const Point lift = normal * (lift_m / size);
  for (const Point& spot : {middle, (middle + a) * 0.5, (middle + b) * 0.5, (middle + c) * 0.5}) {
    if (winding.at(spot - lift) - winding.at(spot + lift) != 1) return true;
  }
  return false;
}

// Faces that lie on faces of another piece, also all but rounding; those of one piece are left to
// refuse_touches().
void refuse_faces_on_faces(const Surface& surface, CheckReport& report) {
  Sets pieces(surface.vertices.size());
  std::vector<Box> boxes;
  double reach_m = 0;
  for (const Face& face : surface.faces) {
    pieces.join(face[0], face[1]);
    pieces.join(face[0], face[2]);
    boxes.push_back(box_of(surface, face));
    for (const uint32_t v : face) reach_m = std::max(reach_m, length(at(surface, v)));
  }
  const auto piece_of = [&](uint32_t f) { return pieces.find(surface.faces[f][0]); };
  bool is_one = true;
  for (uint32_t f = 0; f < surface.faces.size(); ++f) is_one = is_one && piece_of(f) == piece_of(0);
  if (is_one) return;
  const BoxTree tree(boxes);
  const WindingNumber winding(surface, {});
  std::vector<uint32_t> near;
  uint32_t count = 0, first = 0;
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    near.clear();
    tree.overlaps(boxes[f], near);
    const auto is_other = [&](uint32_t g) { return piece_of(g) != piece_of(f); };
    if (!std::any_of(near.begin(), near.end(), is_other)) continue;
    if (!lies_on_another(surface, winding, surface.faces[f], kLift * reach_m)) continue;
    if (count++ == 0) first = f;
  }
  if (count == 0) return;
  report.refused.push_back(
      "has " + counted(count, "face", "faces") + " on the face of another piece, first " +
      named_face(surface, first) +
      ": the sign is ambiguous there; unite the pieces in a modelling program");
}

using Neighbours = std::vector<std::pair<uint32_t, uint32_t>>;  // vertex, one of its faces

bool is_convex(const Surface& surface, uint32_t v, Neighbours::const_iterator begin,
               Neighbours::const_iterator end) {
  const Point corner = at(surface, v);
  for (auto i = begin; i != end; ++i) {
    const Face& face = surface.faces[i->second];
    const Point a = at(surface, face[0]);
    const Point normal = cross(at(surface, face[1]) - a, at(surface, face[2]) - a);
    for (auto j = begin; j != end; ++j) {
      for (const uint32_t w : surface.faces[j->second]) {
        const Point along = at(surface, w) - corner;
        if (dot(normal, along) > kConvex * length(normal) * length(along)) return false;
      }
    }
  }
  return true;
}

void refuse_corners_in_pits(const Surface& surface, CheckReport& report) {
  // Vertices that welding left without a face touch nothing.
  std::vector<bool> is_used(surface.vertices.size(), false);
  for (const Face& face : surface.faces)
    for (const uint32_t v : face) is_used[v] = true;
  std::vector<std::pair<std::array<float, 3>, uint32_t>> order;
  for (uint32_t v = 0; v < surface.vertices.size(); ++v) {
    if (!is_used[v]) continue;
    const math::Vec3 p = surface.vertices[v];
    order.push_back({{p.x, p.y, p.z}, v});
  }
  std::sort(order.begin(), order.end());
  std::vector<bool> is_shared(surface.vertices.size(), false);
  bool any = false;
  for (size_t i = 1; i < order.size(); ++i) {
    if (order[i - 1].first < order[i].first) continue;
    any = is_shared[order[i - 1].second] = is_shared[order[i].second] = true;
  }
  if (!any) return;
  Neighbours around;
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    for (const uint32_t v : surface.faces[f]) {
      if (is_shared[v]) around.push_back({v, f});
    }
  }
  std::sort(around.begin(), around.end());
  uint32_t count = 0, first = 0;
  for (auto begin = around.cbegin(), end = begin; begin != around.cend(); begin = end) {
    while (end != around.cend() && end->first == begin->first) ++end;
    if (is_convex(surface, begin->first, begin, end)) continue;
    if (count++ == 0) first = begin->first;
  }
  if (count == 0) return;
  report.refused.push_back("has " + counted(count, "vertex", "vertices") +
                           " in a pit or a notch where another sheet touches, first " +
                           named_vertex(surface, first) +
                           ": the sign is ambiguous there; unite or part the sheets in a modelling "
                           "program");
}

}  // namespace

void refuse_contacts(const Surface& surface, CheckReport& report) {
  const size_t before = report.refused.size();
  refuse_faces_on_faces(surface, report);
  if (report.refused.size() == before) refuse_corners_in_pits(surface, report);
  if (report.refused.size() == before) refuse_touches(surface, report);
  if (report.refused.size() != before)
    report.refused.back() +=
        ", give it a surface around it with --wrap 1%, or bake with --unsigned: distances without "
        "inside and outside";
}

}  // namespace firmtouch::tools
