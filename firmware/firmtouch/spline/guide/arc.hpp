#pragma once
// Lengths along the pieces of a guide, for .cpp files of this module only.
#include "firmtouch/spline/curve/point.hpp"
#include "firmtouch/spline/guide/view.hpp"
#include "firmtouch/spline/numbers.hpp"

namespace firmtouch::spline {

static inline CurvePoint evaluate_on(const View& model, uint32_t piece, float s) {
  return evaluate(model.pieces()[piece], model.coefficients().data(), s);
}

/// In the model's frame.
static inline math::Vec3 position_of(const View& model, uint32_t piece, float s) {
  return vec3_at(model.pieces()[piece].origin_m) + evaluate_on(model, piece, s).x;
}

static inline float speed_of(const View& model, uint32_t piece, float s) {
  return math::length(evaluate_on(model, piece, s).d1);
}

/// Length of a part by three points (Gauss).
static inline float interval_length_m(const View& model, uint32_t piece, float low, float high) {
  const float middle = 0.5f * (low + high), half = 0.5f * (high - low);
  const float aside = half * 0.77459667f;
  return half * (0.5555556f * (speed_of(model, piece, middle - aside) +
                               speed_of(model, piece, middle + aside)) +
                 0.8888889f * speed_of(model, piece, middle));
}

/// Lengths within a part: a cubic between its stored ends, with the curve's own speeds there, no
/// faster than keeps it from turning back. `t` goes from 0 to 1 over the part.
struct ArcCubic {
  float first_m, rise_m, from_m, bow_m;
  float square_m() const { return rise_m - from_m - bow_m; }
  float at_m(float t) const {
    const float risen_m = t * (from_m + t * (square_m() + t * bow_m));
    return first_m + (risen_m > 0.0f ? (risen_m < rise_m ? risen_m : rise_m) : 0.0f);
  }
};

/// Two points are evaluated.
static inline ArcCubic arc_cubic_of(const GuideView& guide, uint32_t piece, uint32_t interval) {
  ArcCubic arc;
  arc.first_m = guide.arcs()[piece * guide.intervals() + interval];
  arc.rise_m = guide.arcs()[piece * guide.intervals() + interval + 1] - arc.first_m;
  const float step = 2.0f / static_cast<float>(guide.intervals());
  const float low = step * static_cast<float>(interval) - 1.0f;
  arc.from_m = speed_of(guide.model(), piece, low) * step;
  float to_m = speed_of(guide.model(), piece, low + step) * step;
  if (!(arc.from_m < 3.0f * arc.rise_m)) arc.from_m = 3.0f * arc.rise_m;
  if (!(to_m < 3.0f * arc.rise_m)) to_m = 3.0f * arc.rise_m;
  arc.bow_m = arc.from_m + to_m - 2.0f * arc.rise_m;
  return arc;
}

/// The part that holds a place of a piece, and where in it.
static inline uint32_t interval_at(const GuideView& guide, float s, float& t) {
  const float at = 0.5f * (s + 1.0f) * static_cast<float>(guide.intervals());
  uint32_t interval = at > 0.0f ? static_cast<uint32_t>(at) : 0;
  if (interval >= guide.intervals()) interval = guide.intervals() - 1;
  t = at - static_cast<float>(interval);
  t = t > 0.0f ? (t < 1.0f ? t : 1.0f) : 0.0f;
  return interval;
}

/// Lengths to places that follow each other: the last part is kept.
class Arcs {
 public:
  explicit Arcs(const GuideView& guide) : guide_(guide) {}

  void take(uint32_t piece, uint32_t interval) {
    if (is_of(piece, interval)) return;
    cubic_ = arc_cubic_of(guide_, piece, interval);
    piece_ = piece;
    interval_ = interval;
  }
  float at_m(uint32_t piece, float s) {
    float t;
    take(piece, interval_at(guide_, s, t));
    return cubic_.at_m(t);
  }
  bool is_of(uint32_t piece, uint32_t interval) const {
    return piece_ == piece && interval_ == interval;
  }
  uint32_t interval() const { return interval_; }
  const ArcCubic& cubic() const { return cubic_; }

 private:
  const GuideView& guide_;
  uint32_t piece_ = UINT32_MAX, interval_ = 0;
  ArcCubic cubic_{};
};

}  // namespace firmtouch::spline
