#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/device/cartesian.hpp"
#include "firmtouch/opener.hpp"
#include "firmtouch/params/table.hpp"
#include "firmtouch/record/tick.hpp"
#include "firmtouch/scene/curve_guide.hpp"
#include "firmtouch/scene/mesh_contact.hpp"
#include "firmtouch/servo/clock_watch.hpp"
#include "firmtouch/servo/guard.hpp"
#include "firmtouch/servo/step.hpp"

namespace firmtouch {

/// One composition of the rooms among possible ones: a Cartesian device of three axes feels one
/// mesh by the sphere at its tip and is guided along one curve. Its size is the RAM that it takes:
/// no heap, nothing static. Controllers are independent of each other and may share an asset.
class Controller {
 public:
  /// Starts to open an asset, which must outlive the controller; motors stay off until it is
  /// proven. Everything that ran before is forgotten, parameters and faults included. Not while
  /// tick() may interrupt.
  void begin(core::Bytes asset, Selection selection = {});

  /// Goes on opening, by about `budget` bytes or what takes as long (opener.hpp). For the main loop; tick()
  /// may interrupt it.
  /// Result: true when finished; verdict() then says whether the motors may be enabled.
  bool work(uint32_t budget) { return opener_.work(budget); }

  /// begin() and work() until finished.
  core::Verdict open(core::Bytes asset, Selection selection = {});

  core::Verdict verdict() const { return opener_.verdict(); }
  bool is_ready() const { return opener_.is_ready(); }

  /// As right after begin(), without opening the asset again: initial parameters, no faults,
  /// nothing felt yet. Not while tick() may interrupt.
  void reset();

  /// A function of the controller's state and `input` alone: calls no HAL, reads no clock. Every
  /// field of `output` is set and finite. A parameter changes only by `input.command`, so that the
  /// record holds all that a replay needs.
  /// The motors come on only after kLineEnable was seen low in a tick since reset() with the asset
  /// ready: a line that stands high from the beginning, as after a watchdog's reset, enables
  /// nothing.
  /// Bounds: two queries of at most mesh_steps and curve_steps; callable from an interrupt; not
  /// re-entrant.
  void tick(const record::TickInput& input, record::TickOutput& output);

  const params::Values& values() const { return live_.values; }
  const mesh::View& mesh() const { return opener_.mesh(); }
  const curve::View& curve() const { return opener_.curve(); }
  /// Tells assets apart; 0 before the asset's frame is proven.
  uint32_t asset_crc() const { return opener_.container().crc(); }

 private:
  // All that a tick hands to the next one.
  struct Live {
    params::Values values;
    servo::ClockState clock;
    device::State device;
    scene::MeshTouch touch;
    scene::GuideTouch guide;
    servo::LocalModel model;
    servo::State servo;
    servo::GuardState guard;
    bool enable_was_low = false;  // in a tick with the asset ready
  };
  bool take_parameter(const record::TickInput& input);
  void feel(math::Vec3 position_m, bool ready);
  void tell_scene(record::TickOutput& output) const;

  Opener opener_;
  Live live_;
};

}  // namespace firmtouch
