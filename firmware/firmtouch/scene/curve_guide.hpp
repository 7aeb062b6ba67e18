#pragma once
#include <stdint.h>

#include "firmtouch/curve/guided_point.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/local_model.hpp"
#include "firmtouch/spline/guided_point.hpp"

namespace firmtouch::scene {

/// What the guide of an open curve does with a tool beyond an end.
enum class Ends : uint8_t {
  kHold,     // pulls the tool back to the end
  kRelease,  // lets go; takes hold again after the tool was beyond snap_m, or that far back along
             // it
  kGoOn,     // continues at the other end if that is nearer, for a path that ends where it begins
};

/// Force along the curve, in the direction of its samples.
struct Drive {
  enum class Kind : uint8_t {
    kFree,
    kPush,  // constant force_N; none beyond the end that it pushes to
    kLead,  // spring to a carriage that moves at speed_mps and waits if force_N does not suffice
  };
  Kind kind = Kind::kFree;
  float force_N = 0;    // kPush: negative against the samples; kLead: largest force, sign ignored
  float speed_mps = 0;  // kLead: 0 holds the tool where the guide took hold
  float tick_period_s = 0;
};

/// A curve, its pose (curve frame to device frame), its material, and when it takes hold and lets
/// go. NaN in any of its numbers counts as 0.
struct CurveGuide {
  const curve::View* curve = nullptr;         // a sampled curve; if null or not open:
  const spline::GuideView* spline = nullptr;  // a NURBS curve
  math::RigidTransform pose;
  Material material;
  float snap_m = 0;     // nearer than this, the guide takes hold
  float release_m = 0;  // farther than this, and than snap_m, it lets go
  float tunnel_m = 0;   // nearer than this there is no force across the curve
  // Penalty on a change of arc, in metres of distance a metre along the curve. It keeps the guide
  // on its stretch where the curve passes itself. 0: always the closest point. 0.1: holds well,
  // little drag at corners. From 1 on, sharp corners hold the tool until it is torn off
  // (curve/README.md).
  float arc_penalty = 0;
  // One-sided guide: direction in which the tool may leave the curve freely, like the edge of a
  // ruler. Device frame, any length from 1e-3 on; 0: the guide pulls from all sides.
  math::Vec3 free_side;
  Ends ends = Ends::kHold;
  Drive drive;
};

/// State of a (tool, guide) pair between ticks, and its last answer. The caller owns one a pair.
struct GuideTouch {
  curve::Following following;
  spline::Following spline_following;
  curve::Closest closest;  // curve frame; distance_m is the deviation; of a spline segment = piece
  float progress_m = 0;  // along the curve since the guide took hold, laps of a closed one included
  float ahead_m = 0;     // how far the drive's carriage is ahead of the closest point
  bool is_held = false;
  bool is_off_end = false;  // released at an end
};

/// Ties the tool at `position_m` (device frame) to the curve, across it only. Along the curve the
/// tool is free, or driven. At a corner, and beyond an end that holds, the pull is toward that
/// point, so the force has no jump. curve::follow() and spline::follow() choose the stretch of the
/// curve.
/// Bounds: one of these queries with `budget`, and about 300 instructions; re-entrant for different
///         touches.
/// Result: a sound model if the material is sound.
/// Energy: without a drive no force does work on a tool that returns to its position, except the
///         snap, which gives stiffness * snap^2 / 2. A drive gives at most its force times the way.
void follow_curve(const CurveGuide& guide, math::Vec3 position_m, query::Budget budget,
                  GuideTouch& touch, servo::LocalModel& model);

}  // namespace firmtouch::scene
