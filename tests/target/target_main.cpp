// The controller's main of the tests: all of them, over the debug console; the result is the exit
// status.
#include "firmtouch/hal/board.hpp"
#include "harness/test.hpp"

int main() {
  firmtouch::hal::board_begin();
  firmtouch::test::print = firmtouch::hal::board_print;
  return firmtouch::test::run(nullptr);
}
