#pragma once
#include <stdint.h>

#include <map>

// Instead of hal/cortex-m/cortex_m.hpp: registers that a test reads and writes.
namespace firmtouch::hal {

inline std::map<uint32_t, uint32_t> registers;

inline volatile uint32_t& reg(uint32_t address) { return registers[address]; }

struct CriticalSection {
  CriticalSection() {}
  ~CriticalSection() {}
};

}  // namespace firmtouch::hal
