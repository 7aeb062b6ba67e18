#include "emulator/exit.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/motors.hpp"

namespace firmtouch::hal {

// Interrupts first: a tick behind motors_off() would switch the power stage on again.
void board_exit(int status) {
#ifdef __riscv
  asm volatile("csrci mstatus, 8" ::: "memory");
#else
  asm volatile("cpsid i" ::: "memory");
#endif
  motors_off();
  emulator_exit(status);
  for (;;) asm volatile("wfi");
}

}  // namespace firmtouch::hal
