// A kernel of one thread: while it sleeps, the interrupt comes every 250 us. joints.cpp ends the
// program.
#include <zephyr/irq.h>
#include <zephyr/kernel.h>

#include <cstdio>
#include <cstdlib>

#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"

void (*connected_isr)() = nullptr;
bool is_irq_enabled = false;
static uint32_t now_us = 0;

int32_t k_usleep(int32_t us) {
  for (const uint32_t end_us = now_us + static_cast<uint32_t>(us); now_us != end_us;
       now_us += 250) {
    if (is_irq_enabled) connected_isr();
  }
  return 0;
}
void k_thread_create(k_thread*, char*, size_t, k_thread_entry_t entry, void* p1, void* p2, void* p3,
                     int, uint32_t, k_timeout_t) {
  entry(p1, p2, p3);  // never returns
}

namespace firmtouch::hal {
uint32_t clock_us() { return now_us; }
void board_print(const char* text) { std::fputs(text, stdout); }
[[noreturn]] void board_exit(int status) { std::exit(status); }
}  // namespace firmtouch::hal
