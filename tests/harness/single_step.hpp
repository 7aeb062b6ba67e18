#pragma once
// Real machine code with a whole interrupt between any two of its instructions: the processor's
// trap flag stops after each one, and the signal's handler is the interrupt.
#if defined(__x86_64__) && defined(__linux__)
#define FIRMTOUCH_SINGLE_STEP 1

#include <sys/ucontext.h>

#include <csignal>
#include <cstdint>

namespace firmtouch::test {

/// While it lives traps are taken. One at a time.
class SingleStep {
 public:
  SingleStep() {
    struct sigaction handler {};
    handler.sa_sigaction = on_trap;
    handler.sa_flags = SA_SIGINFO;
    is_ready_ = sigaction(SIGTRAP, &handler, &before_) == 0;
  }
  ~SingleStep() {
    if (is_ready_) sigaction(SIGTRAP, &before_, nullptr);
  }
  SingleStep(const SingleStep&) = delete;
  SingleStep& operator=(const SingleStep&) = delete;

  bool is_ready() const { return is_ready_; }

  /// Runs `body`, and `interrupt` behind its instruction number `place`.
  /// Result: false where the place lies behind the end.
  template <class Body>
  bool run(uint32_t place, void (*interrupt)(), const Body& body) {
    interrupt_ = interrupt;
    place_ = place;
    instruction_ = 0;
    set_trap_flag();
    body();
    clear_trap_flag();
    return instruction_ > place;
  }

 private:
  // The kernel clears the trap flag for the handler and restores it afterwards, unless the handler
  // is done with stepping.
  static void on_trap(int, siginfo_t*, void* context) {
    if (instruction_ == place_) {
      interrupt_();
      static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_EFL] &= ~0x100;
    }
    instruction_ = instruction_ + 1;
  }
  // Below the red zone of the caller, which pushf would overwrite.
  static void set_trap_flag() {
    asm volatile(
        "lea -128(%%rsp), %%rsp\n pushf\n orl $0x100, (%%rsp)\n popf\n lea 128(%%rsp), %%rsp" ::
            : "memory", "cc");
  }
  static void clear_trap_flag() {
    asm volatile(
        "lea -128(%%rsp), %%rsp\n pushf\n andl $0xFFFFFEFF, (%%rsp)\n popf\n lea 128(%%rsp), "
        "%%rsp" ::
            : "memory", "cc");
  }

  static inline volatile uint32_t instruction_;  // counted since the trap flag was set
  static inline volatile uint32_t place_;
  static inline void (*interrupt_)();
  struct sigaction before_ {};
  bool is_ready_;
};

}  // namespace firmtouch::test

#endif
