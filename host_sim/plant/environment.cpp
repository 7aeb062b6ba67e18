#include "host_sim/plant/environment.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/scene/relief.hpp"
#include "firmtouch/spline/closest_point.hpp"

namespace firmtouch::host_sim {
namespace {

Vec wide(math::Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

constexpr uint32_t kMaxVisits = 20000;  // the hand's aim does not need an exact answer

}  // namespace

Environment::Environment(std::vector<PlacedMesh> meshes, const spline::View& surface,
                         std::vector<Vec> guide_m, Vec scene_m, Vec asset_origin_m)
    : meshes_(std::move(meshes)),
      surface_(surface),
      origin_m_(scene_m + asset_origin_m),
      scene_m_(scene_m),
      guide_m_(std::move(guide_m)) {
  if (surface_.is_open()) tessellation_ = tessellate(surface_);
  double arc = 0;
  for (size_t i = 0; i < guide_m_.size(); ++i) {
    guide_m_[i] = guide_m_[i] + origin_m_;
    if (i > 0) arc += norm(guide_m_[i] - guide_m_[i - 1]);
    arc_m_.push_back(arc);
  }
  closed_ = has_guide() && !(norm(guide_m_.front() - guide_m_.back()) > 0);
}

Environment::Surface Environment::nearest(Vec from_m) const {
  if (!has_mesh()) {
    const Vec in_mesh = from_m - origin_m_;
    spline::CurveHint cold;
    const spline::Closest found =
        spline::closest_point(surface_, tools::to_vec3(in_mesh), {kMaxVisits}, cold);
    Vec normal = wide(found.direction) * (normals_inward_ ? -1.0 : 1.0);
    const Vec off = in_mesh - wide(found.point_m);
    if (!(norm(normal) > 0.5)) normal = unit(off);  // no normal at a pole
    const double distance_m = static_cast<double>(found.distance_m);
    return {wide(found.point_m) + origin_m_, normal,
            dot(off, normal) < 0 ? -distance_m : distance_m};
  }
  Surface best;
  for (const PlacedMesh& placed : meshes_) {
    mesh::Hint cold;
    const mesh::Closest found = mesh::closest_point(
        placed.mesh, tools::to_vec3(placed.to_own(from_m)), query::kUnlimited, cold);
    const double distance_m = static_cast<double>(found.distance_m);
    if (&placed != &meshes_.front() && !(distance_m < best.distance_m)) continue;
    best = {placed.to_device(wide(found.point_m)), placed.turned(wide(found.direction)),
            distance_m};
  }
  return best;
}

uint32_t Environment::triangle_count() const {
  uint32_t count = 0;
  for (const PlacedMesh& placed : meshes_) count += placed.mesh.head().triangle_count;
  return count;
}

void Environment::set_textures(std::vector<scene::TextureLayout> textures,
                               std::vector<scene::ReliefLayout> reliefs,
                               std::vector<uint8_t> samples) {
  textures_ = std::move(textures);
  reliefs_ = std::move(reliefs);
  samples_ = std::move(samples);
}

scene::Stiffening Environment::stiffening() const {
  return scene::stiffening_of({textures_.data(), static_cast<uint32_t>(textures_.size())},
                              {reliefs_.data(), static_cast<uint32_t>(reliefs_.size())});
}

double Environment::spring_N_per_m(uint32_t material, double contact_N_per_m) const {
  if (material == 0 || material > stiffness_N_per_m_.size()) return contact_N_per_m;
  return contact_N_per_m / (1 + contact_N_per_m / stiffness_N_per_m_[material - 1]);
}

Vec Environment::texture_slope(uint32_t material, Vec tool_m) const {
  if (material == 0) return {};
  const PlacedMesh& placed = meshes_.front();
  const math::Vec3 at_m = tools::to_vec3(placed.to_own(tool_m));
  scene::Cut cut;
  if (material <= textures_.size()) cut = scene::cut_at(textures_[material - 1], at_m);
  if (material <= reliefs_.size())
    scene::add_relief(reliefs_[material - 1], samples_.data(), at_m, cut);
  return placed.turned(wide(cut.slope));
}

Vec Environment::guide_at(double arc_m) const {
  const double length = guide_length_m();
  double arc = std::fmod(arc_m, closed_ ? length : 2 * length);
  if (arc > length) arc = 2 * length - arc;
  const auto above = std::upper_bound(arc_m_.begin(), arc_m_.end(), arc);
  const size_t i =
      std::clamp<size_t>(static_cast<size_t>(above - arc_m_.begin()), 1, arc_m_.size() - 1);
  const double span = arc_m_[i] - arc_m_[i - 1];
  return guide_m_[i - 1] +
         (guide_m_[i] - guide_m_[i - 1]) * (span > 0 ? (arc - arc_m_[i - 1]) / span : 0);
}

}  // namespace firmtouch::host_sim
