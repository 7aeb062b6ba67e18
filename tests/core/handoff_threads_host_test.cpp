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

// Two cores at it, as a simulator's threads: run by ThreadSanitizer too, which knows the memory
// model where this machine shows only its own.
TEST(TwoThreadsHandQuestionsAndAnswersOverWithoutATornOne) {
  const bool is_long = std::getenv("FIRMTOUCH_LONG") != nullptr;
  const uint32_t wanted = is_long ? 1000000 : 100000;
  static Handoff<Words, Words> models;
  std::atomic<bool> is_over{false};
  uint32_t torn_questions = 0;
  std::thread geometry([&] {
    while (!is_over.load(std::memory_order_relaxed)) {
      const Words* question = models.asked();
      if (question == nullptr) {
        std::this_thread::yield();
        continue;
      }
      Words& draft = models.draft();
      for (uint32_t i = 0; i < 48; ++i) {
        if (question->word[i] != question->word[0]) ++torn_questions;
        draft.word[i] = ~question->word[i];
      }
      models.made();
    }
  });
  uint32_t taken = 0, torn_answers = 0;
  Words next;
  while (taken < wanted) {
    if (models.take()) {
      for (const uint32_t word : models.answer().word) torn_answers += word != ~taken;
      ++taken;
    }
    if (models.is_idle()) {
      for (uint32_t& word : next.word) word = taken;
      CHECK(models.ask(next));
    } else {
      std::this_thread::yield();
    }
  }
  is_over.store(true);
  geometry.join();
  CHECK_EQ(torn_questions, 0u);
  CHECK_EQ(torn_answers, 0u);
}

}  // namespace
}  // namespace firmtouch::core
