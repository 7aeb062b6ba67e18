#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <vector>

#include "app/moved_joints.hpp"
#include "app/tick_source.hpp"
#include "harness/test.hpp"
#include "servo_interrupt.hpp"

// The servo interrupt of the controller program itself, over joints that this test moves: what the
// motors get must not depend on what becomes of the records.
namespace firmtouch::app_test {
namespace {

constexpr uint32_t kTicks = 3000;

enum class Logging { kOff, kOn, kReaderStalled, kReaderSlow };

// What is done with the records in the main loop behind tick `i`.
void read_records(Logging logging, uint32_t i) {
  record::Numbered<record::TickRecord> slots[16];
  switch (logging) {
    case Logging::kOff:  // nobody listens: they are given back unread
      return app::records.release(app::records.ready().size());
    case Logging::kOn:
      while (app::records.pop(slots) > 0) {
      }
      return;
    case Logging::kReaderStalled:
      if (i >= 100) return;
      app::records.pop(slots);
      return;
    case Logging::kReaderSlow:
      if (i % 40 == 0) app::records.pop(slots);
  }
}

// The same run in a process of its own: the program's state is static.
std::vector<float> motors_with(Logging logging, uint32_t& dropped) {
  constexpr size_t kFloats = size_t{3} * kTicks;
  void* const shared = ::mmap(nullptr, kFloats * sizeof(float) + 8, PROT_READ | PROT_WRITE,
                              MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  CHECK(shared != MAP_FAILED);
  auto* const counted = reinterpret_cast<uint32_t*>(static_cast<float*>(shared) + kFloats);
  const pid_t child = ::fork();
  if (child == 0) {
    joints.motors = static_cast<float*>(shared);
    AssetFile asset(FIRMTOUCH_TEST_ASSET);
    if (!app::controller.open(asset.bytes()).ok()) ::_exit(1);
    for (joints.tick = 0; joints.tick < kTicks; ++joints.tick) {
      if (joints.tick == 600) app::commands.put(params::kContactStiffness, 650.0f);
      app::servo_interrupt();
      read_records(logging, joints.tick);
    }
    *counted = app::records.dropped();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  const float* const written = static_cast<const float*>(shared);
  const std::vector<float> motors(written, written + kFloats);
  dropped = *counted;
  ::munmap(shared, kFloats * sizeof(float) + 8);
  return motors;
}

TEST(TheMotorsGetTheSameBitsWithLoggingOnOffAndItsReaderStalled) {
  uint32_t dropped = 0;
  const std::vector<float> on = motors_with(Logging::kOn, dropped);
  CHECK_EQ(dropped, 0u);
  uint32_t pressed = 0;
  for (const float motor_N : on) pressed += motor_N > 0.1f || motor_N < -0.1f ? 1 : 0;
  CHECK_GE(pressed, 500u);  // it does push
  const auto same = [&](const std::vector<float>& other) {
    return std::memcmp(on.data(), other.data(), on.size() * sizeof(float)) == 0;
  };
  CHECK(same(motors_with(Logging::kOff, dropped)));
  CHECK_EQ(dropped, 0u);
  CHECK(same(motors_with(Logging::kReaderStalled, dropped)));
  CHECK_EQ(dropped, kTicks - 100 - 64);  // all but what was read and what the ring holds
  CHECK(same(motors_with(Logging::kReaderSlow, dropped)));
  CHECK_GE(dropped, 1000u);
}

}  // namespace
}  // namespace firmtouch::app_test
