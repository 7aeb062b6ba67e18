#include "firmtouch/hal/crash_record.hpp"

#include "crash_record/kept.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/watchdog.hpp"
#include "parts/fault_text.hpp"

namespace firmtouch::hal {
namespace {

// FNV-1a over words: each step is one-to-one, so no single changed word goes unnoticed.
uint32_t check_of(const uint32_t (&words)[4]) {
  uint32_t check = 2166136261u;
  for (const uint32_t word : words) check = (check ^ word) * 16777619u;
  return check;
}

// The highest number of a whole entry, or false.
bool find_newest(uint32_t& newest) {
  bool found = false;
  for (const Kept& kept : g_crash_ticks) {
    if (!kept.is_whole() || (found && static_cast<int32_t>(kept.words[0] - newest) < 0)) continue;
    newest = kept.words[0];
    found = true;
  }
  return found;
}

}  // namespace

[[gnu::section(".noinit")]] Kept g_crash_cause, g_crash_ticks[kCrashTicks];

void Kept::set(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  words[0] = a, words[1] = b, words[2] = c, words[3] = d;
  check = check_of(words);
}
bool Kept::is_whole() const { return check == check_of(words); }

void crash_keep_tick(const CrashTick& tick) {
  g_crash_ticks[tick.tick % kCrashTicks].set(tick.tick, tick.clock_us, tick.state, tick.faults);
}

void crash_keep_cause(CrashCause cause, uint32_t pc, uint32_t link, uint32_t status) {
  if (g_crash_cause.is_whole()) return;
  g_crash_cause.set(static_cast<uint32_t>(cause), pc, link, status);
}

[[gnu::weak]] bool watchdog_has_reset() { return false; }

bool crash_take(CrashRecord& record) {
  record = {};
  if (watchdog_has_reset()) record.cause = CrashCause::kWatchdog;
  const bool has_cause = g_crash_cause.is_whole();
  if (has_cause) {
    const uint32_t(&words)[4] = g_crash_cause.words;
    record.cause = static_cast<CrashCause>(words[0]);
    record.pc = words[1], record.link = words[2], record.status = words[3];
  }
  uint32_t newest = 0;
  const bool has_ticks = find_newest(newest);
  for (uint32_t back = kCrashTicks; has_ticks && back-- > 0;) {
    const Kept& kept = g_crash_ticks[(newest - back) % kCrashTicks];
    if (!kept.is_whole() || kept.words[0] != newest - back) continue;
    record.last[record.ticks++] = {kept.words[0], kept.words[1], kept.words[2], kept.words[3]};
  }
  g_crash_cause.check = ~check_of(g_crash_cause.words);
  for (Kept& kept : g_crash_ticks) kept.check = ~check_of(kept.words);
  return has_cause || has_ticks;
}

void crash_print(const CrashRecord& record) {
  const char* const causes[] = {"a reset without a fault", "a fault", "a stack overflow",
                                "the watchdog"};
  const uint32_t cause = static_cast<uint32_t>(record.cause);
  board_print("The last run was ended by ");
  board_print(causes[cause < 4 ? cause : 0]);
  board_print(": ");
  print_hex("pc ", record.pc);
  print_hex("lr ", record.link);
  print_hex("status ", record.status);
  board_print("(find pc and lr with addr2line). Its last ticks:\n");
  for (uint32_t i = 0; i < record.ticks; ++i) {
    print_hex("  tick ", record.last[i].tick);
    print_hex("clock_us ", record.last[i].clock_us);
    print_hex("state ", record.last[i].state);
    print_hex("faults ", record.last[i].faults);
    board_print("\n");
  }
}

}  // namespace firmtouch::hal
