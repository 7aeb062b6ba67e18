#pragma once
// Lengths along the pieces of a guide, for .cpp files of this room only.
#include "firmtouch/spline/evaluation.hpp"
#include "firmtouch/spline/guide_view.hpp"

namespace firmtouch::spline {

static inline void point_of(const View& model, uint32_t piece, float s, CurvePoint& point) {
  evaluate(model.pieces()[piece], model.coefficients().data(), s, point);
}

/// In the model's frame.
static inline math::Vec3 place_of(const View& model, uint32_t piece, float s) {
  CurvePoint point;
  point_of(model, piece, s, point);
  return vec3_at(model.pieces()[piece].origin_m) + point.x;
}

static inline float speed_of(const View& model, uint32_t piece, float s) {
  CurvePoint point;
  point_of(model, piece, s, point);
  return math::length(point.d1);
}

/// Length of a part by three points (Gauss).
static inline float part_length_m(const View& model, uint32_t piece, float low, float high) {
  const float middle = 0.5f * (low + high), half = 0.5f * (high - low);
  const float aside = half * 0.77459667f;
  return half * (0.5555556f * (speed_of(model, piece, middle - aside) +
                               speed_of(model, piece, middle + aside)) +
                 0.8888889f * speed_of(model, piece, middle));
}

/// By a cubic between the stored ends of a part, with the curve's own speeds there, no faster than
/// keeps it from turning back.
static inline float arc_m_at(const GuideView& guide, uint32_t piece, float s) {
  const float parts = static_cast<float>(guide.parts());
  const float at = 0.5f * (s + 1.0f) * parts;
  uint32_t part = at > 0.0f ? static_cast<uint32_t>(at) : 0;
  if (part >= guide.parts()) part = guide.parts() - 1;
  const float first_m = guide.arcs()[piece * guide.parts() + part];
  const float rise_m = guide.arcs()[piece * guide.parts() + part + 1] - first_m;
  const float step = 2.0f / parts, low = step * static_cast<float>(part) - 1.0f;
  float t = at - static_cast<float>(part);
  t = t > 0.0f ? (t < 1.0f ? t : 1.0f) : 0.0f;
  float from_m = speed_of(guide.model(), piece, low) * step;
  float to_m = speed_of(guide.model(), piece, low + step) * step;
  if (!(from_m < 3.0f * rise_m)) from_m = 3.0f * rise_m;
  if (!(to_m < 3.0f * rise_m)) to_m = 3.0f * rise_m;
  const float bow_m = from_m + to_m - 2.0f * rise_m;
  const float risen_m = t * (from_m + t * (rise_m - from_m - bow_m + t * bow_m));
  return first_m + (risen_m > 0.0f ? (risen_m < rise_m ? risen_m : rise_m) : 0.0f);
}

}  // namespace firmtouch::spline
