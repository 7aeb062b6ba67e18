#pragma once
#include <cstdint>
#include <functional>

namespace firmtouch::tools {

/// Processors of this machine; at least 1.
uint32_t processors();

/// Calls work(0) to work(count - 1), each once, on `threads` threads. `progress`: share that is
/// done, from one thread at a time. Throws what the first failing call threw, once the calls that
/// run have ended; the others are left out.
void in_parallel(uint64_t count, uint32_t threads, const std::function<void(uint64_t)>& work,
                 const std::function<void(double)>& progress = {});

}  // namespace firmtouch::tools
