#include "turn_watch.hpp"

#include "harness/test.hpp"

namespace firmtouch::app_test {
namespace {

TEST(MainLoopThatTurnsAtTheSlowestIsAlive) {
  app::TurnWatch watch;
  for (uint32_t turn = 0; turn < 50; ++turn) {
    watch.count();
    for (uint32_t tick = 0; tick <= 100; ++tick) CHECK(watch.is_alive(100));
  }
}

TEST(MainLoopThatStandsStillIsNotAlive_UntilItTurnsAgain) {
  app::TurnWatch watch;
  watch.count();
  for (uint32_t tick = 0; tick <= 100; ++tick) CHECK(watch.is_alive(100));
  for (uint32_t tick = 0; tick < 1000; ++tick) CHECK(!watch.is_alive(100));
  watch.count();
  CHECK(watch.is_alive(100));
}

TEST(MainLoopThatStopped_IsReported) {
  app::TurnWatch watch;
  uint32_t ticks = 0;
  while (watch.is_alive(3) && ticks < 10) ++ticks;
  CHECK_EQ(ticks, 3u);
}

}  // namespace
}  // namespace firmtouch::app_test
