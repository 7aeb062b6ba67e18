#pragma once
#include "firmtouch/controller/derated_device.hpp"
#include "firmtouch/device/compensation.hpp"

namespace firmtouch {

/// Any device of a linkage whose weight is balanced by springs, or whose joints have friction,
/// where the asset says so (`spring_0`, `friction_share` in a device file): its motors carry the
/// weight less the springs' torques, and a share of the friction, within the same share of their
/// limits.
template <class Base>
class CompensatedDevice : public DeviceWithPart<Base, device::Compensation, NoState> {
  using Parted = DeviceWithPart<Base, device::Compensation, NoState>;

 public:
  bool push(const params::Values& values, Push push, servo::GuardState& guard,
            record::TickOutput& output) {
    Compensating torques;
    if (this->part_.is_open()) {
      const float rate_rad_per_s[] = {this->rate_rad_per_s(0), this->rate_rad_per_s(1),
                                      this->rate_rad_per_s(2)};
      torques.spring_Nm = device::spring_torques_Nm(this->part_, this->angle_rad());
      device::friction_torques_Nm(this->part_, rate_rad_per_s, torques.friction_Nm);
      push.compensating = &torques;
    }
    return Parted::push(values, push, guard, output);
  }

  const device::Compensation& compensation() const { return this->part_; }
};

}  // namespace firmtouch
