#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <thread>

#include "firmtouch/core/handoff.hpp"
#include "harness/test.hpp"

namespace firmtouch::core {
namespace {

struct Words {
  uint32_t word[48] = {};
};

// Two threads, as in a simulator. ThreadSanitizer runs this too: it checks the memory model, not
// only this machine's behaviour.
TEST(Handoff_TwoThreads_TearNoRequestOrResult) {
  const bool is_long = std::getenv("FIRMTOUCH_LONG") != nullptr;
  const uint32_t wanted = is_long ? 1000000 : 100000;
  static Handoff<Words, Words> models;
  std::atomic<bool> is_over{false};
  uint32_t torn_requests = 0;
  std::thread geometry([&] {
    while (!is_over.load(std::memory_order_relaxed)) {
      const Words* request = models.requested();
      if (request == nullptr) {
        std::this_thread::yield();
        continue;
      }
      Words& draft = models.draft();
      for (uint32_t i = 0; i < 48; ++i) {
        if (request->word[i] != request->word[0]) ++torn_requests;
        draft.word[i] = ~request->word[i];
      }
      models.made();
    }
  });
  uint32_t taken = 0, torn_results = 0;
  while (taken < wanted) {
    if (models.take()) {
      for (const uint32_t word : models.result().word) torn_results += word != ~taken;
      ++taken;
    }
    if (models.is_idle()) {
      for (uint32_t& word : models.request_draft().word) word = taken;
      models.request();
    } else {
      std::this_thread::yield();
    }
  }
  is_over.store(true);
  geometry.join();
  CHECK_EQ(torn_requests, 0u);
  CHECK_EQ(torn_results, 0u);
}

}  // namespace
}  // namespace firmtouch::core
