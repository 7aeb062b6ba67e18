#pragma once
#include <stdint.h>

#include "firmtouch/controller/controller_core.hpp"
#include "firmtouch/controller/first_of.hpp"
#include "firmtouch/controller/scenes.hpp"

namespace firmtouch {

/// A device that touches a surface by the sphere at its tip and follows a guide. What the type does
/// not name is not linked:
///
///     Controller<Surfaces<MeshSurface>> controller;
///     Controller<Surfaces<FullMesh, SplineSurface>, CurveGuide, AnyDevice> other;
///
/// A CartesianDevice has three axes; AnyDevice is the linkage that the asset stores. With TwoScenes
/// as the last argument the asset can be swapped while ticks run (begin_next()).
/// Its size is all the RAM that it takes: no heap, nothing static. Controllers are independent of
/// each other and may share an asset.
template <class SurfaceList, class Guide = NoGuide, class Device = CartesianDevice,
          class Trust = asset::Proven, template <class> class ScenesOf = OneScene>
class Controller {
  using Scene = LoadedScene<Trust, Device, Guide, SurfaceList>;
  using Scenes = ScenesOf<Scene>;

 public:
  /// The parameters of all parts.
  static constexpr params::Table kTable =
      params::Composed<ControllerCore::Parameters, typename Device::Parameters,
                       typename SurfaceList::Parameters, typename Guide::Parameters>::kTable;

  /// What a tick's flags need.
  static constexpr bool kHasSecondEncoders = Device::kHasSecondEncoders;
  static constexpr bool kHasIndexPulses = Device::kHasIndexPulses;

  [[gnu::noinline]] Controller() : core_(kTable) {}
  Controller(const Controller&) = delete;  // a distance field refers to the mesh in here
  Controller& operator=(const Controller&) = delete;

  /// Starts to open an asset, which must outlive the controller. The motors stay off until it is
  /// proven. Resets all, parameters and faults included. Not while tick() may interrupt.
  void begin(core::Bytes asset, Selection selection = {}) {
    scene().begin(asset, selection);
    reset();
  }

  /// Continues to open, for at most `units` of about 100 instructions (loaders.hpp). For the main
  /// loop; tick() may interrupt it.
  /// Result: true when it ended; verdict() then says whether the motors may be enabled.
  bool work(uint32_t units) { return scene().work(units); }

  /// begin(), then work() until it ends.
  core::Verdict open(core::Bytes asset, Selection selection = {}) {
    begin(asset, selection);
    while (!work(kSliceUnits)) {
    }
    return verdict();
  }

  core::Verdict verdict() const { return scene().loaders.verdict(); }
  bool is_ready() const { return scene().loaders.is_ready(); }

  /// The state right after begin(), without opening the asset again. Not while tick() may
  /// interrupt.
  [[gnu::noinline]] void reset() {
    core_.reset();
    scene().reset();
  }

  /// Hot swap, with TwoScenes. As begin() and work(), for the asset that is to follow; the one that
  /// is touched stays as it is. Both must outlive the controller, or the swap away from them. Main
  /// loop; tick() may interrupt it. Not between a command to swap and its tick.
  void begin_next(core::Bytes asset, Selection selection = {}) {
    scenes_.next().begin(asset, selection);
  }
  bool work_next(uint32_t units) { return scenes_.next().work(units); }
  core::Verdict next_verdict() const { return scenes_.next().loaders.verdict(); }
  uint32_t next_crc() const { return scenes_.next().loaders.container().crc(); }
  /// Whether a tick with record::kCommandSwapAsset will take it. That tick touches the next asset:
  /// contact begins anew, force and parameters go on, so the force makes no step above its slew
  /// limit, except to fall where contact's energy does not pay for it. It is refused while the next
  /// asset is not proven, if it stores another linkage, and at two rates.
  bool can_swap() const { return scenes_.can_swap(); }
  /// The same at once. Not while tick() may interrupt.
  bool swap() { return scenes_.swap(); }

  /// A function of the controller's state and `input`: calls no HAL, reads no clock. Every field of
  /// `output` is set and finite. A parameter changes only by `input.command`, so that the record
  /// holds all that a replay needs.
  /// The motors come on only after a tick since reset() saw kFlagEnable low with the asset ready: a
  /// line that is high from the beginning, as after a watchdog's reset, enables nothing. Nor does
  /// one that was high while a wall was refused.
  /// At one rate the tick makes the local model. At two, where input.flags has kFlagModelApart,
  /// make_model() makes it. This tick then requests one (kFlagModelWanted), begins to use the one
  /// that was made (kFlagModelTaken), or keeps the last. These are inputs: a log replays.
  /// Bounds: queries that share tick_work, the surface's at most mesh_work, the guide's at most
  /// guide_work; with a base hull others of mesh_work or 1,280; at two rates none. Callable from
  /// an interrupt; not re-entrant.
  void tick(const record::TickInput& input, record::TickOutput& output) {
    const bool is_apart = (input.flags & record::kFlagModelApart) != 0;
    const bool is_taken = !is_apart && take_scene_command(input);
    Device& device = scene().device;
    const AssetStatus asset = scene().loaders.status();
    ControllerCore::Tick tick = core_.begin_tick(input, asset, output);
    tick.request.asset = &scene().loaders.container();
    if (is_taken)  // no row has this number
      output.state ^= record::kStateCommandRefused | record::kStateCommandTaken;
    if constexpr (Device::kKnowsWalls)
      if ((input.flags & record::kFlagEnable) != 0) {
        scene::Stiffening by;
        if constexpr (SurfaceList::kHasTextures) by = scene().surfaces.stiffening();
        const uint32_t wall = device.wall_state(core_.values(), by);
        output.state |= wall;
        if ((wall & record::kStateWallRefused) != 0) core_.disarm(tick);
      }
    if constexpr (Device::kComparesEncoders)
      tick.sample.trusted = tick.sample.trusted && device.encoders_agree(tick.sample, input.flags);
    core_.locate(device.read(core_.values(), tick.sample, tick.step.clear_faults), tick);
    if constexpr (!Device::kRendersAll) core_.count_rendered(device.rendered());
    bool homes = false;
    if constexpr (Device::kHomes) {
      if (!device.is_homed()) homes = core_.hold(tick, device.has_failed());
    }
    ModelResult* result = core_.result_of_tick(tick, input.flags);
    if constexpr (SurfaceList::kMoves)
      if (!is_apart) scene().surfaces.advance(core_.values()[params::kTickPeriod]);
    if (result != nullptr) make_local_model(tick.request, core_.values(), *result);
    Push push = core_.step(tick, input.flags, output);
    if constexpr (Device::kHomes) push.may_push |= homes && core_.has_no_fault();
    const bool passed = device.push(core_.values(), push, core_.guard(), output);
    if constexpr (Device::kHomes)
      if (!passed) output.state &= ~record::kStateHoming;  // the guard has stopped the homing
    const uint32_t of_device = output.state;
    core_.end_tick(asset, tick, passed, output);
    if constexpr (SurfaceList::kHasTorque)
      scene().surfaces.put_torque(!is_apart || (input.flags & record::kFlagModelTaken) != 0,
                                  output);
    if constexpr (Device::kHomes)
      output.state = record::without_old_object(output.state, of_device);
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
    return scene().surfaces.template get<P>();
  }
  const Guide& guide() const { return scene().guide; }
  const Device& device() const { return scene().device; }
  /// Identifies the asset; 0 before the asset's frame is proven.
  uint32_t asset_crc() const { return scene().loaders.container().crc(); }
  /// What its coordinates count from (asset::Container).
  math::Vec3 asset_origin_m() const { return scene().loaders.container().origin_m(); }
  core::Bytes asset() const { return scene().loaders.container().bytes(); }

 private:
  Scene& scene() { return scenes_.active(); }
  const Scene& scene() const { return scenes_.active(); }
  // Commands that are no parameter's.
  bool take_scene_command(const record::TickInput& input) {
    if (input.command == record::kCommandSwapAsset) return scenes_.swap();
    if constexpr (SurfaceList::kMoves)
      return scene().surfaces.take_command(input.command, input.command_value);
    return false;
  }
  void make_local_model(const ModelRequest& request, const params::Values& values,
                        ModelResult& result) {
    core_.begin_model(request, values, result);
    if constexpr (SurfaceList::kHasTorque) scene().surfaces.begin_torque();
    if (!request.can_touch) return;
    scene().surfaces.touch(request, values, result);
    scene().guide.follow(request, values, result);
  }

  Scenes scenes_;
  ControllerCore core_;
};

}  // namespace firmtouch
