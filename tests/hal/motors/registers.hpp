#pragma once
// registers.hpp of the board under test, with three motors that differ.
#define kFull_N_or_Nm kFullOfBoard_N_or_Nm
#include FIRMTOUCH_TEST_REGISTERS
#undef kFull_N_or_Nm

namespace firmtouch::hal {

constexpr float kFull_N_or_Nm[3] = {10.0f, 20.0f, 0.5f};

}  // namespace firmtouch::hal
