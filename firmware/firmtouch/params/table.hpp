#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"

// Every number that a person may set, in one table: scenario files, the link and the record name a
// parameter by its row. Append-only: a row's index is in every log.
namespace firmtouch::params {

enum Index : uint32_t {
  kToolRadius,
  kContactStiffness,
  kContactDamping,
  kGuideStiffness,
  kGuideDamping,
  kGuideSnap,
  kGuideRelease,
  kForceLimit,
  kSlewLimit,
  kRampIn,
  kVelocityFilter,
  kTickPeriod,
  kLateRatio,
  kMaxSpeed,
  kCountsPerMetreX,
  kCountsPerMetreY,
  kCountsPerMetreZ,
  kOriginX,
  kOriginY,
  kOriginZ,
  kWorkspaceHalfX,
  kWorkspaceHalfY,
  kWorkspaceHalfZ,
  kSceneX,
  kSceneY,
  kSceneZ,
  kMeshSteps,
  kCurveSteps,
  kModelAge,
  kGuideArcPenalty,
  kGuideTunnel,
  kGuideSideX,
  kGuideSideY,
  kGuideSideZ,
  kGuideEnds,
  kGuideDrive,
  kGuideDriveForce,
  kGuideDriveSpeed,
  kSurfaceClosed,
  kSurfaceTurned,
  kCount
};

/// When a parameter may change.
enum class When : uint8_t {
  kAnytime,    // at any tick
  kMotorsOff,  // it bends what position or time means: only while the motors are off
  kMayFall,    // a limit: while the motors are on it may only fall
};

// Most that the rows of the same names take; servo and its guard hold these ceilings as well.
constexpr float kMaxForceLimit_N = 100.0f;
constexpr float kMaxSlewLimit_N_per_s = 1e6f;
constexpr float kMaxTickPeriod_s = 0.1f;

struct Entry {
  const char* name;  // ends in its unit
  const char* unit;  // SI; "1" for a plain number
  float low;         // both ends belong to the range
  float high;
  float initial;
  When when;
  const char* what;
};

extern const Entry kTable[kCount];

/// A value for every row; begins with the initial ones.
struct Values {
  Values();
  float value[kCount];
  float operator[](Index i) const { return value[i]; }
};

/// Sets one value.
/// Result: false, and nothing changed, for an index outside the table, NaN, or a value out of
/// range.
bool set(Values& values, uint32_t index, float value);

/// Row of a name that ends with a zero.
/// Result: kCount where there is none.
uint32_t find(const char* name);

/// One number for names, units, ranges, defaults and their order: two programs with the same one
/// mean the same by an index.
/// Bounds: about 4,000 table steps; not for a tick.
uint64_t table_hash();

}  // namespace firmtouch::params
