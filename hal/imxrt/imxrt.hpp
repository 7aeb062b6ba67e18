#pragma once
#include "silicon/silicon.hpp"

// The i.MX RT1062 (IMXRT1060RM). A board's registers.hpp has its pins. Not run.
namespace firmtouch::hal {

constexpr uint32_t kCore_MHz = 528, kBus_MHz = 132, kCrystal_MHz = 24;

constexpr uint32_t kSettings = 0x400AC000, kWatchdog = 0x400BC000, kPll = 0x400D8000,
                   kClock = 0x400FC000, kUart4 = 0x40190000, kUart6 = 0x40198000,
                   kPort1 = 0x401B8000, kPort2 = 0x401BC000, kTimer = 0x401EC000,
                   kPads = 0x401F8000, kCrossbar = 0x403BC000, kEncoder1 = 0x403C8000,
                   kPulse2 = 0x403E0000;

// Clock gates: register, position.
struct Gate {
  uint32_t number, position;
  uint32_t address() const { return kClock + 0x68 + 4 * number; }
  uint32_t bits() const { return 3u << 2 * position; }
};
constexpr Gate kGatePort1 = {1, 13}, kGatePort2 = {0, 15}, kGatePads = {4, 1},
               kGateSettings = {4, 2}, kGateCrossbar = {2, 11}, kGatePulse2 = {4, 9},
               kGateTimer = {1, 10}, kGateTimerInput = {1, 11}, kGateUart6 = {3, 3},
               kGateUart4 = {1, 12}, kGateWatchdog = {5, 2};
inline void switch_on(const Gate& gate) { reg(gate.address()) = reg(gate.address()) | gate.bits(); }
inline bool is_on(const Gate& gate) { return (reg(gate.address()) & gate.bits()) == gate.bits(); }

// Pads: EMC 0 to 41, AD 0 to 31, B 0 to 31. Of the last two, the ports' bits.
constexpr uint32_t pad_ad(uint32_t number) { return 42 + number; }
constexpr uint32_t pad_b(uint32_t number) { return 74 + number; }
struct Pin {
  uint32_t number, pad;  // on the board's edge, of the chip
  uint32_t port() const { return pad < pad_b(0) ? kPort1 : kPort2; }
  uint32_t bit() const { return 1u << (pad - pad_ad(0)) % 32; }
};
struct CrossbarInput {
  uint32_t function, number, select, choice;  // of the pad; of the crossbar; which pad it takes
};
struct Pulse {  // of module 2
  uint32_t function, submodule;
  bool is_channel_b;
};
inline PinName name_of(const Pin& pin) { return {{'p', 'i', 'n', ' '}, pin.number}; }

constexpr uint32_t kPortFunction = 5;
enum class Pull : uint32_t { kNone, kDown = 3u << 12, kUp = 1u << 14 | 3u << 12 };  // 100, 47 kOhm

inline void pin_as(const Pin& pin, uint32_t function, Pull pull = Pull::kNone) {
  constexpr uint32_t kHysteresis = 1u << 16, kStrength = 6u << 3;
  reg(kPads + 0x204 + 4 * pin.pad) = kHysteresis | kStrength | static_cast<uint32_t>(pull);
  reg(kPads + 0x014 + 4 * pin.pad) = function;
}
inline void pin_write(const Pin& pin, bool high) {
  reg(pin.port() + (high ? 0x84 : 0x88)) = pin.bit();
}
inline void pin_output(const Pin& pin) {
  reg(pin.port() + 0x4) = reg(pin.port() + 0x4) | pin.bit();
  pin_as(pin, kPortFunction);
}
inline bool pin_is_high(const Pin& pin) { return (reg(pin.port() + 0x8) & pin.bit()) != 0; }

/// Connects a pad to an output of the crossbar. Two outputs share a register.
inline void crossbar(const Pin& pin, const CrossbarInput& input, uint32_t output) {
  pin_as(pin, input.function, Pull::kUp);
  reg(kPads + input.select) = input.choice;
  const uint32_t address = kCrossbar + output / 2 * 2, shift = output % 2 * 8;
  const uint32_t others = reg16(address) & ~(0xFFu << shift);
  reg16(address) = static_cast<uint16_t>(others | input.number << shift);
}

// UARTs (LPUART).
constexpr uint32_t kUartBaud = 0x10, kUartState = 0x14, kUartControl = 0x18, kUartData = 0x1C,
                   kUartQueues = 0x28;
constexpr uint32_t kUartTransmits = 1u << 19;
inline const Gate& uart_gate(uint32_t uart) { return uart == kUart6 ? kGateUart6 : kGateUart4; }
void uart_begin(uint32_t uart, uint32_t baud, bool receives);
inline bool uart_is_on(uint32_t uart) {
  return is_on(uart_gate(uart)) && (reg(uart + kUartControl) & kUartTransmits) != 0;
}
inline bool uart_may_send(uint32_t uart) { return (reg(uart + kUartState) & 1u << 23) != 0; }
inline void uart_send(uint32_t uart, uint8_t byte) { reg(uart + kUartData) = byte; }
/// After a byte was lost the UART receives none before the flag is cleared.
inline bool uart_has_byte(uint32_t uart) {
  constexpr uint32_t kLost = 1u << 19;
  if ((reg(uart + kUartState) & kLost) != 0) reg(uart + kUartState) = kLost;
  return (reg(uart + kUartState) & 1u << 21) != 0;
}
inline uint8_t uart_byte(uint32_t uart) { return static_cast<uint8_t>(reg(uart + kUartData)); }

}  // namespace firmtouch::hal
