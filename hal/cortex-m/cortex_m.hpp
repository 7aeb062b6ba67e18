#pragma once
#include <stdint.h>

// The registers of the core itself, the same on every Cortex-M (ARM DDI 0403, B3.2).
namespace firmtouch::hal {

/// A register at `address`.
inline volatile uint32_t& reg(uint32_t address) {
  return *reinterpret_cast<volatile uint32_t*>(static_cast<uintptr_t>(address));
}
inline volatile uint16_t& reg16(uint32_t address) {
  return *reinterpret_cast<volatile uint16_t*>(static_cast<uintptr_t>(address));
}

constexpr uint32_t kSysTickControl = 0xE000E010;  // b0 enable, b1 interrupt, b2 processor clock
constexpr uint32_t kSysTickReload = 0xE000E014;   // 24 bits
constexpr uint32_t kSysTickValue = 0xE000E018;
constexpr uint32_t kNvicEnable = 0xE000E100;  // one bit an interrupt
constexpr uint32_t kNvicDisable = 0xE000E180;
constexpr uint32_t kNvicPend = 0xE000E200;
constexpr uint32_t kNvicPriority = 0xE000E400;  // one byte an interrupt
constexpr uint32_t kInterruptState = 0xE000ED04;
constexpr uint32_t kVectorTable = 0xE000ED08;
constexpr uint32_t kSystemPriority3 = 0xE000ED20;  // SysTick in bits 24-31
constexpr uint32_t kFaultStatus = 0xE000ED28;
constexpr uint32_t kFloatDefaultStatus = 0xE000EF3C;
constexpr uint32_t kMpuType = 0xE000ED90, kMpuControl = 0xE000ED94, kMpuRegion = 0xE000ED98;
constexpr uint32_t kMpuBase = 0xE000ED9C, kMpuSize = 0xE000EDA0;  // Armv8-M: size is the limit
constexpr uint32_t kMpuAttributes = 0xE000EDC0;                   // Armv8-M only

// Lower is more urgent. A received byte is overwritten after 10 us at 1 Mbaud, so its handler (20
// instructions) preempts the servo's.
constexpr uint32_t kReceivePriority = 0x40;
constexpr uint32_t kServoPriority = 0x80;

inline void enable_interrupt(uint32_t number, uint32_t priority) {
  *reinterpret_cast<volatile uint8_t*>(static_cast<uintptr_t>(kNvicPriority + number)) =
      static_cast<uint8_t>(priority);
  reg(kNvicEnable + 4 * (number / 32)) = 1u << (number % 32);
}

/// Masks interrupts during the life of this object; the destructor restores the previous state.
class CriticalSection {
 public:
  CriticalSection() { asm volatile("mrs %0, primask\n cpsid i" : "=r"(before_)::"memory"); }
  ~CriticalSection() { asm volatile("msr primask, %0" ::"r"(before_) : "memory"); }
  CriticalSection(const CriticalSection&) = delete;
  CriticalSection& operator=(const CriticalSection&) = delete;

 private:
  uint32_t before_;
};

using Handler = void (*)();

/// Vectors behind the core's, up to that of the only interrupt that is enabled.
template <uint32_t kNumber>
struct BoardVectors {
  Handler unused[kNumber];
  Handler handler;
};

}  // namespace firmtouch::hal
