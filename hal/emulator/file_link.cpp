#include "emulator/file_link.hpp"

#include "emulator/semihosting.hpp"
#include "firmtouch/hal/board.hpp"

namespace firmtouch::hal {
namespace {

constexpr uint32_t kMaxPath_bytes = 480;
constexpr uint32_t kReadBinary = 1, kWriteBinary = 5;
constexpr int kCannotOpen = 71;  // exit status of the emulator

int32_t g_in = -1, g_out = -1;

int32_t open_with_ending(char* prefix, uint32_t length, const char (&ending)[5], uint32_t mode) {
  for (uint32_t i = 0; i < 5; ++i) prefix[length + i] = ending[i];  // with the final zero
  return semihosting_open(prefix, mode);
}

}  // namespace

bool file_link_begin() {
  static char line[kMaxPath_bytes];
  if (!semihosting_command_line(line, kMaxPath_bytes - 5)) return false;
  const char kWord[] = "link ";
  for (uint32_t i = 0; i < sizeof kWord - 1; ++i) {
    if (line[i] != kWord[i]) return false;
  }
  char* const prefix = line + sizeof kWord - 1;  // the rest of the line; it may contain spaces
  uint32_t length = 0;
  while (prefix[length] != 0) ++length;
  g_in = open_with_ending(prefix, length, ".in\0", kReadBinary);
  g_out = open_with_ending(prefix, length, ".out", kWriteBinary);
  if (g_in >= 0 && g_out >= 0) return true;
  board_print("Cannot open the link's files: ");
  board_print(prefix);
  board_print(" (first: mkfifo PREFIX.in PREFIX.out)\n");
  board_exit(kCannotOpen);
}

bool file_link_is_open() { return g_in >= 0; }

void file_link_wait(ByteRing& ring) {
  uint8_t bytes[ByteRing::kCapacity_bytes / 2];
  if (!ring.empty()) return;  // all of `bytes` fits into an empty ring
  const uint32_t count = semihosting_read(g_in, bytes, sizeof bytes);
  if (count == 0) board_exit(0);  // the host closed the FIFO
  for (uint32_t i = 0; i < count; ++i) ring.push(bytes[i]);
}

uint32_t file_link_write(const uint8_t* from, uint32_t count) {
  return semihosting_write(g_out, from, count);
}

}  // namespace firmtouch::hal
