#pragma once
#include "firmtouch/device/stored_linkage.hpp"

// What else than weight a linkage's motors carry: springs that balance it, and friction.
namespace firmtouch::device {

/// As an asset stores them, behind all else of the linkage. The tag is beyond the range of every
/// other word of a section.
using Compensation = FurtherPart<CompensationLayout>;
template <>
core::Verdict Compensation::check(core::Bytes section, const StoredLinkage& linkage) const;

/// Torques of the springs on the joints: stiffness x (relaxed angle - angle).
/// Pre: compensation.is_open(). Bounds: constant. Result: finite for angles within 200 rad.
math::Vec3 spring_torques_Nm(const Compensation& compensation,
                             const float (&angle_rad)[kMaxJoints]);

/// Torques that carry a share of friction: share x friction x rate / (|rate| + fade), smooth
/// through rest and nearly 0 there. Whatever the rates are, none exceeds its share, at most 0.8
/// (R721). So on every way the motors give at most that share of what friction takes: joint and
/// torque together are passive, however late and noisy the rates are. A joint at rest stays there.
/// Pre: compensation.is_open(), finite rates. Bounds: constant. Result: finite.
void friction_torques_Nm(const Compensation& compensation,
                         const float (&rate_rad_per_s)[kMaxJoints], float (&torque_Nm)[kMaxJoints]);

}  // namespace firmtouch::device
