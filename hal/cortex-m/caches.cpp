#include "cortex-m/caches.hpp"

#include "cortex-m/cortex_m.hpp"

namespace firmtouch::hal {
namespace {

constexpr uint32_t kCacheControl = 0xE000ED14, kBoth = 3u << 16;
constexpr uint32_t kCacheSize = 0xE000ED80, kCacheSelect = 0xE000ED84;
constexpr uint32_t kDropInstructions = 0xE000EF50, kDropData = 0xE000EF60;

void barrier() { asm volatile("dsb\n isb" ::: "memory"); }

}  // namespace

// The data cache has 4 ways of lines of 32 bytes (ARM DDI 0489, B2.2); its size is the chip's.
void caches_begin() {
  if ((reg(kCacheControl) & kBoth) != 0) return;
  reg(kCacheSelect) = 0;
  barrier();
  const uint32_t sets = (reg(kCacheSize) >> 13 & 0x7FFFu) + 1;
  reg(kDropInstructions) = 0;
  for (uint32_t way = 0; way < 4; ++way)
    for (uint32_t set = 0; set < sets; ++set) reg(kDropData) = way << 30 | set << 5;
  barrier();
  reg(kCacheControl) = reg(kCacheControl) | kBoth;
  barrier();
}

}  // namespace firmtouch::hal
