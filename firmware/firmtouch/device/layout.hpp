#pragma once
#include <stddef.h>
#include <stdint.h>

#include "firmtouch/core/span.hpp"

// Byte layout of a linkage in an asset (tools/FORMAT.md, section 3d). Little-endian.
namespace firmtouch::device {

constexpr uint32_t kLinkageSection = 0x7001;

enum Kind : uint32_t { kFiveBar = 1, kSerialArm = 2, kDelta = 3 };

// Bits of LinkageLayout::flags.
constexpr uint32_t kFlagTip = 1u << 0;            // is_tip_left, is_tip_above
constexpr uint32_t kFlagParallelogram = 1u << 1;  // of a serial arm
constexpr uint32_t kFlagForcedWalls = 1u << 2;    // motors come on beside walls that are not stable

struct JointLayout {
  float counts_per_rad, zero_rad, low_rad, high_rad;
};

/// A linkage with its joints, limits and weight. Words that a kind does not use are 0.
struct LinkageLayout {
  uint32_t kind;
  uint32_t joints;
  uint32_t flags;
  float least_mass_kg;  // of the tip in any direction, where it has the whole force; 0: not known
  float length_m[6];    // five-bar: proximal, distal; serial arm: links; delta: upper, lower
  float offset_m[3];    // base; offset, height; base radius, platform radius, side
  JointLayout joint[3];
  float max_torque_Nm[3];
  float torque_rise_s;  // from no torque to the largest
  float max_speed_rad_per_s;
  float full_from, gone_at;  // reciprocal condition
  float elbow_mass_kg[3];    // weight at the ends of the driven links; serial arm: elbow, shoulder
  float tip_mass_kg;         // and at the tip
  float gravity_mps2[3];     // linkage's frame
  float carried_share;       // of the torque limits: the most that carries weight; 0: none does
};
/// How the joints are homed, behind the linkage in the same section, so that a program without part
/// `homing` rejects it (R712). Words that a way of homing does not use are 0.
struct HomingLayout {
  uint32_t by;            // HomeBy: kKnownPose or kStops
  float torque_Nm[3];     // by stops: the most that is applied
  float speed_rad_per_s;  // by stops
  float margin_rad;       // by which the travel between the stops may miss the range
  float pose_rad[3];      // by a known pose: where the joints stand
};
static_assert(sizeof(LinkageLayout) == 160 && offsetof(LinkageLayout, max_torque_Nm) == 100);

struct HomedLinkageLayout {
  LinkageLayout linkage;
  HomingLayout homing;
};
static_assert(sizeof(HomedLinkageLayout) == 196);

/// Index pulses of the joints, behind the linkage and its homing by stops in the same section, so
/// that a program without part `index_pulses` rejects it (R712). 0 of a joint that is missing.
struct IndexLayout {
  float index_rad[3];   // the angle of a pulse
  float period_rad[3];  // from one to the next
  float within_rad;     // by which a pulse may be off once the joints are homed

  static bool is_in(core::Bytes section);  // whether a section ends with it
};
static_assert(sizeof(IndexLayout) == 28);

/// Second encoders of the joints, behind the linkage and its homing in the same section, so that a
/// program without part `second_encoders` rejects it (R712).
struct SecondEncodersLayout {
  float counts_per_rad[3];  // 0: the joint has none
  float within_rad;         // by which the two may differ

  static bool is_in(core::Bytes section);  // whether a section ends with it
};
static_assert(sizeof(SecondEncodersLayout) == 16);

/// Thermal limits of the motors, behind all else in the same section, so that a program without
/// part `derating` rejects it (R712). Both 0 of a joint without one.
struct DeratingLayout {
  float continuous_Nm[3];  // the torque that a motor may have for ever
  float time_s[3];         // thermal time constant of its winding

  static bool is_in(core::Bytes section);  // whether a section ends with it
};
static_assert(sizeof(DeratingLayout) == 24);

/// Springs that balance the weight, and friction, behind all else in the same section, so that a
/// program without part `compensation` rejects it (R712). 0 where a joint has none.
struct CompensationLayout {
  uint32_t tag;  // kCompensationTag
  float spring_Nm_per_rad[3];
  float relaxed_rad[3];  // the angle at which a spring has no torque
  float friction_Nm[3];  // Coulomb friction
  float friction_share;  // of it that the motors carry; 0: none
  float friction_fade_rad_per_s;

  static bool is_in(core::Bytes section);  // whether a section ends with it
};
static_assert(sizeof(CompensationLayout) == 48);

constexpr uint32_t kCompensationTag = 0x504D4F43;  // "COMP"; as a float 1.4e10

}  // namespace firmtouch::device
