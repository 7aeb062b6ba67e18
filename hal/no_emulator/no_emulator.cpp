#include "emulator/file_link.hpp"
#include "firmtouch/hal/board.hpp"

// Without an emulator there is no file to talk to, and no host may end the program.
namespace firmtouch::hal {

bool board_may_exit() { return false; }

bool file_link_begin() { return false; }
bool file_link_is_open() { return false; }
void file_link_wait(ByteRing&) {}
uint32_t file_link_write(const uint8_t*, uint32_t) { return 0; }

}  // namespace firmtouch::hal
