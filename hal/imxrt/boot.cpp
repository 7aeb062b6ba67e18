#include "registers.hpp"

// What the boot ROM reads from the flash (IMXRT1060RM, chapter 9), and the first instructions.
extern "C" {
extern uint32_t __stack_top[];
extern const uint8_t __boot_image_bytes[];
void reset_handler();
}

namespace firmtouch::hal {
namespace {

constexpr uint32_t kFlash = 0x60000000;

// A step of a sequence on the flash's lines: what, lines (2 to this), operand.
constexpr uint32_t step(uint32_t what, uint32_t lines_log2, uint32_t operand) {
  return what << 10 | lines_log2 << 8 | operand;
}
constexpr uint32_t kCommand = 1, kAddress = 2, kMode = 7, kRead = 9, kIdle = 12;

struct FlashConfiguration {
  uint32_t tag, version, reserved0, sampling, reserved1[12];
  uint32_t options, kind, reserved2[2], bytes, reserved3[11];
  uint32_t read[4], other_sequences[60], reserved4[16];
  uint32_t page_bytes, sector_bytes, command_clock, reserved5[13];
};
static_assert(sizeof(FlashConfiguration) == 512, "as the boot ROM reads it");

// Fast read 0xEB on four lines at 100 MHz, without the mode in which a reset finds it.
[[gnu::section(".boot_flash"), gnu::used]] const FlashConfiguration kConfiguration = {
    0x42464346,  // "FCFB"
    0x56010000,
    0,
    0x00030301,  // version 1.0; set-up and hold 3, sampled by the looped-back strobe
    {},
    0,
    6u << 16 | 4u << 8 | 1u,
    {},
    kFlash_bytes,
    {},
    {step(kAddress, 2, 24) << 16 | step(kCommand, 0, 0xEB),
     step(kIdle, 2, 4) << 16 | step(kMode, 2, 0x00), step(kRead, 2, 4), 0},
    {},
    {},
    256,
    4096,
    1,
    {}};

// FlexRAM: 32 KB of instruction memory, 480 KB of data memory, none on the bus. Then the stack,
// which the boot ROM does not set.
[[gnu::naked, noreturn]] void boot_entry() {
  asm volatile(
      "ldr r0, =0x400AC000 \n"
      "ldr r1, =0xAAAAAAAB \n"  // two bits a bank
      "str r1, [r0, #0x44] \n"
      "ldr r1, =0x00200007 \n"  // the banks are these; both memories on
      "str r1, [r0, #0x40] \n"
      "ldr r1, =0x00AA0000 \n"  // address ranges of 512 KB
      "str r1, [r0, #0x38] \n"
      "dsb                 \n"
      "isb                 \n"
      "ldr r0, =__stack_top\n"
      "mov sp, r0          \n"
      "b reset_handler     \n"
      ".ltorg              \n");
}

struct BootData {
  uint32_t start;
  const uint8_t* bytes;
  uint32_t plugin;
};
struct ImageTable {  // and what it points to: one object, whose order is sure
  uint32_t header;
  void (*entry)();
  uint32_t reserved0, device_data;
  const BootData* data;
  const ImageTable* self;
  uint32_t signature, reserved1;
  BootData boot_data;
};
[[gnu::section(".boot_image"), gnu::used]] const ImageTable kImage = {
    0x402000D1,
    boot_entry,
    0,
    0,
    &kImage.boot_data,
    &kImage,
    0,
    0,
    {kFlash, __boot_image_bytes, 0}};

}  // namespace
}  // namespace firmtouch::hal
