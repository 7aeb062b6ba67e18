#pragma once
#include <stdint.h>

#include "firmtouch/controller/controller_core.hpp"
#include "firmtouch/controller/first_of.hpp"
#include "firmtouch/controller/loaders.hpp"

namespace firmtouch {

/// A device that touches a surface by the sphere at its tip and follows a guide. What the type does
/// not name is not linked:
///
///     Controller<Surfaces<MeshSurface>> controller;
///     Controller<Surfaces<FullMesh, SplineSurface>, CurveGuide, AnyDevice> other;
///
/// A CartesianDevice has three axes; AnyDevice is the linkage that the asset stores.
/// Its size is all the RAM that it takes: no heap, nothing static. Controllers are independent of
/// each other and may share an asset.
template <class SurfaceList, class Guide = NoGuide, class Device = CartesianDevice,
          class Trust = asset::Proven>
class Controller {
 public:
  /// The parameters of all parts.
  static constexpr params::Table kTable =
      params::Composed<ControllerCore::Parameters, typename Device::Parameters,
                       typename SurfaceList::Parameters, typename Guide::Parameters>::kTable;

  Controller() : core_(kTable) {}
  Controller(const Controller&) = delete;  // a distance field refers to the mesh in here
  Controller& operator=(const Controller&) = delete;

  /// Starts to open an asset, which must outlive the controller. The motors stay off until it is
  /// proven. Resets all, parameters and faults included. Not while tick() may interrupt.
  void begin(core::Bytes asset, Selection selection = {}) {
    loaders_.begin(asset, selection, device_, guide_, surfaces_);
    reset();
  }

  /// Continues to open, for at most `units` of about 100 instructions (loaders.hpp). For the main
  /// loop; tick() may interrupt it.
  /// Result: true when it ended; verdict() then says whether the motors may be enabled.
  bool work(uint32_t units) { return loaders_.work(units, device_, guide_, surfaces_); }

  /// begin(), then work() until it ends.
  core::Verdict open(core::Bytes asset, Selection selection = {}) {
    begin(asset, selection);
    while (!work(kSliceUnits)) {
    }
    return verdict();
  }

  core::Verdict verdict() const { return loaders_.verdict(); }
  bool is_ready() const { return loaders_.is_ready(); }

  /// The state right after begin(), without opening the asset again. Not while tick() may
  /// interrupt.
  void reset() {
    core_.reset();
    device_.reset();
    surfaces_.reset();
    guide_.reset();
  }

  /// A function of the controller's state and `input`: calls no HAL, reads no clock. Every field of
  /// `output` is set and finite. A parameter changes only by `input.command`, so that the record
  /// holds all that a replay needs.
  /// The motors come on only after a tick since reset() saw kFlagEnable low with the asset ready: a
  /// line that is high from the beginning, as after a watchdog's reset, enables nothing.
  /// At one rate the tick makes the local model. At two, where input.flags has kFlagModelApart,
  /// make_model() makes it. This tick then requests one (kFlagModelWanted), begins to use the one
  /// that was made (kFlagModelTaken), or keeps the last. These are inputs: a log replays.
  /// Bounds: queries that share tick_work, the surface's at most mesh_work, the guide's at most
  /// guide_work; with a base hull others of mesh_work or 1,280; at two rates none. Callable from
  /// an interrupt; not re-entrant.
  void tick(const record::TickInput& input, record::TickOutput& output) {
    const AssetStatus asset = loaders_.status();
    ControllerCore::Tick tick = core_.begin_tick(input, asset, output);
    core_.locate(device_.read(core_.values(), tick.sample, tick.step.clear_faults), tick);
    if constexpr (!Device::kRendersAll) core_.count_rendered(device_.rendered());
    ModelResult* result = core_.result_of_tick(tick, input.flags);
    if (result != nullptr) make_local_model(tick.request, core_.values(), *result);
    const Push push = core_.step(tick, input.flags, output);
    const bool passed = device_.push(core_.values(), push, core_.guard(), output);
    core_.end_tick(asset, tick, passed, output);
  }

  /// Servo interrupt, at two rates: the flags of the next tick, by what make_model() has done.
  uint32_t model_flags() const { return core_.model_flags(); }

  /// Below the servo interrupt, which may interrupt it anywhere; in lock-step and on replay after
  /// each tick. Makes the model that a tick requested, if any.
  /// Bounds: the queries of a tick.
  void make_model() {
    const ControllerCore::ModelTask* task = core_.task();
    if (task == nullptr) return;
    make_local_model(task->request, task->values, core_.task_result());
    core_.finish_task();
  }

  const params::Values& values() const { return core_.values(); }
  /// One of the surface policies.
  template <class P>
  const P& surface() const {
    return surfaces_.template get<P>();
  }
  const Guide& guide() const { return guide_; }
  const Device& device() const { return device_; }
  /// Identifies the asset; 0 before the asset's frame is proven.
  uint32_t asset_crc() const { return loaders_.container().crc(); }

 private:
  void make_local_model(const ModelRequest& request, const params::Values& values,
                        ModelResult& result) {
    core_.begin_model(request, values, result);
    if (!request.can_touch) return;
    surfaces_.touch(request, values, result);
    guide_.follow(request, values, result);
  }

  Loaders<Trust, Device, Guide, SurfaceList> loaders_;
  SurfaceList surfaces_;
  Guide guide_;
  Device device_;
  ControllerCore core_;
};

}  // namespace firmtouch
