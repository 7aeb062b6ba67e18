#pragma once
#include "rp2350/rp2350.hpp"

// Raspberry Pi Pico 2 (RP-008299). Not run.
namespace firmtouch::hal {

constexpr uint32_t kCrystal_MHz = 12;

constexpr uint32_t kLink = kUart0, kLinkInterrupt = 33, kConsole = kUart1;
constexpr Pin kLinkPins[2] = {{0}, {1}}, kConsolePin = {4};
constexpr Pin kEncoderPins[6] = {{6}, {7}, {8}, {9}, {10}, {11}};  // B behind A
constexpr float kFull_N_or_Nm[3] = {10, 10, 10};   // of a motor at full width: yours
constexpr Pin kPulsePins[3] = {{16}, {18}, {20}};  // channel A of slices 0 to 2
constexpr Pin kDirectionPins[3] = {{17}, {19}, {21}};
constexpr Pin kPowerPin = {22}, kBreakPin = {26}, kEnablePin = {27}, kStopPin = {28};

}  // namespace firmtouch::hal
