#include "firmtouch/hal/parameters.hpp"

namespace firmtouch::hal {

ParameterFlash board_parameters() { return {}; }
bool board_erase_parameters(uint32_t) { return false; }
bool board_program_parameters(uint32_t, uint32_t, core::Bytes) { return false; }

}  // namespace firmtouch::hal
