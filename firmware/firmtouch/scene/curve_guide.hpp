#pragma once
#include <stdint.h>

#include "firmtouch/curve/guided_point.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/local_model.hpp"
#include "firmtouch/spline/guided_point.hpp"

namespace firmtouch::scene {

/// What an open curve's guide does with a tool that is past an end.
enum class Ends : uint8_t {
  kHold,     // pulls it back to the end
  kRelease,  // lets go; takes hold again once the tool was beyond snap_m, or that far back along it
  kGoOn,     // goes on at the other end where that is nearer, for a path that ends where it begins
};

/// What a guide does along its curve, in the direction of its samples.
struct Drive {
  enum class Kind : uint8_t {
    kFree,
    kPush,  // by force_N all the way; no force past the end that it pushes to
    kLead,  // by a carriage that goes along at speed_mps and waits where force_N does not suffice
  };
  Kind kind = Kind::kFree;
  float force_N = 0;    // kPush: negative against the samples; kLead: the most, its sign is nothing
  float speed_mps = 0;  // kLead: 0 holds the place where the guide took hold
  float tick_period_s = 0;
};

/// A curve, where it lies (pose: curve frame to device frame), how it pulls, and when it takes hold
/// and lets go.
struct CurveGuide {
  const curve::View* curve = nullptr;         // sampled; or, where that is not open,
  const spline::GuideView* spline = nullptr;  // of splines
  math::RigidTransform pose;
  Material material;
  float snap_m = 0;     // nearer than this, the guide takes hold
  float release_m = 0;  // farther than this, and than snap_m, it lets go
  float tunnel_m = 0;   // nearer than this nothing is felt
  // What a jump along the curve costs, in metres of distance a metre of the way: keeps the guide on
  // its part where the curve passes near itself. 0: on to whatever is nearest. 0.1 holds well and is
  // hardly felt at corners; from 1 on, sharp corners hold the tool back until it is torn off.
  float arc_penalty = 0;
  // Device frame; any length from 1e-3 on. A direction in which the tool may leave the curve freely:
  // the guide is then the edge of a ruler, and pulls back in the direction itself only. None: from all
  // sides.
  math::Vec3 free_side;
  Ends ends = Ends::kHold;
  Drive drive;
};

/// What a (tool, guide) pair remembers from tick to tick, and what its last query said. The caller
/// owns one a pair.
struct GuideTouch {
  curve::Following following;
  spline::Following spline_following;
  curve::Closest closest;  // curve frame; distance_m is the deviation; of a spline segment = piece
  float progress_m = 0;    // along the curve since the guide took hold, rounds of a closed one too
  float ahead_m = 0;       // of the drive's carriage, from the closest point on
  bool is_held = false;
  bool is_off_end = false;  // let go at an end
};

/// Ties the tool at `position_m` (device frame) to the curve, across it only: along it the tool is
/// free, or driven. At a corner, and past an end that holds, the pull is to that point itself, so that
/// the force has no jump. Which part of the curve it is tied to: curve::follow(), spline::follow().
/// Bounds: one of the two of `budget`, and about 300 instructions; re-entrant for different
/// touches.
/// Result: a sound model where the material is sound; numbers of the guide that are NaN count as 0.
///         Without a drive no force does work on a tool that comes back to where it was (beside the
///         snap, which gives stiffness snap^2 / 2); a drive gives at most its force times the way.
void follow_curve(const CurveGuide& guide, math::Vec3 position_m, query::Budget budget,
                  GuideTouch& touch, servo::LocalModel& model);

}  // namespace firmtouch::scene
