#pragma once
#include <stdint.h>

#include "firmtouch/curve/guided_point.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/local_model.hpp"

// Virtual fixtures along a curve. scene/curve_guide.hpp and scene/spline_guide.hpp apply them to
// sampled curves and to spline curves.
namespace firmtouch::scene {

/// What an open curve's guide does with a tool that is past an end.
enum class Ends : uint8_t {
  kHold,      // pulls it back to the end
  kRelease,   // releases it; holds it again once it was beyond snap_m or came that far back
  kContinue,  // continues at the other end if that is nearer, for a path that ends where it begins
};

/// Force along the curve, in the direction of its samples.
struct Drive {
  enum class Kind : uint8_t {
    kFree,
    kPush,  // force_N all the way; no force past the end that it pushes to
    kLead,  // a spring to a carriage that moves at speed_mps, and waits if force_N is too small
  };
  Kind kind = Kind::kFree;
  float force_N = 0;    // kPush: negative against the samples; kLead: the largest, without sign
  float speed_mps = 0;  // kLead: 0 holds the position where the guide began to hold
  float tick_period_s = 0;
};

/// The pose of a curve (curve frame to device frame), how the guide pulls, and when it holds and
/// releases.
struct Guide {
  math::RigidTransform pose;
  Material material;
  float snap_m = 0;     // nearer than this, the guide holds the tool
  float release_m = 0;  // farther than this, and than snap_m, it releases it
  float tunnel_m = 0;   // no force nearer than this
  // Cost of a jump along the curve, in metres of distance per metre of length: keeps the guide on
  // its part where the curve passes near itself. 0: always the nearest part. 0.1 holds well and is
  // hardly noticed at corners. From 1 on, sharp corners hold the tool back until it is released.
  float arc_penalty = 0;
  // Device frame; any length from 1e-3 on. The tool may leave the curve freely in this direction:
  // the guide is the edge of a ruler. Zero: the guide pulls from all sides.
  math::Vec3 free_side;
  Ends ends = Ends::kHold;
  Drive drive;
};

/// State of a (tool, guide) pair from tick to tick, and the result of its last query. The caller
/// owns one a pair.
struct GuideTouch {
  curve::Closest closest;  // curve frame; distance_m is the deviation; of a spline, segment = piece
  float progress_m = 0;    // along the curve since the guide holds, rounds of a closed one included
  float ahead_m = 0;       // of the drive's carriage, from the closest point
  bool is_held = false;
  bool is_off_end = false;  // released at an end
};

}  // namespace firmtouch::scene
