#include "bake/mesh/query_cost.hpp"

#include <vector>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/loss.hpp"
#include "surface/make/make_walk.hpp"

namespace firmtouch::tools {
namespace {

using math::Vec3;

constexpr uint32_t kPaths = 4, kPathPoints = 10000;
constexpr uint64_t kFirstSeed = 101;  // not that of a bench

// So much do the costs of other paths differ.
constexpr uint64_t kMinGain_percent = 3;

// Instructions of a Cortex-M7 (firmware/firmtouch/mesh/README.md, Cost): a node or half a measured
// triangle, the weighing of rivals, a measurement in double-float.
constexpr uint64_t kPart = 28, kWeighing = 170, kCompensated = 400;

struct Trial {
  std::vector<Section> sections;
  mesh::View view;
};

bool bake_trial(const Surface& surface, MeshOptions options, Trial& trial) {
  options.is_signed = false;
  options.materials.clear();
  options.textures.clear();
  options.reliefs.clear();
  MeshReport report;
  trial.sections = bake_mesh_so(surface, "trial", options, report);
  return report.problem.empty() && open_baked(trial.sections, "trial", trial.view).ok();
}

// Whether float32 may have lost too much of the nearest triangle (mesh/nearest_answer.hpp).
bool is_measured_again(const mesh::View& mesh, const mesh::Closest& closest) {
  const mesh::Triangle<uint32_t> t = mesh.triangle(closest.triangle);
  const Vec3 a_m = mesh.vertex(t.corner[0]), b_m = mesh.vertex(t.corner[1]);
  const Vec3 from_m = closest.feature == mesh::Feature::kEdge1 ? b_m : a_m;
  const float own_m = mesh::Loss::own_m(closest.distance_m, math::dot(b_m - a_m, b_m - a_m),
                                        math::length(closest.point_m - from_m),
                                        closest.feature == mesh::Feature::kFace) +
                      mesh.head().rounding_m;
  return 2 * own_m > mesh::kPromise * mesh.head().diagonal_m;
}

uint64_t cost_of(const mesh::View& mesh, const std::vector<Vec3>& path) {
  mesh::Hint hint;
  uint64_t cost = 0;
  for (const Vec3& p_m : path) {
    const mesh::Closest closest = mesh::closest_point(mesh, p_m, query::kUnlimited, hint);
    cost += kPart * 3 * closest.certificate.work;
    if (!mesh.has_rivals()) continue;
    cost += kWeighing + (is_measured_again(mesh, closest) ? kCompensated : 0);
  }
  return cost;
}

std::vector<Vec3> path_on(const Surface& surface, const mesh::View& mesh, uint64_t seed) {
  mesh::Hint hint;
  return make_walk(surface, seed, kPathPoints, [&](Vec3 p_m) {
    return mesh::closest_point(mesh, p_m, query::kUnlimited, hint).point_m;
  });
}

}  // namespace

MeshOptions without_needless_splits(const Surface& surface, const MeshOptions& options) {
  if (!(options.max_growth > 1) || !has_long_edges(surface)) return options;
  MeshOptions whole = options;
  whole.max_growth = 1;
  Trial split, kept;
  if (!bake_trial(surface, options, split) || !split.view.has_rivals()) return options;
  if (split.view.head().triangle_count <= surface.faces.size()) return options;
  if (!bake_trial(surface, whole, kept)) return options;
  uint64_t split_cost = 0, kept_cost = 0;
  for (uint32_t k = 0; k < kPaths; ++k) {
    const std::vector<Vec3> path = path_on(surface, split.view, kFirstSeed + k);
    split_cost += cost_of(split.view, path);
    kept_cost += cost_of(kept.view, path);
  }
  return kept_cost * 100 < split_cost * (100 - kMinGain_percent) ? whole : options;
}

}  // namespace firmtouch::tools
