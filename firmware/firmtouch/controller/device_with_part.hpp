#pragma once
#include "firmtouch/controller/any_device.hpp"

namespace firmtouch {

/// The state of a part without one.
struct NoState {};

/// A device, and a part that the asset may store behind what `Base` reads of its section.
/// `PartState` is what ticks leave of it, anew after reset().
template <class Base, class Part, class PartState>
class DeviceWithPart : public Base {
 public:
  void close() {
    Base::close();
    part_ = {};
  }
  template <class Trust>
  asset::Progress work(typename Base::State& state, uint32_t units) {
    return this->template work_by<Trust>(
        state, units, [this](core::Bytes section) { return part_.open(section, this->linkage_); });
  }

  void reset() {
    Base::reset();
    part_state_ = {};
  }
  void continue_as(const DeviceWithPart& other) {
    Base::continue_as(other);
    part_state_ = other.part_state_;
  }

 protected:
  /// work(). `open`: proves the part of a section, behind a base that is passed.
  template <class Trust, class Open>
  asset::Progress work_by(typename Base::State& state, uint32_t units, const Open& open) {
    const core::Bytes whole = this->section_;
    this->section_ = Part::before(whole);
    asset::Progress progress = Base::template work<Trust>(state, units);
    this->section_ = whole;
    if (progress.verdict.ok()) progress.verdict = open(whole);
    if (!progress.verdict.ok()) close();
    return progress;
  }

  Part part_;
  PartState part_state_;
};

}  // namespace firmtouch
