#pragma once
#include <stdint.h>

#include "firmtouch/core/handoff.hpp"
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/device/cartesian.hpp"
#include "firmtouch/opener.hpp"
#include "firmtouch/params/table.hpp"
#include "firmtouch/record/tick.hpp"
#include "firmtouch/scene/curve_guide.hpp"
#include "firmtouch/scene/mesh_contact.hpp"
#include "firmtouch/scene/spline_contact.hpp"
#include "firmtouch/servo/clock_watch.hpp"
#include "firmtouch/servo/guard.hpp"
#include "firmtouch/servo/step.hpp"

namespace firmtouch {

/// One composition of the modules among possible ones: a Cartesian device of three axes feels one
/// surface, a mesh or splines, by the sphere at its tip (beyond reach of a mesh by its distance map,
/// where the asset has one; where time runs out its hull, if there is one), and is guided along one curve, of samples or splines. Its size is the RAM
/// that it takes: no heap, nothing static. Controllers are independent of each other and may share an
/// asset.
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
  /// The motors come on only after kFlagEnable was seen low in a tick since reset() with the asset
  /// ready: a line that stands high from the beginning, as after a watchdog's reset, enables
  /// nothing.
  /// At one rate the local model is made in the tick. At two, where input.flags holds
  /// kFlagModelApart, make_model() makes it elsewhere: this tick asks for one from its own position
  /// where kFlagModelWanted says so, begins to use the one that was made where kFlagModelTaken does,
  /// and goes on with the last one else. Since these are inputs, a log replays at two rates too.
  /// Bounds: two queries of at most mesh_steps and curve_steps, with a hull of the mesh
  /// another one of mesh_steps or 512, at two rates none; callable from an interrupt; not re-entrant.
  void tick(const record::TickInput& input, record::TickOutput& output);

  /// Servo interrupt, at two rates: the lines of the tick that comes, by what make_model() has done.
  uint32_t model_flags() const;

  /// Below the servo interrupt, which may interrupt it anywhere; in lock-step and on replay after
  /// each tick. Makes the model that a tick asked for; nothing where none was.
  /// Bounds: two queries of at most mesh_steps and curve_steps.
  void make_model();

  const params::Values& values() const { return live_.values; }
  const mesh::View& mesh() const { return opener_.mesh(); }
  const hull::View& hull() const { return opener_.hull(); }
  const field::View& distance_field() const { return opener_.distance_field(); }
  const curve::View& curve() const { return opener_.curve(); }
  const spline::View& spline_surface() const { return opener_.spline_surface(); }
  const spline::GuideView& spline_guide() const { return opener_.spline_guide(); }
  /// Tells assets apart; 0 before the asset's frame is proven.
  uint32_t asset_crc() const { return opener_.container().crc(); }

 private:
  // What a model is made from.
  struct Wish {
    math::Vec3 position_m;
    uint32_t tick = 0;
    bool can_feel = false;  // the asset is ready and the position known
  };
  struct Question {
    Wish wish;
    params::Values values;  // of that tick
  };
  // A model, and what the record tells of how it was made.
  struct Felt {
    servo::LocalModel model;
    float distance_m = 0, distance_lower_m = 0, penetration_m = 0;
    float guide_deviation_m = 0, guide_lower_m = 0, guide_arc = 0;
    uint32_t steps = 0, guide_steps = 0;
    uint32_t state = 1u << record::kStateSignShift;  // side unknown
  };
  // What making a model hands to the next one: of the tick, or of make_model(), never of both.
  struct Geometry {
    scene::MeshTouch touch;
    scene::SplineTouch spline;
    scene::GuideTouch guide;
    uint32_t sequence = 0;
    uint32_t tick = 0;  // of the last model
  };
  // All that a tick hands to the next one.
  struct Live {
    params::Values values;
    servo::ClockState clock;
    device::State device;
    Geometry geometry;
    core::Handoff<Question, Felt> models;
    servo::State servo;
    servo::GuardState guard;
    bool enable_was_low = false;  // in a tick with the asset ready
  };
  // What a query said of the surface, of whichever kind.
  struct Surface {
    float distance_m = 0, penetration_m = 0;  // the first signed
    query::Certificate certificate;
    uint32_t steps = 0;
    bool is_of_base_hull = false;
  };
  Surface touch(const Wish& wish, const params::Values& values, servo::LocalModel& model);
  bool take_parameter(const record::TickInput& input);
  void feel(const Wish& wish, const params::Values& values, Felt& felt);
  const Felt& felt_in(const Wish& wish, uint32_t lines);
  static void tell(const Felt& felt, record::TickOutput& output);

  Opener opener_;
  Live live_;
};

}  // namespace firmtouch
