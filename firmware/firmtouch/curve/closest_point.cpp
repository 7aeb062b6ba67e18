#include "firmtouch/curve/closest_point.hpp"

#include <float.h>

#include "firmtouch/core/hash.hpp"
#include "firmtouch/curve/answer.hpp"
#include "firmtouch/curve/tree_search.hpp"
#include "firmtouch/query/coherence.hpp"

namespace firmtouch::curve {
namespace {

using math::Vec3;

/// Keeps the closest point; of a segment it looks at the half that belongs to the sample, and a
/// little more, so that no rounding leaves a gap at the middle.
class ClosestFoot {
 public:
  ClosestFoot(const View& curve, Vec3 p_m)
      : samples_(curve.samples().data()),
        count_(curve.samples().size()),
        carefully_(needs_care(curve.head(), p_m)),
        p_m_(p_m) {}

  bool carefully() const { return carefully_; }

  void begin(const Foot& foot) { keep(foot); }
  const Foot& best() const { return best_; }

  float radius_m() const { return radius_m_; }
  void take(uint32_t sample, Vec3 from_m, float distance2_m2) {
    const Vec3 at_m = vec(samples_[sample]);
    if (carefully_) distance2_m2 = careful_distance2(p_m_, at_m, at_m, 0.0f);
    if (distance2_m2 < best_.distance2_m2)
      keep({distance2_m2, sample, sample + 1 < count_ ? sample + 1 : sample - 1, 0.0f});
    if (sample + 1 < count_) {
      const Vec3 along_m = vec(samples_[sample + 1]) - at_m;
      const float progress_m2 = dot(from_m, along_m);
      if (progress_m2 > 0.0f) look_along(sample, sample + 1, from_m, along_m, progress_m2);
    }
    if (sample > 0) {
      const Vec3 along_m = vec(samples_[sample - 1]) - at_m;
      const float progress_m2 = dot(from_m, along_m);
      if (progress_m2 > 0.0f) look_along(sample, sample - 1, from_m, along_m, progress_m2);
    }
  }

 private:
  void look_along(uint32_t sample, uint32_t neighbour, Vec3 from_m, Vec3 along_m,
                  float progress_m2) {
    const float length2_m2 = dot(along_m, along_m);
    if (progress_m2 > 0.501f * length2_m2) return;
    const float t = progress_m2 / length2_m2;
    const Vec3 rest_m = from_m - along_m * t;
    const float distance2_m2 =
        carefully_ ? careful_distance2(p_m_, vec(samples_[sample]), vec(samples_[neighbour]), t)
                   : dot(rest_m, rest_m);
    if (distance2_m2 < best_.distance2_m2) keep({distance2_m2, sample, neighbour, t});
  }

  // The radius is rounded up by more than the search loses in comparing squares.
  void keep(const Foot& foot) {
    best_ = foot;
    radius_m_ = math::square_root(foot.distance2_m2) * (1.0f + 0x1p-20f);
  }

  const Sample* samples_;
  uint32_t count_;
  bool carefully_;
  Vec3 p_m_;
  float radius_m_ = 0x1p62f;  // more than any distance that comes here
  Foot best_{FLT_MAX, 0, 1, 0.0f};
};

Closest answer(const View& curve, Vec3 p_m, query::Budget budget, query::Hint& hint) {
  ClosestFoot visitor(curve, p_m);
  if (hint.place < curve.segment_count())
    visitor.begin(foot_on_segment(curve, p_m, hint.place, visitor.carefully()));
  TreeSearch<ClosestFoot> search(curve, p_m, budget.steps, visitor);
  const bool complete = search.run();

  Closest closest = answer_at(curve, visitor.best());
  float lower_m = rounded_down(closest.distance_m, curve.nodes()[0].reach_m, visitor.carefully());
  if (!complete) {
    const float pending_m = search.pending_m(), carried_m = query::carry(hint, p_m).lower_m;
    const float known_m = pending_m > carried_m ? pending_m : carried_m;
    if (known_m < lower_m) lower_m = known_m;
  }
  closest.certificate.lower_m = lower_m > 0.0f ? lower_m : 0.0f;
  closest.certificate.steps = search.steps();
  closest.certificate.exact = complete;
  hint.place = closest.segment;
  hint.position_m = p_m;
  hint.lower_m = closest.certificate.lower_m;
  hint.sign = 0;
  return closest;
}

// So far away that the first sample is as near as any other point, to 2^-28.
Closest answer_beyond(const View& curve, Vec3 p_m, query::Hint& hint) {
  Closest closest = answer_at(curve, {0.0f, 0, 1, 0.0f});
  const float scaled = math::length((p_m - closest.point_m) * 0x1p-70f);
  const bool fits = scaled < 0x1.ffffp57f;
  closest.distance_m = fits ? scaled * 0x1p70f : FLT_MAX;
  closest.certificate = {closest.distance_m * (1.0f - 6.0f * kUnit), 1, fits, 0};
  hint = {0, p_m, closest.certificate.lower_m, 0};
  return closest;
}

Closest answer_nothing(const View& curve, query::Hint& hint) {
  Closest closest = answer_at(curve, {0.0f, 0, 1, 0.0f});
  closest.distance_m = FLT_MAX;
  hint.lower_m = 0;
  return closest;
}

}  // namespace

Closest closest_point(const View& curve, Vec3 p_m, query::Budget budget, query::Hint& hint) {
  if (!math::is_finite(p_m)) return answer_nothing(curve, hint);
  if (!is_near(p_m)) return answer_beyond(curve, p_m, hint);
  return answer(curve, p_m, budget, hint);
}

uint64_t probe_hash(const View& curve, core::Span<const query::ProbePoint> points) {
  core::Hash hash;
  query::Hint hint;
  for (const query::ProbePoint& p : points) {
    const Closest c = closest_point(curve, {p.x_m, p.y_m, p.z_m}, query::kUnlimited, hint);
    const float values[] = {c.distance_m, c.point_m.x, c.point_m.y,
                            c.point_m.z,  c.tangent.x, c.tangent.y,
                            c.tangent.z,  c.arc,       c.certificate.lower_m};
    for (const float value : values) hash.add(math::bits_of(value));
    hash.add(c.segment);
    hash.add(c.certificate.steps);
  }
  return hash.value();
}

}  // namespace firmtouch::curve
