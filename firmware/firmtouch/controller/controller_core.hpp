#pragma once
#include <stdint.h>

#include "firmtouch/controller/cartesian_device.hpp"
#include "firmtouch/controller/model.hpp"
#include "firmtouch/core/handoff.hpp"
#include "firmtouch/params/compose.hpp"
#include "firmtouch/params/rows.hpp"
#include "firmtouch/record/tick.hpp"
#include "firmtouch/servo/clock_watch.hpp"
#include "firmtouch/servo/fault.hpp"
#include "firmtouch/servo/step.hpp"

namespace firmtouch {

/// What a tick depends on of the asset.
struct AssetStatus {
  bool is_ready = false;
  uint32_t faults = 0;  // latched in a tick that enables
};

/// The part of a controller that is the same for every composition: parameters, clock, servo, the
/// guard's memory, record output, and the hand-over of local models at two rates.
class ControllerCore {
 public:
  using Parameters = params::Groups<params::SafetyRows, params::SceneRows>;

  /// A tick between its parts.
  struct Tick {
    device::Sample sample;
    ModelRequest request;
    servo::StepInput step;
  };
  struct ModelTask {
    ModelRequest request;
    params::Values values;  // of that tick
  };

  explicit ControllerCore(params::Table table) : table_(table) { reset(); }

  params::Table table() const { return table_; }
  const params::Values& values() const { return values_; }

  /// Initial parameters, no faults. Not while a tick may interrupt.
  void reset();

  /// The first part of a tick: command, clock.
  Tick begin_tick(const record::TickInput& input, const AssetStatus& asset,
                  record::TickOutput& output);
  /// What the device reads of tick.sample.
  static void locate(const device::Reading& tool, Tick& tick);
  /// The servo stays off: the device is not homed, or its homing failed.
  /// Result: whether the motors may home it, if there is no fault.
  static bool hold(Tick& tick, bool has_failed) {
    const bool enable = tick.step.enable;
    tick.step.enable = false;
    if (has_failed) tick.step.reported |= servo::kFaultHoming;
    return enable;
  }
  /// The motors go off until kFlagEnable was low again.
  void disarm(Tick& tick) { tick.step.enable = live_.enable_was_low = false; }
  bool has_no_fault() const { return live_.servo.faults == 0; }
  /// Corrects the energy that the observer is about to count.
  void count_rendered(const Rendered& last);
  /// Result: the result to make of tick.request now; null at two rates, where the request goes out
  /// with the proxy of the model that this tick uses.
  ModelResult* result_of_tick(Tick& tick, uint32_t flags);
  /// The servo: what the motors shall do.
  Push step(const Tick& tick, uint32_t flags, record::TickOutput& output);
  /// The last part: record output. `passed`: what the guard decided on the motors.
  void end_tick(const AssetStatus& asset, const Tick& tick, bool passed,
                record::TickOutput& output);
  servo::GuardState& guard() { return live_.guard; }

  /// At two rates: the flags of the next tick.
  uint32_t model_flags() const;
  /// At two rates, below the servo interrupt: the model to make; null if none was requested.
  const ModelTask* task() const { return models_.requested(); }
  ModelResult& task_result() { return models_.draft(); }
  void finish_task() { models_.made(); }

  /// Begins the model of a request. Of the tick, or of the task, never of both.
  void begin_model(const ModelRequest& request, const params::Values& values, ModelResult& result);

 private:
  // State from tick to tick, except parameters and models.
  struct Live {
    servo::ClockState clock;
    servo::State servo;
    servo::GuardState guard;
    uint32_t model_sequence = 0;
    uint32_t model_tick = 0;
    bool enable_was_low = false;  // in a tick with the asset ready
  };
  bool set_parameter(const record::TickInput& input);

  params::Table table_;
  params::Values values_;
  Live live_;
  core::Handoff<ModelTask, ModelResult> models_;
};

}  // namespace firmtouch
