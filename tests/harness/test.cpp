#include "harness/test.hpp"

namespace firmtouch::test {
namespace {

constexpr uint32_t kShownFailures = 5;  // of one test: the first ones tell, thousands of them hide

Case* g_first = nullptr;
Case* g_last = nullptr;
const char* g_running = "";
uint32_t g_failures = 0;
const char* g_note = nullptr;
int64_t g_note_value = 0;

bool same(const char* a, const char* b) {
  while (*a != 0 && *a == *b) ++a, ++b;
  return *a == *b;
}

void print_int(int64_t value) {
  char text[24];
  char* at = text + sizeof text;
  *--at = 0;
  uint64_t rest = value < 0 ? 0 - static_cast<uint64_t>(value) : static_cast<uint64_t>(value);
  do {
    *--at = static_cast<char>('0' + rest % 10);
    rest /= 10;
  } while (rest != 0);
  if (value < 0) *--at = '-';
  print(at);
}

// Seven significant digits, d.dddddde+-x: enough to see what is wrong, without a C library.
void print_double(double value) {
  if (!(value - value <= 0)) return print(value > 0 ? "inf" : value < 0 ? "-inf" : "nan");
  if (value < 0) print("-"), value = -value;
  int64_t exponent = 0;
  if (value > 0) {
    while (value >= 10) value /= 10, ++exponent;
    while (value < 1) value *= 10, --exponent;
  }
  int64_t digits = static_cast<int64_t>(value * 1000000 + 0.5);
  print_int(digits / 1000000);
  print(".");
  for (int64_t unit = 100000; unit > 0; unit /= 10) {
    const char digit[2] = {static_cast<char>('0' + digits / unit % 10), 0};
    print(digit);
  }
  if (exponent != 0) print("e"), print_int(exponent);
}

bool head(const char* file, int line, const char* what) {
  if (++g_failures > kShownFailures) return false;
  print("  "), print(file), print(":"), print_int(line), print(": ");
  print(g_running), print(": "), print(what);
  return true;
}

void tail() {
  if (g_note != nullptr) print("   ["), print(g_note), print(" "), print_int(g_note_value), print("]");
  print("\n");
}

}  // namespace

void (*print)(const char* text) = nullptr;

Case::Case(const char* its_name, void (*its_run)()) : name(its_name), run(its_run) {
  (g_first == nullptr ? g_first : g_last->next) = this;
  g_last = this;
}

void fail(const char* file, int line, const char* what) {
  if (head(file, line, what)) tail();
}

void fail_values(const char* file, int line, const char* what, double a, double b) {
  if (!head(file, line, what)) return;
  print("   ("), print_double(a), print(", "), print_double(b), print(")");
  tail();
}

void note(const char* text, int64_t value) {
  g_note = text;
  g_note_value = value;
}

void list() {
  for (const Case* c = g_first; c != nullptr; c = c->next) print(c->name), print("\n");
}

int run(const char* only) {
  int64_t passed = 0, failed = 0;
  for (const Case* c = g_first; c != nullptr; c = c->next) {
    if (only != nullptr && !same(only, c->name)) continue;
    g_running = c->name;
    g_failures = 0;
    g_note = nullptr;
    c->run();
    if (g_failures > kShownFailures) print("  ... and "), print_int(g_failures - kShownFailures), print(" more\n");
    print(g_failures == 0 ? "ok    " : "FAIL  "), print(c->name), print("\n");
    ++(g_failures == 0 ? passed : failed);
  }
  print_int(passed), print(" passed, "), print_int(failed), print(" failed\n");
  return failed == 0 && passed > 0 ? 0 : 1;
}

}  // namespace firmtouch::test
