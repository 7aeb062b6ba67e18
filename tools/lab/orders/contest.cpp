#include "lab/orders/contest.hpp"

#include <algorithm>
#include <cmath>

#include "bench/problem.hpp"
#include "lab/orders/build.hpp"
#include "lab/orders/names.hpp"
#include "lab/trials.hpp"

namespace firmtouch::lab::orders {
namespace {

template <class K>
struct Planted {
  std::vector<typename K::Node> nodes;
  std::vector<uint32_t> middle;
  Tree<K> tree;
};

template <class K>
double bytes_of(const Tree<K>& tree, Upper upper) {
  const double middles = upper == Upper::kVertex ? 4.0 * K::kWays : 0.0;
  return tree.nodes.size() * (static_cast<double>(sizeof(typename K::Node)) + middles);
}

[[noreturn]] void refuse() {
  throw Problem("more than " + std::to_string(kRingBoxes) + " boxes wait; take a smaller model");
}

template <class K>
Entrant entrant(const char* kind, const Tree<K>& tree, const Variant<K>& variant, Waiting waiting) {
  Entrant e;
  e.kind = kind;
  e.order = name_of(variant.order);
  e.upper = name_of(variant.upper);
  e.tree_bytes = bytes_of(tree, variant.upper);
  e.nearest = [&tree, variant, waiting](Vec3 p_m) {
    Counters ignored;
    Nearest nearest;
    if (!variant.run(tree, p_m, waiting, ignored, nearest)) refuse();
    return nearest;
  };
  e.pass = [&tree, variant, waiting](const std::vector<Vec3>& points) {
    double sum = 0;
    Counters ignored;
    Nearest nearest;
    for (const Vec3& p_m : points) {
      if (!variant.run(tree, p_m, waiting, ignored, nearest)) refuse();
      sum += static_cast<double>(math::square_root(nearest.distance2_m2));
    }
    return sum;
  };
  e.count = [&tree, variant, waiting](const std::vector<Vec3>& points) {
    Counters counters;
    Nearest nearest;
    for (const Vec3& p_m : points)
      if (!variant.count(tree, p_m, waiting, counters, nearest)) refuse();
    return counters;
  };
  return e;
}

}  // namespace

struct Contest::Forest {
  explicit Forest(const mesh::View& mesh)
      : ranges(2 * size_t{mesh.nodes().size()}), sources(mesh.nodes().size()), waiting(kRingBoxes) {
    const Workshop work{ranges.data(), sources.data()};
    plant(mesh, work, grid);
    plant(mesh, work, floats);
    plant(mesh, work, oriented);
    wide.nodes.resize(mesh.nodes().size());
    wide.middle.resize(4 * size_t{mesh.nodes().size()});
    wide.tree = build_wide(mesh, work, wide.nodes.data(), wide.middle.data());
  }

  template <class K>
  static void plant(const mesh::View& mesh, Workshop work, Planted<K>& planted) {
    planted.nodes.resize(mesh.nodes().size());
    planted.middle.resize(K::kWays * size_t{mesh.nodes().size()});
    planted.tree = build<K>(mesh, work, planted.nodes.data(), planted.middle.data());
  }

  template <class K>
  void enter(const char* kind, const Tree<K>& tree, std::vector<Entrant>& entrants) {
    for (const Variant<K>& variant : kVariants<K>)
      entrants.push_back(entrant(kind, tree, variant, {waiting.data(), kRingBoxes}));
  }

  std::vector<Range> ranges;
  std::vector<uint32_t> sources;
  std::vector<Pending> waiting;
  Planted<GridKind> grid;
  Planted<FloatKind> floats;
  Planted<WideKind> wide;
  Planted<OrientedKind> oriented;
};

Contest::Contest(const mesh::View& mesh) : forest_(std::make_shared<Forest>(mesh)) {
  forest_->enter(kKindNames[0], forest_->grid.tree, entrants_);
  forest_->enter(kKindNames[1], forest_->floats.tree, entrants_);
  forest_->enter(kKindNames[2], forest_->wide.tree, entrants_);
  forest_->enter(kKindNames[3], forest_->oriented.tree, entrants_);
}

}  // namespace firmtouch::lab::orders
