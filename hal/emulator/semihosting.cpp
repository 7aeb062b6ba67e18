#include "emulator/semihosting.hpp"

#include "emulator/exit.hpp"
#include "firmtouch/hal/board.hpp"

namespace firmtouch::hal {
namespace {

constexpr uint32_t kOpen = 0x01, kClose = 0x02, kWrite = 0x05, kRead = 0x06, kCommandLine = 0x15,
                   kExitExtended = 0x20;
constexpr uint32_t kApplicationExit = 0x20026;

#ifdef __riscv
uint32_t call(uint32_t operation, uint32_t* arguments) {
  register uint32_t a0 asm("a0") = operation;
  register uint32_t* a1 asm("a1") = arguments;
  // Three instructions of 32 bits, within one page.
  asm volatile(
      ".balign 16\n .option push\n .option norvc\n slli x0, x0, 0x1f\n ebreak\n srai x0, x0, 7\n"
      ".option pop"
      : "+r"(a0)
      : "r"(a1)
      : "memory");
  return a0;
}
#else
uint32_t call(uint32_t operation, uint32_t* arguments) {
  register uint32_t r0 asm("r0") = operation;
  register uint32_t* r1 asm("r1") = arguments;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}
#endif

uint32_t address(const void* p) { return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(p)); }

uint32_t length(const char* text) {
  uint32_t n = 0;
  while (text[n] != 0) ++n;
  return n;
}

}  // namespace

bool board_may_exit() { return true; }

void emulator_exit(int status) {
  uint32_t arguments[] = {kApplicationExit, static_cast<uint32_t>(status)};
  call(kExitExtended, arguments);
}

int32_t semihosting_open(const char* path, uint32_t mode) {
  uint32_t arguments[] = {address(path), mode, length(path)};
  return static_cast<int32_t>(call(kOpen, arguments));
}

void semihosting_close(int32_t file) {
  uint32_t arguments[] = {static_cast<uint32_t>(file)};
  call(kClose, arguments);
}

uint32_t semihosting_read(int32_t file, uint8_t* to, uint32_t capacity) {
  uint32_t arguments[] = {static_cast<uint32_t>(file), address(to), capacity};
  const uint32_t missing = call(kRead, arguments);  // number of bytes NOT read
  return missing <= capacity ? capacity - missing : 0;
}

uint32_t semihosting_write(int32_t file, const uint8_t* from, uint32_t count) {
  uint32_t arguments[] = {static_cast<uint32_t>(file), address(from), count};
  const uint32_t missing = call(kWrite, arguments);
  return missing <= count ? count - missing : 0;
}

bool semihosting_command_line(char* text, uint32_t capacity) {
  uint32_t arguments[] = {address(text), capacity};
  text[0] = 0;
  return call(kCommandLine, arguments) == 0 && text[0] != 0;
}

}  // namespace firmtouch::hal
