#include "firmtouch/scene/proxy.hpp"

#include <float.h>

#include "firmtouch/math/elementary.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// All relative to the size of the shape. A query's bounds lose at most 4e-7.
constexpr float kAim = 1e-6f;        // of planes beyond the radius: float32 then decides a query
constexpr float kTolerance = 1e-6f;  // a move that is shorter needs no query
// What a place that was certified with kAim may drift.
constexpr float kDrift = kAim + kClearance;
constexpr float kExact = 4.5e-7f;      // between the bounds of an exact answer
constexpr float kLonger = 0.9e-7f;     // a tick without friction may be away from the hand
constexpr float kRestoring = 2.5e-8f;  // a tick, of clearance that rounding took
// Band of queries beyond the sphere: many times what a hand moves in a tick.
constexpr float kBand = 0.02f;

// Part of the certified free radius that one move takes.
constexpr float kCap = 0.9f;
constexpr float kLongestWay = 0.02f;  // that is searched at once
constexpr uint32_t kMinWayWork = 64;  // units, to search a way

bool is_same(const Feature& a, const Feature& b, float within_m) {
  // Most differ here already.
  if (a.kind != b.kind || __builtin_fabsf(a.corner[0].x - b.corner[0].x) > within_m) return false;
  for (uint32_t k = 0; k < 3; ++k)
    if (!(math::length(a.corner[k] - b.corner[k]) <= within_m)) return false;
  return true;
}

}  // namespace

uint32_t index_of(const Feature& feature, const Proxy& proxy, float size_m) {
  uint32_t at = 0;
  for (; at < proxy.feature_count; ++at)
    if (is_same(proxy.feature[at], feature, kSameFeature * size_m)) break;
  return at;
}

ProxyMove::ProxyMove(const ProxySettings& settings, float size_m, Vec3 goal_m, Proxy& proxy)
    : settings_(settings),
      proxy_(proxy),
      goal_m_(goal_m),
      size_m_(size_m),
      cap_(kCap),
      work_left_(settings.budget.work == 0 ? 1 : settings.budget.work) {
  if (!math::is_finite(goal_m_)) is_over_ = true;
  if (proxy_.feature_count > kMaxFeatures) proxy_.feature_count = 0;
  if (proxy_.phase == Proxy::Phase::kFree) use_radius();
  begin_m_ = proxy_.position_m;
  if (!proxy_.is_loaded) free_way_m_ = math::length(goal_m_ - begin_m_);
  const float slide = proxy_.slid_m / settings_.friction_slide_m;
  friction_.coulomb =
      settings_.friction_dynamic +
      (settings_.friction_static - settings_.friction_dynamic) * math::decay(slide * slide);
  friction_.viscous_share = settings_.viscous_share;
}

// Of a tool without load the radius may fall at once, and grow where there is room.
void ProxyMove::use_radius() {
  const float least_m = kMinRadius * size_m_;
  const float wanted_m = settings_.radius_m > least_m ? settings_.radius_m : least_m;
  aimed_radius_m_ = proxy_.radius_m;
  if (!(proxy_.radius_m < wanted_m)) proxy_.is_growing = false;
  if (proxy_.is_growing && settings_.growth_m > 0.0f) {
    const float next_m = proxy_.radius_m + settings_.growth_m;
    aimed_radius_m_ = next_m < wanted_m ? next_m : wanted_m;
  }
  if (proxy_.is_loaded) return;
  if (wanted_m <= proxy_.radius_m) {
    proxy_.radius_m = aimed_radius_m_ = wanted_m;
    return;
  }
  const float fits_m = proxy_.free_m < wanted_m ? proxy_.free_m : wanted_m;
  if (fits_m > proxy_.radius_m) proxy_.radius_m = fits_m;
  if (aimed_radius_m_ < proxy_.radius_m) aimed_radius_m_ = proxy_.radius_m;
}

query::Budget ProxyMove::budget() const {
  query::Budget budget{work_left_};
  // For a place that is not certified yet the side matters, too.
  if (proxy_.phase == Proxy::Phase::kFree) {
    budget.band_m = aimed_radius_m_ + kBand * size_m_ + free_way_m_;
    budget.threshold_m = needed_m();
  }
  return budget;
}

float ProxyMove::needed_m() const {
  return (proxy_.phase == Proxy::Phase::kFree ? proxy_.radius_m : settings_.radius_m) -
         kClearance * size_m_;
}

// With friction no move may be away from the hand; without, all of a tick together by rounding.
bool ProxyMove::is_longer(Vec3 to_m) const {
  if (aimed_radius_m_ > proxy_.radius_m) return false;
  const bool is_held = friction_.coulomb > 0.0f;
  const Vec3 from_m = is_held ? proxy_.position_m : begin_m_;
  const Vec3 step_m = to_m - from_m;
  const Vec3 sum_m = (to_m - goal_m_) + (from_m - goal_m_);
  const float longer = math::dot(step_m, sum_m), sum = math::length(sum_m);
  const float rounding = 8.0f * 0x1p-24f * math::length(step_m) * sum;
  return !(longer + rounding <= (is_held ? 0.0f : kLonger * size_m_ * sum));
}

void ProxyMove::drop(uint32_t i) {
  const uint32_t last = --proxy_.feature_count;
  proxy_.feature[i] = proxy_.feature[last];
  proxy_.plane[i] = proxy_.plane[last];
}

// Planes count from the proxy again. A feature that is farther away than this move and a usual one
// of the next tick reach is dropped.
void ProxyMove::begin_planes() {
  outlook_ = {goal_m_ - proxy_.position_m, proxy_.radius_m, kRestoring * size_m_};
  taken_ = 0;
  const float reach_m = kBand * size_m_ + math::length(outlook_.way_m);
  const Vec3 moved_m = proxy_.position_m - proxy_.planes_at_m;
  proxy_.planes_at_m = proxy_.position_m;
  for (uint32_t i = 0; i < proxy_.feature_count;) {
    math::HalfSpace& plane = proxy_.plane[i];
    plane.offset_m -= math::dot(plane.normal, moved_m);
    if (-plane.offset_m <= reach_m)
      ++i;
    else
      drop(i);
  }
  if (aimed_radius_m_ > proxy_.radius_m) take_all();
}

// The plane between a feature and the proxy, for the sphere's centre to stay in front of. A place
// that is nearer than the radius already need not be left: there no plane would have a solution.
void ProxyMove::take_plane(uint32_t i) {
  const Tangent tangent = tangent_at(proxy_.feature[i], proxy_.position_m, outlook_);
  const float most_m = outlook_.rounding_m + (aimed_radius_m_ - proxy_.radius_m);
  const float lacking_m = aimed_radius_m_ + kAim * size_m_ - tangent.distance_m;
  const float from_m = math::dot(tangent.normal, proxy_.position_m - proxy_.planes_at_m);
  proxy_.plane[i] = {tangent.normal, (lacking_m < most_m ? lacking_m : most_m) + from_m};
  taken_ |= 1u << i;
  // Nearer to a base hull than the radius a tool may be stuck, though its hand leaves.
  if (proxy_.feature[i].is_of_base_hull && math::dot(tangent.normal, outlook_.way_m) > 0.0f)
    moved_.is_starved = true;
}

// Result: whether a plane that holds the proxy was taken elsewhere before.
bool ProxyMove::take_active() {
  const uint32_t before = taken_;
  for (uint32_t n = 0; n < 3 && n < proxy_.active.count; ++n) {
    const uint32_t i = proxy_.active.plane[n];
    if (i < proxy_.feature_count && (taken_ >> i & 1u) == 0) take_plane(i);
  }
  return taken_ != before;
}

void ProxyMove::take_all() {
  for (uint32_t i = 0; i < proxy_.feature_count; ++i)
    if ((taken_ >> i & 1u) == 0) take_plane(i);
}

// Where the proxy comes to rest for the planes of the working set, from where it is. Only planes
// that hold it are taken anew, at most once each. A triangle's own plane may leave more of the way
// than the one across the line to it, but two may meet far from both triangles: where the proxy is
// held they are taken for a way of 0.
math::Slide ProxyMove::rest() {
  const Vec3 way_m = goal_m_ - proxy_.position_m;
  if (math::length(way_m) * kLengthUp < proxy_.free_m - aimed_radius_m_) return {way_m, false};
  if (proxy_.is_loaded) friction_.slid_m = math::length(proxy_.position_m - begin_m_);
  begin_planes();
  take_active();  // most often the same hold it again: then it is solved once
  bool is_near = false;
  for (;;) {
    if (again_left_ == 0) take_all();
    const math::NearestInPlanes nearest =
        math::nearest_in_planes(proxy_.plane, proxy_.feature_count, way_m, proxy_.active);
    proxy_.active = nearest.active;
    if (!take_active()) {
      const bool is_held = nearest.active.count > 1 && !is_near && again_left_ > 0;
      if (!is_held || !(math::length(nearest.point_m) <= kTolerance * size_m_))
        return math::slide_with_friction(proxy_.plane, proxy_.feature_count, way_m, nearest,
                                         friction_);
      is_near = true;
      outlook_.way_m = {};
      taken_ = 0;
      take_active();
    }
    --again_left_;
  }
}

// What is left of the free radius after a move.
// Result: whether that is enough. Before a query has found what is near, that is all of the radius:
// a tool that is nearer is led back under load, which gives the hand energy.
bool ProxyMove::is_within_certified(Vec3 to_m, float& left_m) const {
  left_m = (proxy_.free_m - math::length(to_m - proxy_.position_m) * kLengthUp) * (1.0f - 0x1p-22f);
  const bool is_held = proxy_.active.count > 0 && moved_.queries > 0;
  return left_m >= (is_held ? needed_m() : proxy_.radius_m);
}

// Makes a move that is too short for a query, where the certificate allows it.
bool ProxyMove::drift() {
  float left_m = 0;
  if (!is_within_certified(trial_m_, left_m)) return false;
  proxy_.position_m = trial_m_;
  proxy_.free_m = left_m;
  return true;
}

bool ProxyMove::aim() {
  if (is_over_) return false;
  if (proxy_.phase != Proxy::Phase::kFree) {
    if (moved_.queries == kMaxQueries) return false;
    if (moved_.queries > 0) return true;
    is_searching_ = math::length(goal_m_ - proxy_.searched_m) * kLengthUp < proxy_.searched_free_m;
    trial_m_ = is_searching_ ? proxy_.position_m : goal_m_;
    return true;
  }
  const math::Slide slide = rest();
  const float size_m = lag_m_ = math::length(slide.point_m);
  const float way_m = math::length(goal_m_ - proxy_.position_m);
  const float tolerance_m = math::larger(way_m * 3e-6f, kTolerance * size_m_);
  const float limit_m = cap_ * proxy_.free_m;
  // Bitwise at the hand, if nothing holds it back.
  const Vec3 missing_m = slide.point_m - (goal_m_ - proxy_.position_m);
  const bool is_to_goal = math::dot(missing_m, missing_m) <= 0.0f;
  trial_m_ = is_to_goal ? goal_m_ : proxy_.position_m + slide.point_m;
  is_short_ = !(size_m <= limit_m);
  if (is_short_) {
    trial_m_ = proxy_.position_m + slide.point_m * (limit_m / size_m);
    along_m_ = slide.point_m * math::smaller(kLongestWay * size_m_ / size_m, 1.0f);
    // What searches of ways take must not be lacking for certificates.
    is_short_ = cap_ >= kCap && moved_.work <= work_left_ / 2 && work_left_ >= kMinWayWork;
  }
  // A tool may have more room where it stands than what is certified.
  if (proxy_.radius_m < kSqueezed * aimed_radius_m_ && moved_.queries == 0 &&
      work_left_ >= kMinWayWork) {  // or the move itself would lack it
    trial_m_ = proxy_.position_m;
    is_short_ = false;
    return true;
  }
  is_over_ = true;
  if (size_m <= tolerance_m) {
    moved_.is_optimal = true;
    if (slide.is_stuck || !(size_m > 0.0f)) return false;
  }
  if (is_longer(trial_m_) || (size_m <= kDrift * size_m_ && drift())) {
    moved_.is_optimal = true;
    return false;
  }
  // A base hull goes on where the mesh's visits are gone.
  if (work_left_ == 0 && !moved_.is_of_base_hull) {
    moved_.is_starved = !moved_.is_optimal;
    return false;
  }
  if (moved_.queries == kMaxQueries) return false;
  // Within the ball that is certainly free. Where its radius is of the size of rounding, the tool
  // may stand for ever.
  const float step_m = math::length(trial_m_ - proxy_.position_m) * kLengthUp;
  is_over_ = !(step_m < proxy_.free_m) || (!(step_m > 0.0f) && !moved_.is_optimal);
  if (is_over_) moved_.is_starved = true;
  return !is_over_;
}

// Result: false if it was known, and its plane, too.
bool ProxyMove::keep(const Feature& feature) {
  if (feature.kind == Feature::Kind::kNone) return false;
  uint32_t at = index_of(feature, proxy_, size_m_);
  if (at < proxy_.feature_count && (taken_ >> at & 1u) != 0) return false;
  if (at == proxy_.feature_count && at < kMaxFeatures) {
    ++proxy_.feature_count;
  } else if (at == kMaxFeatures) {
    // Instead of the one whose plane is farthest from the trial.
    const Vec3 step_m = trial_m_ - proxy_.planes_at_m;
    float most_m = -FLT_MAX;
    at = 0;
    for (uint32_t i = 0; i < kMaxFeatures; ++i) {
      const math::HalfSpace& plane = proxy_.plane[i];
      const float slack_m = math::dot(plane.normal, step_m) - plane.offset_m;
      if (slack_m > most_m) most_m = slack_m, at = i;
    }
  }
  proxy_.feature[at] = feature;
  take_plane(at);
  return true;
}

// The mesh's own features hold again.
void ProxyMove::drop_base_hull() {
  for (uint32_t i = 0; i < proxy_.feature_count;) {
    if (proxy_.feature[i].is_of_base_hull) {
      drop(i);
    } else {
      ++i;
    }
  }
}

void ProxyMove::take(const Near& near) {
  ++moved_.queries;
  moved_.steps += near.steps;
  moved_.work += near.work;
  work_left_ -= near.work < work_left_ ? near.work : work_left_;
  if (near.is_of_base_hull) moved_.is_of_base_hull = true;
  if (proxy_.phase != Proxy::Phase::kFree) return begin_contact(near);
  if (near.lower_m >= needed_m()) {
    // Within the clearance only where the plane of a face does no better: one of a point is tilted,
    // and a last query would leave the tool where it is.
    if (near.lower_m < proxy_.radius_m && near.feature.kind == Feature::Kind::kTriangle &&
        work_left_ > 0 && moved_.queries < kMaxQueries && keep(near.feature))
      return;
    proxy_.position_m = trial_m_;
    proxy_.free_m = near.lower_m;
    proxy_.near = near;
    if (!near.is_of_base_hull) drop_base_hull();
    keep(near.feature);
    cap_ = kCap;
    const float grown_m = near.lower_m < aimed_radius_m_ ? near.lower_m : aimed_radius_m_;
    if (grown_m > proxy_.radius_m) proxy_.radius_m = grown_m;
    if (moved_.is_optimal) is_over_ = true;
    return;
  }
  const float scale_m = near.distance_m > size_m_ ? near.distance_m : size_m_;
  if (near.feature.kind != Feature::Kind::kNone &&
      (near.is_exact || near.is_of_base_hull || near.distance_m < needed_m() + kExact * scale_m)) {
    if (!keep(near.feature)) cap_ *= 0.5f;
    return;
  }
  moved_.is_starved = true;
  is_over_ = true;
}

ProxyMoved ProxyMove::finish() {
  const Vec3 off_m = goal_m_ - proxy_.position_m;
  const float off2_m2 = math::dot(off_m, off_m);
  proxy_.is_loaded = !(off2_m2 <= 0.0f);
  // A proxy that lags by no more than twice what it moved follows the hand: the next tick goes on.
  const float moved_m = math::length(proxy_.position_m - begin_m_);
  proxy_.slid_m += (moved_m - proxy_.slid_m) * settings_.slide_share;
  if (!proxy_.is_loaded) proxy_.slid_m = 0;
  // Also where most of the way to the hand is open, but the base hull certifies none of it.
  if (moved_.is_of_base_hull && !(moved_m > 0.0f) && 4.0f * lag_m_ * lag_m_ > off2_m2)
    moved_.is_starved = true;
  if (proxy_.phase == Proxy::Phase::kFree && moved_m >= 0.5f * lag_m_) moved_.is_starved = false;
  if (moved_.is_optimal) moved_.is_starved = false;
  return moved_;
}

}  // namespace firmtouch::scene
