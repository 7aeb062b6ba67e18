#pragma once
#include <stdint.h>

// Simulated joints. They replace the board's encoder and motor functions; a scripted hand moves
// them (hand.hpp).
namespace firmtouch::demo {

struct Joints {
  int32_t counts[3] = {};
  bool are_valid = false;
  float motor_N[3] = {};
  uint32_t lines = 0;      // hal::motors_lines()
  uint32_t pushed_us = 0;  // when a motor last had a force
};

extern Joints joints;  // servo interrupt; `lines` is read by the main loop, too

}  // namespace firmtouch::demo
