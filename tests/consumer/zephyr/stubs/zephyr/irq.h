#pragma once
// What main.cpp uses of <zephyr/irq.h>, for a program of this machine (stubs/kernel.cpp).
constexpr int IRQ_ZERO_LATENCY = 1;
extern void (*connected_isr)();
extern bool is_irq_enabled;

#define ISR_DIRECT_DECLARE(name)                  \
  static int name##_body();                       \
  extern "C" void name() { (void)name##_body(); } \
  static int name##_body()
#define IRQ_DIRECT_CONNECT(irq, priority, isr, flags)                                          \
  static_assert((irq) >= 0 && (priority) == 0 && (flags) == IRQ_ZERO_LATENCY, "zero latency"); \
  connected_isr = isr
inline void irq_enable(unsigned) { is_irq_enabled = true; }
