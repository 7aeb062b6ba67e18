#include <cstdint>

#include "firmtouch/core/handoff.hpp"
#include "harness/single_step.hpp"
#include "harness/test.hpp"

// Single-steps the slow side's machine code, with a whole servo interrupt between any two
// instructions.
#if defined(FIRMTOUCH_SINGLE_STEP)

namespace firmtouch::core {
namespace {

// As large as a local model; all words are equal, so that a torn copy is visible.
struct Words {
  uint32_t word[48] = {};
};
using Models = Handoff<Words, Words>;

Words all(uint32_t value) {
  Words words;
  for (uint32_t& word : words.word) word = value;
  return words;
}
bool is_all(const Words& words, uint32_t value) {
  bool same = true;
  for (const uint32_t word : words.word) same = same && word == value;
  return same;
}

Models* g_models;
volatile uint32_t g_torn;
uint32_t g_used, g_requested, g_interrupts;

// One servo tick: takes a finished result, requests the next one, reads the current one.
void servo() {
  if (g_models->take()) g_used = g_requested;
  if (g_models->is_idle()) {
    g_models->request_draft() = all(++g_requested);
    g_models->request();
  }
  if (!is_all(g_models->result(), 2 * g_used)) g_torn = g_torn + 1;
}

// One turn of the geometry: the result is twice the request.
[[gnu::noinline]] void geometry(Models& models) {
  const Words* request = models.requested();
  if (request == nullptr) return;
  Words& draft = models.draft();
  for (uint32_t i = 0; i < 48; ++i) draft.word[i] = 2 * request->word[i];
  models.made();
}

void interrupt() {
  for (uint32_t i = 0; i < g_interrupts; ++i) servo();
}

// Result: false if the interrupt's position is beyond the end.
bool try_one(test::SingleStep& step, uint32_t before, uint32_t place, uint32_t interrupts) {
  Models models;
  g_models = &models;
  g_used = g_requested = 0;
  for (uint32_t i = 0; i < before; ++i) {  // so that each of the two results is in use once
    servo();
    geometry(models);
  }
  servo();
  g_interrupts = interrupts;
  const bool happened = step.run(place, interrupt, [&models] { geometry(models); });
  // Nothing is lost: the next turns take the result of every request.
  const uint32_t used = g_used;
  servo();
  geometry(models);
  servo();
  CHECK_GE(g_used, used + 1);
  CHECK_GE(g_used, before + 1);
  return happened;
}

TEST(Handoff_ServoTickBetweenAnyGeometryInstructions_TearsNothing) {
  test::SingleStep step;
  CHECK(step.is_ready());
  g_torn = 0;
  uint32_t places = 0;
  for (uint32_t turns = 0; turns < 3; ++turns) {
    for (uint32_t interrupts = 1; interrupts <= 3; ++interrupts) {
      uint32_t place = 0;
      while (try_one(step, turns, place, interrupts)) {
        // Every position of optimised code; samples of the longer sanitizer code.
        place += place < 400 ? 1 : place / 8;
        ++places;
      }
    }
  }
  CHECK_EQ(g_torn, 0u);
  CHECK_GE(places, 9u * 20u);  // single stepping did happen
}

}  // namespace
}  // namespace firmtouch::core

#endif
