#pragma once
#include "firmtouch/controller/derated_device.hpp"
#include "firmtouch/device/compensation.hpp"

namespace firmtouch {

/// Any device of a linkage whose weight is balanced by springs, where the asset says so (`spring_0`
/// in a device file): its motors carry the weight less the springs' torques.
template <class Base>
class CompensatedDevice
    : public DeviceWithPart<Base, device::Compensation, NoState, device::before_compensation> {
  using Parted = DeviceWithPart<Base, device::Compensation, NoState, device::before_compensation>;

 public:
  bool push(const params::Values& values, Push push, servo::GuardState& guard,
            record::TickOutput& output) {
    math::Vec3 spring_Nm;
    if (this->part_.is_open()) {
      spring_Nm = device::spring_torques_Nm(this->part_, this->angle_rad());
      push.spring_Nm = &spring_Nm;
    }
    return Parted::push(values, push, guard, output);
  }

  const device::Compensation& compensation() const { return this->part_; }
};

}  // namespace firmtouch
