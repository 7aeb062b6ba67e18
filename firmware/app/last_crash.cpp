#include "last_crash.hpp"

#include "firmtouch/hal/crash_record.hpp"

namespace firmtouch::app {
namespace {

link::CrashReply g_last;

}  // namespace

void take_crash() {
  g_last.is_left = hal::crash_take(g_last.record) ? 1 : 0;
  if (g_last.is_left != 0) hal::crash_print(g_last.record);
}

const link::CrashReply& last_crash() { return g_last; }

}  // namespace firmtouch::app
