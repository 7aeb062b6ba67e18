#pragma once
#include <stdint.h>

#include <map>

// Instead of hal/cortex-m/cortex_m.hpp: registers that a test reads and writes.
namespace firmtouch::hal {

inline std::map<uint32_t, uint32_t> registers;

inline std::map<uint32_t, uint16_t> registers16;

inline volatile uint32_t& reg(uint32_t address) { return registers[address]; }
inline volatile uint16_t& reg16(uint32_t address) { return registers16[address]; }

struct CriticalSection {
  CriticalSection() {}
  ~CriticalSection() {}
};

}  // namespace firmtouch::hal
