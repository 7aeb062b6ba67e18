// An application for Zephyr: the servo is a zero-latency interrupt at 4 kHz, the geometry a thread.
// The interrupt calls nothing of the kernel and never waits for the thread; a tick without a new
// model uses the last one. In prj.conf: CONFIG_CPP, CONFIG_STD_CPP17, CONFIG_FIRMTOUCH, CONFIG_FPU,
// CONFIG_FPU_SHARING and CONFIG_ZERO_LATENCY_IRQS.
#include <zephyr/irq.h>
#include <zephyr/kernel.h>

#include "firmtouch/controller/controller.hpp"
#include "firmtouch/controller/mesh_surface.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"

using namespace firmtouch;

extern "C" const unsigned char scene_fta[];  // `firmtouch bake MODEL -o scene.fta --cpp scene.cpp`
extern "C" const unsigned scene_fta_size;

namespace {

#define SERVO_IRQ 28  // of a timer that nothing else uses; the macros of Zephyr take a number
constexpr uint32_t kPeriod_us = 250;

Controller<Surfaces<MeshSurface>> controller;
K_THREAD_STACK_DEFINE(geometry_stack, 6144);
k_thread geometry_thread;

void make_models(void*, void*, void*) {
  for (;;) {
    controller.make_model();
    k_usleep(4 * kPeriod_us);
  }
}

}  // namespace

ISR_DIRECT_DECLARE(servo_interrupt) {
  static uint32_t next_tick = 0;
  record::TickInput input{};
  record::TickOutput output;
  input.tick = next_tick++;
  input.clock_us = hal::clock_us();
  input.flags = controller.model_flags() | hal::motors_lines();
  if (!hal::encoders_read(input.encoder_counts)) input.flags |= record::kFlagEncoderFault;
  if (input.tick < 2) {  // the motors are off: the period may change, and how old a model may be
    const bool is_first = input.tick == 0;
    const uint32_t row =
        params::row_of(controller.kTable, is_first ? params::kTickPeriod : params::kModelAge);
    input.command = 1 + row;
    input.command_value = is_first ? 1e-6f * kPeriod_us : 16.0f;
  }
  controller.tick(input, output);
  hal::motors_state(record::may_push(output));
  hal::motors_write_N(output.motor_N);
  return 0;  // nothing is to be scheduled anew
}

int main() {
  hal::motors_off();
  if (!controller.open({scene_fta, scene_fta_size}).ok()) return 1;
  IRQ_DIRECT_CONNECT(SERVO_IRQ, 0, servo_interrupt, IRQ_ZERO_LATENCY);
  irq_enable(SERVO_IRQ);  // and start your timer
  k_thread_create(&geometry_thread, geometry_stack, K_THREAD_STACK_SIZEOF(geometry_stack),
                  make_models, nullptr, nullptr, nullptr, K_PRIO_PREEMPT(5), K_FP_REGS, K_NO_WAIT);
  return 0;
}
