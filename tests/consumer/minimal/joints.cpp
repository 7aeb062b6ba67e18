// Joints that the scripted hand moves. They check the force at each stop: none in free space, 3 mm
// of spring on the gem.
#include "../hand.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"

namespace {

uint32_t tick = 0;
uint32_t wrong = 0, on_gem = 0;

void check(const float (&force_N)[3]) {
  bool settled = false;
  const Place place = hand_place(tick, settled);
  if (place == Place::kEnd) {
    const bool good = wrong == 0 && on_gem > 100;
    firmtouch::hal::board_print(good ? "ok    Minimal_RendersTheBakedMesh\n1 passed, 0 failed\n"
                                     : "FAIL  Minimal_RendersTheBakedMesh\n0 passed, 1 failed\n");
    firmtouch::hal::board_exit(good ? 0 : 1);
  }
  if (!settled) return;
  const bool is_gem = place == Place::kOnGem;
  if (is_gem) ++on_gem;
  const float low_N = is_gem ? 2.35f : -0.001f, high_N = is_gem ? 2.45f : 0.001f;  // 800 N/m
  if (!(force_N[2] >= low_N) || !(force_N[2] <= high_N)) ++wrong;
}

}  // namespace

namespace firmtouch::hal {

bool encoders_read(int32_t (&counts)[3]) {
  hand_counts(++tick, counts);
  return true;
}

void motors_write_N(const float (&force_N)[3]) { check(force_N); }

void motors_state(bool) {}
void motors_off() {}

uint32_t motors_lines() { return tick < 10 ? 0 : kMotorsEnable; }  // closed after the start

}  // namespace firmtouch::hal
