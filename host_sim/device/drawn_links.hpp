#pragma once
#include <vector>

#include "firmtouch/device/stored_linkage.hpp"
#include "host_sim/device/linkage_body.hpp"

namespace firmtouch::host_sim {

/// What a stored linkage is for a picture: its lengths, ranges and limits, without masses.
LinkageDevice kinematics_of(const device::StoredLinkage& stored);

/// Joints of a linkage for a picture: base and elbow of each chain, which ends at the tip.
std::vector<Vec> joints_m(const LinkageDevice& device, const JointMotion& at);

/// Angles of a linkage whose tip goes along a path.
class TipFollower {
 public:
  explicit TipFollower(const LinkageDevice& device) : device_(device) {}
  const LinkageDevice& device() const { return device_; }
  /// Result: null where the tip cannot be there.
  const JointMotion* at(Vec tip_m);

 private:
  LinkageDevice device_;
  JointMotion motion_;
  bool is_found_ = false;
};

}  // namespace firmtouch::host_sim
