#pragma once
#include "firmtouch/core/span.hpp"
#include "firmtouch/device/layout.hpp"
#include "firmtouch/device/load.hpp"

// One of the linkages, as an asset stores it: read in place from flash, so that no flipped bit of
// RAM changes a link or a limit.
namespace firmtouch::device {

class StoredLinkage {
 public:
  bool is_open() const { return layout_ != nullptr; }
  /// Pre of what follows: is_open().
  const LinkageLayout& layout() const { return *layout_; }
  FiveBar five_bar() const;
  SerialArm serial_arm() const;
  Delta delta() const;
  JointSettings joints(VelocitySettings velocity) const;
  TorqueLimits limits() const;
  Load load() const;

 private:
  friend core::Verdict open(core::Bytes section, StoredLinkage& to);
  const LinkageLayout* layout_ = nullptr;
};

/// Proves a section of type kLinkageSection; `to` is open where the verdict is passed. The bytes
/// must outlive it. Bounds: constant.
core::Verdict open(core::Bytes section, StoredLinkage& to);

/// As those of the linkage that is stored. Pre: linkage.is_open().
Pose pose_of(const StoredLinkage& linkage, const float (&angle_rad)[kMaxJoints]);
math::Vec3 carrying_torques_Nm(const StoredLinkage& linkage, const float (&angle_rad)[kMaxJoints],
                               const Pose& pose);

}  // namespace firmtouch::device
