// Where a proxy's way is longer than its free ball.
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/proxy.hpp"

namespace firmtouch::scene {

using math::Vec3;

namespace {
// Of the way that a bend adds: a proxy with friction that went too far would stay there.
constexpr float kBent = 0.9f;
// Times the way along the face to the hand: twice as far is as far from it as the begin.
constexpr float kPastHand = 1.9f;
constexpr float kMeasured = 3e-4f;       // of the size: no shorter way measures a bend
constexpr float kSameNormal = 0.99999f;  // cosine squared
}  // namespace

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

Vec3 ProxyMove::along_face(Vec3 way_m) const {
  return way_m - face_normal_ * math::dot(way_m, face_normal_);
}

// Only where nothing holds the proxy but the face that the last query found. The hand is `across_m`
// behind that face and `along_m` aside. If the face turns by k radians a metre, a slide of w is
// w - a s - b s^2 after s of it: it ends at the root, `by` times w.
void ProxyMove::bend() {
  const uint32_t i = proxy_.active.plane[0];
  face_cosine_ = 0.0f;
  if (proxy_.phase != Proxy::Phase::kFree || moved_.is_optimal) return;
  if (proxy_.active.count != 1 || i >= proxy_.feature_count) return;
  face_normal_ = proxy_.plane[i].normal;
  const float cosine = math::dot(proxy_.near.outward, face_normal_);
  if (!(cosine * cosine > kSameNormal)) return;
  face_cosine_ = cosine;
  if (is_short_) return;
  const Vec3 way_m = along_face(trial_m_ - proxy_.position_m);
  const Vec3 hand_m = goal_m_ - proxy_.position_m;
  const float across_m = -math::dot(hand_m, face_normal_),
              along_m = math::length(along_face(hand_m));
  const float k = moved_.queries == 0 ? proxy_.bend_per_m : bend_per_m_, mu = friction_.coulomb;
  const float share = 1.0f - friction_.viscous_share;
  const float a = 1.0f - share * k * (across_m + mu * along_m);
  const float four_b_per_m = 2.0f * share * k * (k * along_m + mu * (1.0f - k * across_m));
  const float w_m = math::length(way_m);
  const float by = 2.0f / (a + math::square_root(a * a + four_b_per_m * w_m));
  if (!(by > 1.0f)) return;
  const float more = math::smaller(kBent * (by - 1.0f), kPastHand * along_m / w_m - 1.0f);
  const Vec3 to_m = trial_m_ + way_m * more;
  const float step_m = math::length(to_m - proxy_.position_m);
  if (step_m <= cap_ * proxy_.free_m && !is_longer(to_m)) trial_m_ = to_m;
}

void ProxyMove::take_bend(Vec3 outward) {
  const Vec3 way_m = along_face(trial_m_ - proxy_.position_m), from = proxy_.near.outward;
  const float least_m = kMeasured * size_m_, way2_m2 = math::dot(way_m, way_m);
  if (!(way2_m2 > least_m * least_m)) return;
  const float k = face_cosine_ * math::dot(outward - from, way_m) / way2_m2;
  bend_per_m_ = k > 0.0f ? k : 0.0f;
  if (moved_.queries == 0) proxy_.bend_per_m = bend_per_m_;
}

}  // namespace firmtouch::scene
