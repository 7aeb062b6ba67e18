#include "firmtouch/hal/parameters.hpp"

#include "registers.hpp"

// Sectors 10 and 11 of the flash, behind the asset (RM0090, 3.6). Not run on hardware; QEMU has no
// flash controller, so a save there fails its comparison.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kFirstSector = 10, kSector_bytes = 128 * 1024;
constexpr uint32_t kFlashKey = 0x40023C04, kFlashState = 0x40023C0C, kFlashControl = 0x40023C10;
constexpr uint32_t kProgram = 1u << 0, kErase = 1u << 1, kStart = 1u << 16, kLock = 1u << 31;
constexpr uint32_t kWords = 2u << 8;  // 32 bits at once: 2.7 to 3.6 V
constexpr uint32_t kErrors = 0xF0, kBusy = 1u << 16;

uint32_t address_of(uint32_t sector) { return 0x080C0000 + sector * kSector_bytes; }

core::Bytes sector_at(uint32_t sector) {
  return {reinterpret_cast<const uint8_t*>(static_cast<uintptr_t>(address_of(sector))),
          kSector_bytes};
}

void unlock() {
  if ((reg(kFlashControl) & kLock) != 0) {
    reg(kFlashKey) = 0x45670123;
    reg(kFlashKey) = 0xCDEF89AB;
  }
  reg(kFlashState) = kErrors;
}

bool finish() {
  while ((reg(kFlashState) & kBusy) != 0) {
  }
  return (reg(kFlashState) & kErrors) == 0;
}

}  // namespace

ParameterFlash board_parameters() { return {{sector_at(0), sector_at(1)}}; }

bool board_erase_parameters(uint32_t sector) {
  unlock();
  reg(kFlashControl) = kErase | (kFirstSector + sector) << 3 | kWords;
  reg(kFlashControl) = kErase | (kFirstSector + sector) << 3 | kWords | kStart;
  const bool is_good = finish();
  reg(kFlashControl) = kLock;
  return is_good;
}

bool board_program_parameters(uint32_t sector, uint32_t offset, core::Bytes bytes) {
  unlock();
  bool is_good = true;
  for (uint32_t i = 0; i < bytes.size() && is_good; i += 4) {
    uint32_t word;
    __builtin_memcpy(&word, bytes.data() + i, 4);
    reg(kFlashControl) = kProgram | kWords;
    reg(address_of(sector) + offset + i) = word;
    is_good = finish();
  }
  reg(kFlashControl) = kLock;
  return is_good;
}

}  // namespace firmtouch::hal
