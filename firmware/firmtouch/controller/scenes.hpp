#pragma once
#include <stdint.h>

#include "firmtouch/controller/loaders.hpp"

namespace firmtouch {

/// An asset, and the parts that are loaded from it.
template <class Trust, class Device, class Guide, class SurfaceList>
struct LoadedScene {
  void begin(core::Bytes asset, Selection selection) {
    loaders.begin(asset, selection, device, guide, surfaces);
  }
  bool work(uint32_t units) { return loaders.work(units, device, guide, surfaces); }
  void reset() {
    device.reset();
    surfaces.reset();
    guide.reset();
  }

  Loaders<Trust, Device, Guide, SurfaceList> loaders;
  SurfaceList surfaces;
  Guide guide;
  Device device;
};

/// The scene of a controller that keeps its asset: the default.
template <class Scene>
class OneScene {
 public:
  Scene& active() { return scene_; }
  const Scene& active() const { return scene_; }
  static constexpr bool swap() { return false; }

 private:
  Scene scene_;
};

/// Two scenes: the main loop loads the next asset while ticks use the other one. For hot swap; the
/// RAM of a second set of views.
template <class Scene>
class TwoScenes {
 public:
  Scene& active() { return scene_[at()]; }
  const Scene& active() const { return scene_[at()]; }
  Scene& next() { return scene_[1 - at()]; }
  const Scene& next() const { return scene_[1 - at()]; }
  /// The device goes on as it is, so both assets must store the same linkage.
  bool can_swap() const {
    return next().loaders.is_ready() && next().device.is_same(active().device);
  }
  /// Servo interrupt, or while it does not run. Result: false if it cannot.
  bool swap() {
    if (!can_swap()) return false;
    next().reset();
    next().device.continue_as(active().device);
    __atomic_store_n(&at_, static_cast<uint8_t>(1 - at()), __ATOMIC_RELEASE);
    return true;
  }

 private:
  uint32_t at() const { return __atomic_load_n(&at_, __ATOMIC_ACQUIRE); }

  Scene scene_[2];
  uint8_t at_ = 0;
};

}  // namespace firmtouch
