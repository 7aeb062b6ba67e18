#include "batch/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace firmtouch::tools {

uint32_t processors() { return std::max(1u, std::thread::hardware_concurrency()); }

void in_parallel(uint64_t count, uint32_t threads, const std::function<void(uint64_t)>& work,
                 const std::function<void(double)>& progress) {
  std::atomic<uint64_t> next{0};
  uint64_t done = 0;
  std::mutex mutex;
  std::exception_ptr failed;
  const auto run = [&] {
    for (uint64_t i; (i = next++) < count;) {
      std::exception_ptr thrown;
      try {
        work(i);
      } catch (...) {
        thrown = std::current_exception();
        next = count;
      }
      const std::lock_guard<std::mutex> lock(mutex);
      if (!failed) failed = thrown;
      if (++done; progress && !failed)
        progress(static_cast<double>(done) / static_cast<double>(count));
    }
  };
  std::vector<std::thread> others;
  for (uint64_t t = 1; t < std::min<uint64_t>(threads, count); ++t) others.emplace_back(run);
  run();
  for (std::thread& other : others) other.join();
  if (failed) std::rethrow_exception(failed);
}

}  // namespace firmtouch::tools
