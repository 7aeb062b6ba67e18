#include "harness/test.hpp"

namespace firmtouch::test {
namespace {

constexpr uint32_t kShownFailures = 5;  // per test; the first ones are enough for a diagnosis

Case* g_first = nullptr;
Case* g_last = nullptr;
const char* g_running = "";
uint32_t g_failures = 0;
const char* g_skipped = nullptr;
const char* g_note = nullptr;
int64_t g_note_value = 0;

bool same(const char* a, const char* b) {
  while (*a != 0 && *a == *b) ++a, ++b;
  return *a == *b;
}

void print_unsigned(uint64_t value, int width = 1) {
  char text[24];
  char* at = text + sizeof text;
  *--at = 0;
  while (value != 0 || width > 0) {
    *--at = static_cast<char>('0' + value % 10);
    value /= 10;
    --width;
  }
  print(at);
}

void print_int(int64_t value) {
  if (value < 0) print("-");
  print_unsigned(value < 0 ? 0 - static_cast<uint64_t>(value) : static_cast<uint64_t>(value));
}

// Nine significant digits, d.ddddddddex, so that different floats print differently; no C library.
void print_double(double value) {
  if (!(value - value <= 0)) return print(value > 0 ? "inf" : value < 0 ? "-inf" : "nan");
  if (value < 0) print("-"), value = -value;
  int64_t exponent = 0;
  while (value >= 10) value /= 10, ++exponent;
  while (value > 0 && value < 1) value *= 10, --exponent;
  uint64_t digits = static_cast<uint64_t>(value * 1e8 + 0.5);
  if (digits >= 1000000000) digits /= 10, ++exponent;
  print_unsigned(digits / 100000000), print("."), print_unsigned(digits % 100000000, 8);
  if (exponent != 0) print("e"), print_int(exponent);
}

void print_value(Value value) {
  if (value.kind == Value::Kind::kFloat) return print_double(value.number);
  if (value.kind == Value::Kind::kUnsigned) return print_unsigned(value.bits);
  print_int(static_cast<int64_t>(value.bits));
}

bool head(const char* file, int line, const char* what) {
  if (++g_failures > kShownFailures) return false;
  print("  "), print(file), print(":"), print_int(line), print(": ");
  print(g_running), print(": "), print(what);
  return true;
}

void tail() {
  if (g_note != nullptr)
    print("   ["), print(g_note), print(" "), print_int(g_note_value), print("]");
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

void fail_values(const char* file, int line, const char* what, Value a, Value b) {
  if (!head(file, line, what)) return;
  print("   ("), print_value(a), print(", "), print_value(b), print(")");
  tail();
}

void note(const char* text, int64_t value) {
  g_note = text;
  g_note_value = value;
}

void skip(const char* reason) { g_skipped = reason; }

void list() {
  for (const Case* c = g_first; c != nullptr; c = c->next) print(c->name), print("\n");
}

int run(const char* only) {
  int64_t passed = 0, failed = 0, skipped = 0;
  for (const Case* c = g_first; c != nullptr; c = c->next) {
    if (only != nullptr && !same(only, c->name)) continue;
    g_running = c->name;
    g_failures = 0;
    g_skipped = nullptr;
    g_note = nullptr;
    c->run();
    if (g_failures > kShownFailures) {
      print("  ... and "), print_int(g_failures - kShownFailures), print(" more\n");
    }
    const bool not_run = g_skipped != nullptr && g_failures == 0;
    print(g_failures != 0 ? "FAIL  " : not_run ? "skip  " : "ok    "), print(c->name);
    if (not_run) print(": "), print(g_skipped);
    print("\n");
    ++(g_failures != 0 ? failed : not_run ? skipped : passed);
  }
  print_int(passed), print(" passed, "), print_int(failed), print(" failed\n");
  if (failed == 0 && passed == 0 && skipped > 0) return kSkipped;
  return failed == 0 && passed > 0 ? 0 : 1;
}

}  // namespace firmtouch::test
