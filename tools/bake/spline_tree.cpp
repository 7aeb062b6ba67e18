#include "bake/spline_tree.hpp"

#include <algorithm>
#include <cmath>

#include "bake/left_filled.hpp"

namespace firmtouch::tools {
namespace {

struct Part {
  spline::Leaf leaf;
  spline::LeafShape shape;
  uint32_t order;                // piece by piece
  uint16_t first = 0, last = 0;  // points of a curve
};

struct Range {
  uint32_t node, begin, end;
};

spline::Bend bend_of(const Part& part) {
  return {spline::rounded_up(part.shape.fixed[0]), spline::rounded_up(part.shape.turning[0])};
}

std::vector<Part> parts_of(const std::vector<StoredPiece>& pieces) {
  std::vector<Part> parts;
  for (size_t p = 0; p < pieces.size(); ++p) {
    const spline::Piece& piece = pieces[p].piece;
    for (uint32_t v = 0; v < 1u << piece.level_v; ++v)
      for (uint32_t u = 0; u < 1u << piece.level_u; ++u) {
        Part part{};
        part.shape = shape_of(pieces[p], piece.level_u, u, piece.level_v, v);
        part.leaf.piece = static_cast<uint16_t>(p);
        part.leaf.index_u = static_cast<uint8_t>(u);
        part.leaf.index_v = static_cast<uint8_t>(v);
        part.order = static_cast<uint32_t>(parts.size());
        parts.push_back(part);
      }
  }
  return parts;
}

math::Vec3 end_of(const spline::LeafShape& shape, float x) {
  math::Vec3 sum{};
  float w = 0;
  for (uint32_t k = shape.degree_u + 1; k-- > 0;) {
    sum = {sum.x * x + shape.c[k].x, sum.y * x + shape.c[k].y, sum.z * x + shape.c[k].z};
    w = w * x + shape.w[k];
  }
  return {shape.middle_m.x + sum.x / w, shape.middle_m.y + sum.y / w, shape.middle_m.z + sum.z / w};
}

// Neighbours that meet share the point between them.
bool place_points(std::vector<Part>& parts, std::vector<spline::Point>& points) {
  for (Part& part : parts) {
    const math::Vec3 first = end_of(part.shape, -1), last = end_of(part.shape, 1);
    const spline::Point* before = points.empty() ? nullptr : &points.back();
    const float near_m = 4 * part.shape.noise_m;
    const bool meets = before != nullptr && std::fabs(before->x_m - first.x) <= near_m &&
                       std::fabs(before->y_m - first.y) <= near_m &&
                       std::fabs(before->z_m - first.z) <= near_m;
    if (!meets) points.push_back({first.x, first.y, first.z});
    part.first = static_cast<uint16_t>(points.size() - 1);
    points.push_back({last.x, last.y, last.z});
    part.last = static_cast<uint16_t>(points.size() - 1);
    if (points.size() > spline::kMaxLeaves) return false;
  }
  return true;
}

math::Vec3 vec(const spline::Point& p) { return {p.x_m, p.y_m, p.z_m}; }

spline::Capsule capsule_around(const std::vector<Part>& parts, uint32_t begin, uint32_t end,
                               const std::vector<spline::Point>& points) {
  spline::Capsule capsule{parts[begin].first, parts[end - 1].last, 0};
  const math::Vec3 a = vec(points[capsule.first]), b = vec(points[capsule.last]);
  for (uint32_t i = begin; i < end; ++i) {
    const math::Vec3 from = vec(points[parts[i].first]), to = vec(points[parts[i].last]);
    const uint16_t own = spline::rounded_up(spline::radius_for(parts[i].shape, from, to));
    const uint16_t needed =
        end - begin == 1
            ? own
            : spline::rounded_up(spline::radius_above(spline::from_half(own), from, to, a, b));
    capsule.radius = std::max(capsule.radius, needed);
  }
  return capsule;
}

}  // namespace

SplineTree build_spline_tree(const std::vector<StoredPiece>& pieces) {
  SplineTree tree;
  std::vector<Part> parts = parts_of(pieces);
  for (const Part& part : parts)
    if (bend_of(part).fixed >= 0x7F80u || bend_of(part).turning >= 0x7F80u) return tree;
  if (!place_points(parts, tree.points)) return tree;
  const auto count = static_cast<uint32_t>(parts.size());
  tree.leaves.resize(count);
  tree.bends.resize(count);
  tree.places.resize(count);
  tree.capsules.resize(2 * count - 1);
  std::vector<Range> open{{0, 0, count}};
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    tree.capsules[range.node] = capsule_around(parts, range.begin, range.end, tree.points);
    const uint32_t size = range.end - range.begin;
    if (size == 1) {
      const uint32_t leaf = range.node - (count - 1);
      tree.leaves[leaf] = parts[range.begin].leaf;
      tree.bends[leaf] = bend_of(parts[range.begin]);
      tree.places[parts[range.begin].order] = static_cast<uint16_t>(leaf);
      continue;
    }
    const uint32_t middle = range.begin + (first_size(2 * size - 1) + 1) / 2;
    open.push_back({spline::first_child(range.node), range.begin, middle});
    open.push_back({spline::first_child(range.node) + 1, middle, range.end});
  }
  return tree;
}

}  // namespace firmtouch::tools
