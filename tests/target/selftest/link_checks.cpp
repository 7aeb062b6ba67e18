#include "target/selftest/selftest.hpp"

namespace firmtouch::selftest {
namespace {

constexpr uint32_t kCount = 64;

// Control characters too: a terminal between the two changes some of them.
uint8_t byte_at(uint32_t i) { return static_cast<uint8_t>(i * 67 + 3); }

uint32_t g_read = 0, g_matched = 0;

/// Sends the bytes once. Result: whether they came back in order, now or from an earlier time.
bool echo() {
  uint32_t sent = 0;
  const uint32_t from = servo.ticks;
  while (g_matched < kCount && servo.ticks - from < 2000) {
    uint8_t bytes[kCount];
    for (uint32_t i = sent; i < kCount; ++i) bytes[i] = byte_at(i);
    if (sent < kCount) sent += hal::link_write(bytes + sent, kCount - sent);
    const uint32_t count = hal::link_read(bytes, kCount);
    g_read += count;
    for (uint32_t i = 0; i < count && g_matched < kCount; ++i)
      g_matched = bytes[i] == byte_at(g_matched) ? g_matched + 1 : bytes[i] == byte_at(0) ? 1 : 0;
  }
  return g_matched == kCount;
}

}  // namespace

void check_link() {
  show(Prompt::kEchoLink);
  check("link_write, link_read", comes(echo, kEcho_ms),
        g_read == 0 ? "nothing came back. " : "other bytes came back: baud rate, or a terminal. ",
        hal::board_wiring(hal::Wire::kLink, 0));
  const uint32_t from_us = hal::clock_us();
  for (uint32_t i = 0; i < 10; ++i) {
    servo.called = "link_wait";
    hal::link_wait();
    servo.called = nullptr;
  }
  check("link_wait", hal::clock_us() - from_us <= 30000, "it sleeps longer than 2 ms");
}

}  // namespace firmtouch::selftest
