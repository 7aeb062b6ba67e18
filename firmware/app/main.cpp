#include "asset_update.hpp"
#include "firmtouch/asset/container.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/link.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/link/text_writer.hpp"
#include "host_session.hpp"
#include "last_crash.hpp"
#include "saved_parameters.hpp"
#include "servo.hpp"
#include "servo_interrupt.hpp"

// The controller program, the same source for every board and composition: proves the asset,
// answers the host, runs the servo.

namespace firmtouch::app {
namespace {

HostSession session;

// The asset in the board's slot; the whole slot if none begins there, so that opening names the
// rule.
core::Bytes asset() {
  const core::Bytes region = hal::board_asset();
  const uint32_t bytes = asset::stated_bytes(region);
  return bytes == 0 ? region : core::Bytes{region.data(), bytes};
}

void open(core::Bytes asset) {
  controller.begin(asset);
  while (!controller.work(kSliceUnits)) session.poll();
}

[[gnu::noinline]] void print_verdict() {
  if (controller.is_ready()) return;
  char text[160];
  link::TextWriter out(text);
  const uint32_t part = controller.verdict().rule - uint32_t{kRuleNeedsMesh};
  if (part < kPartCount) {
    out.text("asset rejected by rule R")
        .decimal(controller.verdict().rule)
        .text(": it needs part `");
    out.text(part_name(part))
        .text("`. Build the program with it (FIRMTOUCH_APP). The motors stay off.\n");
    return hal::board_print(text);
  }
  out.text("asset rejected by rule R").decimal(controller.verdict().rule).text(" at element ");
  out.decimal(controller.verdict().element);
  out.text(" (tools/FORMAT.md): bake and load it again. The motors stay off.\n");
  hal::board_print(text);
}

}  // namespace

// A function of its own: tools/check/image leaves it out of the phases in which no asset is opened.
[[gnu::noinline]] void open_asset() {
  if constexpr (kHasSlots) {
    for (uint32_t i = 0; i < 2; ++i) {
      const core::Bytes loaded = loaded_asset(i);
      if (loaded.empty()) continue;
      open(loaded);
      if (controller.is_ready()) return;
    }
  }
  open(asset());
}

namespace {

[[noreturn]] void run() {
  hal::board_begin();
  hal::motors_off();
  if constexpr (kKeepsCrash) take_crash();
  prepare_saving();
  open_asset();
  print_verdict();
  for (;;) {
    main_loop.count();
    session.poll();
    if constexpr (kHasSlots) asset_update.work();
    if (controller.is_ready() && !session.is_lock_step()) start_servo_when_enabled();
    if (kTwoRates && !session.is_lock_step()) controller.make_model();
    if (session.is_idle()) hal::link_wait();
  }
}

}  // namespace
}  // namespace firmtouch::app

int main() { firmtouch::app::run(); }
