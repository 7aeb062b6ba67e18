#pragma once
#include <stdint.h>

#include "cortex-m/cortex_m.hpp"

namespace firmtouch::hal {

struct Frame {  // pushed by the core (ARM DDI 0403, B1.5.6)
  uint32_t r[4], r12, lr, pc, status;
};

/// Motors off, a report, stop. `frame` is null after a stack overflow.
extern "C" void report_fault(const Frame* frame);

}  // namespace firmtouch::hal
