#include "target/selftest/selftest.hpp"

#include "target/text.hpp"

namespace firmtouch::selftest {

Servo servo;
Totals totals;

const char* const kPrompts[] = {
    "-> The link must hear itself: connect its two wires, or let the host send back what it "
    "gets.\n",
    "-> Open the enable switch, release the emergency stop.\n",
    "-> Close the enable switch.\n",
    "-> Press the emergency stop.\n",
    "-> Release the emergency stop.\n",
    "-> Unplug the fault wire of the motor drivers.\n",
    "-> Plug the fault wire in again.\n",
    "-> Turn joint 1 by hand, joints 2 and 3 stay.\n",
    "-> Turn joint 2 by hand, joints 1 and 3 stay.\n",
    "-> Turn joint 3 by hand, joints 1 and 2 stay.\n",
    "-> Close the enable switch and let go: each motor pushes with a rising force.\n"};

void show(Prompt what) { hal::board_print(kPrompts[static_cast<uint32_t>(what)]); }

bool check(const char* function, bool good, const char* remedy, const char* more) {
  ++(good ? totals.passed : totals.failed);
  hal::board_print(good ? "ok    " : "FAIL  ");
  hal::board_print(function);
  if (!good) {
    hal::board_print(": ");
    hal::board_print(remedy);
    hal::board_print(more);
  }
  hal::board_print("\n");
  return good;
}

void skip(const char* function, const char* reason) {
  hal::board_print("skip  ");
  hal::board_print(function);
  hal::board_print(": ");
  hal::board_print(reason);
  hal::board_print("\n");
}

void print(uint32_t value) { hal::board_print(target::decimal(value).text); }

void end() {
  print(totals.passed);
  hal::board_print(" passed, ");
  print(totals.failed);
  hal::board_print(" failed\n");
  servo.may_push = false;
  servo.has_ended = true;
  hal::board_exit(totals.failed == 0 ? 0 : 1);
}

void wait_ms(uint32_t ms) {
  comes([] { return false; }, ms);
}

namespace {

[[noreturn]] void run() {
  hal::board_begin();
  hal::board_print("\nFirmtouch self-test of board ");
  hal::board_print(hal::board_name());
  hal::board_print("\n");
  after_reset();
  check_board();
  check_flash();
  if (!check_clock()) end();
  check_link();
  check_lines();
  check_encoders();
  check_feeding();
  check_motors();
  check_long_run();
  check_starving();
  end();
}

}  // namespace
}  // namespace firmtouch::selftest

int main() { firmtouch::selftest::run(); }
