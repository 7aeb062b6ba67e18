#pragma once
#include <stdint.h>

#include "silicon/silicon.hpp"

// What STM32G4 and STM32H7 have in common (RM0440, RM0433). A board's registers.hpp has its
// addresses, clocks and pins.
namespace firmtouch::hal {

// Ports: offsets of their registers.
constexpr uint32_t kPortMode = 0x00, kPortPull = 0x0C, kPortInput = 0x10, kPortSet = 0x18,
                   kPortFunction = 0x20;
enum class Pull : uint32_t { kNone, kUp, kDown };

struct Pin {
  uint32_t port, number;
  uint32_t function = 0;  // alternate function
};

/// Replaces `bits` bits from `shift` on.
inline void set_field(uint32_t address, uint32_t shift, uint32_t bits, uint32_t value) {
  reg(address) = (reg(address) & ~(((1u << bits) - 1) << shift)) | value << shift;
}
/// Switches clocks on; read back, they run when it returns.
inline void switch_on(uint32_t address, uint32_t bits) {
  reg(address) = reg(address) | bits;
  while ((reg(address) & bits) != bits) {
  }
}
inline void pin_as(const Pin& pin, uint32_t mode, Pull pull) {
  set_field(pin.port + kPortPull, 2 * pin.number, 2, static_cast<uint32_t>(pull));
  set_field(pin.port + kPortMode, 2 * pin.number, 2, mode);
}
// Ports lie a kilobyte apart, from a multiple of 32 of them on.
inline PinName name_of(const Pin& pin) {
  return {{'P', static_cast<char>('A' + pin.port / 0x400 % 32)}, pin.number};
}
inline void pin_input(const Pin& pin, Pull pull) { pin_as(pin, 0, pull); }
inline void pin_output(const Pin& pin) { pin_as(pin, 1, Pull::kNone); }
inline void pin_alternate(const Pin& pin, Pull pull = Pull::kNone) {
  set_field(pin.port + kPortFunction + pin.number / 8 * 4, pin.number % 8 * 4, 4, pin.function);
  pin_as(pin, 2, pull);
}
inline void pin_write(const Pin& pin, bool high) {
  reg(pin.port + kPortSet) = 1u << (high ? pin.number : pin.number + 16);
}
inline bool pin_is_high(const Pin& pin) {
  return (reg(pin.port + kPortInput) >> pin.number & 1u) != 0;
}

// Timers.
constexpr uint32_t kTimerControl = 0x00, kTimerMode = 0x08, kTimerState = 0x10, kTimerEvent = 0x14,
                   kTimerChannels = 0x18, kTimerOutputs = 0x20, kTimerCount = 0x24,
                   kTimerPrescaler = 0x28, kTimerReload = 0x2C, kTimerCompare = 0x34,
                   kTimerBreak = 0x44;
constexpr uint32_t kTimerOn = 1u << 0;

// UARTs.
constexpr uint32_t kUsartControl = 0x00, kUsartErrors = 0x08, kUsartDivider = 0x0C,
                   kUsartState = 0x1C, kUsartReceived = 0x24, kUsartSent = 0x28;
constexpr uint32_t kUsartOn = 1u << 0, kReceiveOn = 1u << 2, kTransmitOn = 1u << 3,
                   kReceiveInterrupt = 1u << 5;                    // of control
constexpr uint32_t kReceived = 1u << 5, kTransmitEmpty = 1u << 7;  // of state
constexpr uint32_t kNoOverrun = 1u << 12;                          // of errors

}  // namespace firmtouch::hal
