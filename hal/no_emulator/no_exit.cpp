#include "emulator/exit.hpp"

namespace firmtouch::hal {

void emulator_exit(int) {}

}  // namespace firmtouch::hal
