#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"

// One parameter that a person may set, and tables of them. A controller's table is composed from
// the rows of its parts (params/compose.hpp); scenario files, the link and the record name a
// parameter by its row.
namespace firmtouch::params {

/// When a parameter may change.
enum class When : uint8_t {
  kAnytime,    // at any tick
  kMotorsOff,  // it changes what position or time means: only while the motors are off
  kMayFall,    // a limit: while the motors are on it may only fall
};

/// A row. Rows are written in the order of the constructor; the fields stand without gaps.
struct Entry {
  const char* name = "";  // ends in its unit
  const char* unit = "";  // SI; "1" for a plain number
  const char* what = "";
  float low = 0;  // both ends belong to the range
  float high = 0;
  float initial = 0;
  uint16_t number = 0;  // where its value stands in Values; tables are sorted by it
  When when = When::kAnytime;

  constexpr Entry() = default;
  constexpr Entry(uint16_t its_number, const char* its_name, const char* its_unit, float lowest,
                  float highest, float at_first, When changes, const char* means)
      : name(its_name),
        unit(its_unit),
        what(means),
        low(lowest),
        high(highest),
        initial(at_first),
        number(its_number),
        when(changes) {}
};

// Upper ends of rows; servo and its guard have the same ceilings.
constexpr float kMaxForceLimit_N = 100.0f;
constexpr float kMaxSlewLimit_N_per_s = 1e6f;
constexpr float kMaxTickPeriod_s = 0.1f;
constexpr float kMaxReservoir_J = 1000.0f;

/// Sorted by number, each once.
using Table = core::Span<const Entry>;

/// Numbers of the library's own rows, in the order in which they were added: append-only. In the
/// table of the full controller a number is the row, which is in every log.
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
  kMeshWork,
  kGuideWork,
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
  kFrictionStatic,
  kFrictionDynamic,
  kVelocityEstimator,
  kFrictionSpeed,
  kTickWork,
  kEnergyReservoir,
  kDeviceDamping,
  kFrictionViscous,
  kContactShading,
  kCount
};

/// From here on the numbers of your own parts' rows.
constexpr uint16_t kFirstOwn = 56;
constexpr uint16_t kMaxOwn = 8;
static_assert(kCount <= kFirstOwn);

/// The row of a number, for a tick's command (1 + row): a composed table leaves rows out.
/// Result: table.size() if it has none.
constexpr uint32_t row_of(Table table, uint32_t number) {
  uint32_t row = 0;
  while (row < table.size() && table[row].number != number) ++row;
  return row;
}

/// A value for every number; 0 where the table has no row.
struct Values {
  float value[kFirstOwn + kMaxOwn] = {};
  float operator[](uint32_t number) const { return value[number]; }
};

/// In place: no copy of the values stands on the stack.
void set_initial(Values& values, Table table);

/// Sets the value of one row.
/// Result: false, and nothing changed, for a row outside the table, NaN, or a value out of range.
bool set(Values& values, Table table, uint32_t row, float value);

/// One number for names, units, ranges, defaults and their order: two programs with the same one
/// mean the same by a row.
/// Bounds: about 4,000 table steps; not for a tick.
uint64_t table_hash(Table table);

}  // namespace firmtouch::params
