// Where a proxy's way is longer than its free ball.
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/proxy.hpp"

namespace firmtouch::scene {

using math::Vec3;

ProxySettings with_ball(const ProxySettings& settings, float size_m) {
  ProxySettings used = settings;
  used.radius_m = math::larger(settings.radius_m, kMinBall * size_m);
  return used;
}

Way ProxyMove::way() const {
  Way way;
  way.from_m = proxy_.position_m;
  way.along_m = along_m_;
  // A place on the way rounds a part of it and their sum, each by 2^-24 of what it gives; a pose
  // turns the way, six roundings more.
  way.radius_m = needed_m() + 0x1p-23f * (math::length(way.from_m) + 4.0f * math::length(along_m_));
  for (uint32_t n = 0; n < 3 && n < proxy_.active.count; ++n) {
    const uint32_t i = proxy_.active.plane[n];
    if (i >= proxy_.feature_count) continue;
    const Vec3 normal = proxy_.plane[i].normal;
    // Whatever the bits of a working set are.
    if (math::dot(normal, normal) <= 1.0f + 0x1p-21f) way.axis[way.axes++] = -normal;
  }
  return way;
}

void ProxyMove::take_way(float free_part, uint32_t work) {
  moved_.work += work;
  work_left_ -= work < work_left_ ? work : work_left_;
  const Vec3 end_m = proxy_.position_m + along_m_ * free_part;
  if (free_part * math::length(along_m_) > cap_ * proxy_.free_m && !is_longer(end_m))
    trial_m_ = end_m;
}

}  // namespace firmtouch::scene
