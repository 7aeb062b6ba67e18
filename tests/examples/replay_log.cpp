// What you feel: nothing. This is for the day when a user reports an odd force: at your desk, give
// a controller the recorded inputs again, and get every force again to the last bit.
// Picture: pictures/replay_log.svg
//
// A tick depends on the controller's state and its input alone, and a record keeps input and
// output. So a log is a test: after a change of the firmware it names the first tick that differs.
// (`firmtouch-sim replay FILE.ftl` does this for a log of the link.)
#include "firmtouch/controller/controller.hpp"
#include "firmtouch/controller/mesh_surface.hpp"
#include "firmtouch/math/elementary.hpp"
#include "firmtouch/record/ring.hpp"
#include "hand.hpp"

using namespace firmtouch;

extern "C" const unsigned char block_fta[];  // the asset
extern "C" const unsigned block_fta_size;

namespace {

constexpr uint32_t kTicks = 500;

using MeshController = Controller<Surfaces<MeshSurface>>;
// The servo interrupt pushes; the main loop pops and sends. It is as long as the run here.
record::Ring<record::TickRecord, 512> ring;

// A hand that taps on the block, 5 times a second, and turns its stiffness down meanwhile.
record::TickInput input_of(uint32_t tick) {
  const float height_m = 0.0222f + 0.002f * math::cosine(0.0314f * static_cast<float>(tick));
  record::TickInput input = input_at(tick, {0, 0, height_m});
  if (tick == 250) {
    input.command = 1 + params::row_of(MeshController::kTable, params::kContactStiffness);
    input.command_value = 400.0f;
  }
  return input;
}

// Gives the recorded inputs to another controller, with one count more in tick `disturbed`.
// Result: the first tick whose output differs by a bit; kTicks if none does.
uint32_t first_difference(MeshController& other, uint32_t disturbed) {
  for (const record::Numbered<record::TickRecord>& recorded : ring.ready()) {
    record::TickInput input = recorded.value.input;
    if (recorded.number == disturbed) ++input.encoder_counts[0];
    record::TickOutput output;
    other.tick(input, output);
    if (__builtin_memcmp(&output, &recorded.value.output, sizeof output) != 0)
      return recorded.number;
  }
  return kTicks;
}

MeshController original, at_desk;

}  // namespace

int main() {
  if (!original.open({block_fta, block_fta_size}).ok()) return 2;
  uint32_t pushes = 0;
  for (uint32_t i = 0; i < kTicks; ++i) {
    record::TickRecord now{};
    now.input = input_of(i);
    original.tick(now.input, now.output);
    show(now.output);
    if (now.output.force_N[2] > 0.1f) ++pushes;
    ring.push(now);
  }
  if (ring.dropped() != 0 || pushes < 100) return 3;

  // The same inputs again: not a bit differs.
  if (!at_desk.open({block_fta, block_fta_size}).ok()) return 4;
  if (first_difference(at_desk, kTicks) != kTicks) return 5;

  // With one encoder count more in tick 300, and nothing else changed: that tick is named.
  at_desk.reset();
  return first_difference(at_desk, 300) == 300 ? 0 : 6;
}
