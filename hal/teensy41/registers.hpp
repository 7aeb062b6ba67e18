#pragma once
#include "imxrt/imxrt.hpp"

// Teensy 4.1 (its schematic and pin card). Pins have the numbers of its edge. Not run.
namespace firmtouch::hal {

constexpr uint32_t kFlash_bytes = 8u << 20;

constexpr uint32_t kLink = kUart6, kLinkInterrupt = 25, kConsole = kUart4;
constexpr Pin kLinkPins[2] = {{1, pad_ad(2)}, {0, pad_ad(3)}}, kConsolePin = {8, pad_b(16)};

constexpr Pin kEncoderPins[6] = {{2, 4}, {3, 5}, {4, 6}, {33, 7}, {31, 36}, {30, 37}};
constexpr CrossbarInput kEncoderInputs[6] = {{3, 6, 0x61C, 0},  {3, 7, 0x620, 0},
                                             {3, 8, 0x624, 0},  {3, 9, 0x628, 0},
                                             {1, 22, 0x638, 0}, {1, 23, 0x63C, 0}};
constexpr float kFull_N_or_Nm[3] = {10, 10, 10};  // of a motor at full width: yours
constexpr Pin kPulsePins[3] = {{6, pad_b(10)}, {9, pad_b(11)}, {36, pad_b(18)}};
constexpr Pulse kPulses[3] = {{2, 2, false}, {2, 2, true}, {6, 3, false}};
constexpr Pin kDirectionPins[3] = {{10, pad_b(0)}, {11, pad_b(2)}, {12, pad_b(1)}};
constexpr Pin kBreakPin = {37, pad_b(19)};
constexpr CrossbarInput kBreakInput = {1, 17, 0x62C, 3};
constexpr Pin kPowerPin = {32, pad_b(12)}, kEnablePin = {24, pad_ad(12)},
              kStopPin = {25, pad_ad(13)};

}  // namespace firmtouch::hal
