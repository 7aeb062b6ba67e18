#pragma once
#include <cstdint>

namespace firmtouch::app_test {

/// What the test program's own servo interrupt sees and writes: joints that a test moves.
struct MovedJoints {
  uint32_t tick = 0;            // of input_of()
  uint32_t lines = UINT32_MAX;  // mask of its flags
  float* motors = nullptr;      // what each tick wrote, three a tick; null: not kept
};
extern MovedJoints joints;

}  // namespace firmtouch::app_test
