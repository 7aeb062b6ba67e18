#include "bake/spline/spline_tree.hpp"
#include "firmtouch/spline/surface/patch_grid.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::tools {
namespace {

struct Part {
  spline::LeafShape shape;
  math::Vec3 first_m, last_m;
};

math::Vec3 end_of(const spline::LeafShape& shape, float x) {
  math::Vec3 sum{};
  float w = 0;
  for (uint32_t k = shape.degree_u + 1; k-- > 0;) {
    sum = {sum.x * x + shape.c[k].x, sum.y * x + shape.c[k].y, sum.z * x + shape.c[k].z};
    w = w * x + shape.w[k];
  }
  return {shape.middle_m.x + sum.x / w, shape.middle_m.y + sum.y / w, shape.middle_m.z + sum.z / w};
}

bool is_near(const math::Vec3& a, const math::Vec3& b, float near_m) {
  return std::fabs(a.x - b.x) <= near_m && std::fabs(a.y - b.y) <= near_m &&
         std::fabs(a.z - b.z) <= near_m;
}

// The radius of each node in metres, of all leaves below it.
std::vector<float> radii_of(const SplineTree& tree, const std::vector<Part>& parts) {
  const spline::CurveLevels levels(static_cast<uint32_t>(tree.leaves.size()));
  std::vector<float> radii(levels.node_count(), 0.0f);
  for (uint32_t i = 0; i < levels.leaf_count; ++i) {
    if (tree.leaves[i] == spline::kNoLeaf) continue;
    const uint32_t node = levels.first_node() + i;
    radii[node - 1] = spline::radius_for(parts[i].shape, tree.points_m[i], tree.points_m[i + 1]);
  }
  return radii;
}

// A unit whose bytes reach the largest radius, and the byte of each; those above a leaf follow from
// its own.
void store_radii(SplineTree& tree, const std::vector<Part>& parts) {
  const spline::CurveLevels levels(static_cast<uint32_t>(tree.leaves.size()));
  std::vector<float> radii = radii_of(tree, parts);
  double reach_m = 0;
  for (const math::Vec3& p : tree.points_m) {
    const math::Vec3 off{p.x - tree.points_m[0].x, p.y - tree.points_m[0].y,
                         p.z - tree.points_m[0].z};
    reach_m =
        std::max({reach_m, static_cast<double>(std::fabs(off.x)),
                  static_cast<double>(std::fabs(off.y)), static_cast<double>(std::fabs(off.z))});
  }
  for (const float radius_m : radii) reach_m = std::max(reach_m, static_cast<double>(radius_m));
  // No radius is above four times the reach; a byte goes over almost 32 doublings.
  tree.radius_unit_m = std::ldexp(1.0f, std::ilogb(reach_m) + 4 - 31);
  const float unit = tree.radius_unit_m;
  tree.radii.assign(radii.size(), 0);
  for (uint32_t i = 0; i < levels.leaf_count; ++i) {
    if (tree.leaves[i] == spline::kNoLeaf) continue;
    uint32_t node = levels.first_node() + i;
    const auto keep = [&](float radius_m) {
      uint8_t& byte = tree.radii[node - 1];
      byte = std::max(byte, static_cast<uint8_t>(spline::byte_above(unit, radius_m)));
    };
    keep(radii[node - 1]);
    const float leaf_m = spline::in_units(unit, tree.radii[node - 1]);
    for (node >>= 1; node != 0; node >>= 1) {
      const spline::CurveLevels::Leaves under = levels.below(node);
      keep(under.end - under.first == 1
               ? leaf_m
               : spline::radius_above(leaf_m, tree.points_m[i], tree.points_m[i + 1],
                                      tree.points_m[under.first], tree.points_m[under.end]));
    }
  }
}

}  // namespace

spline::CurveBend curve_bend_of(const StoredPiece& stored) {
  spline::CurveBends bends;
  for (uint32_t k = 0; k < spline::kFineSteps; ++k)
    if (!spline::add_bends(stored.piece, stored.coefficients.data(), k, bends))
      return {HUGE_VALF, HUGE_VALF, HUGE_VALF, HUGE_VALF, 0};
  return bends.stored();
}

SplineTree build_spline_tree(const std::vector<StoredPiece>& pieces) {
  SplineTree tree;
  std::vector<Part> parts;
  for (size_t p = 0; p < pieces.size(); ++p) {
    const spline::Piece& piece = pieces[p].piece;
    spline::CurveBend bend = curve_bend_of(pieces[p]);
    for (const float bound : {bend.fixed_m2, bend.turning_m, bend.noise_m2, bend.noise_turning_m})
      if (!(bound <= spline::kMaxBend)) return {};
    for (uint32_t u = 0; u < 1u << piece.level_u; ++u) {
      Part part{};
      part.shape = shape_of(pieces[p], piece.level_u, u, piece.level_v, 0);
      part.first_m = end_of(part.shape, -1);
      part.last_m = end_of(part.shape, 1);
      // Neighbours that meet share the point between them.
      const bool meets =
          !parts.empty() && is_near(tree.points_m.back(), part.first_m, 4 * part.shape.noise_m);
      if (!meets) {
        if (!parts.empty()) {
          tree.leaves.push_back(spline::kNoLeaf);
          parts.emplace_back();
        }
        tree.points_m.push_back(part.first_m);
      }
      if (u == 0) bend.first_leaf = static_cast<uint32_t>(tree.leaves.size());
      tree.points_m.push_back(part.last_m);
      tree.leaves.push_back(static_cast<uint16_t>(p));
      parts.push_back(part);
    }
    tree.bends.push_back(bend);
  }
  if (tree.leaves.size() > spline::kMaxLeaves) return {};
  store_radii(tree, parts);
  return tree;
}

}  // namespace firmtouch::tools
