#pragma once
#include <stdint.h>

// A test harness without heap, exceptions or hosted headers, because the same tests run on the controller.
//
//     TEST(SliverTriangleAnswersItsLongestEdge) { CHECK(x); CHECK_EQ(a, b); CHECK_LE(a, b); }
//
// A name states a claim and is unique in its room. Files: *_test.cpp run everywhere; *_host_test.cpp on the host only.
namespace firmtouch::test {

struct Case {
  Case(const char* name, void (*run)());
  const char* name;
  void (*run)();
  Case* next = nullptr;
};

/// Where text goes; each platform's main sets it before run().
extern void (*print)(const char* text);

/// Runs the cases whose name is `only` (nullptr: all) and closes with `N passed, N failed`.
/// Result: 0 if at least one ran and none failed.
int run(const char* only);
void list();

void fail(const char* file, int line, const char* what);
void fail_values(const char* file, int line, const char* what, double a, double b);
/// Text that helps to rerun a random case, printed with the failures of the running test (a seed, a model's name).
void note(const char* text, int64_t value);

}  // namespace firmtouch::test

#define TEST(name)                                                   \
  static void test_##name();                                         \
  static ::firmtouch::test::Case case_##name(#name, test_##name);    \
  static void test_##name()

#define CHECK(condition) \
  do {                   \
    if (!(condition)) ::firmtouch::test::fail(__FILE__, __LINE__, #condition); \
  } while (0)
#define FIRMTOUCH_CHECK_COMPARE(a, op, b)                                                              \
  do {                                                                                                 \
    const auto left_ = (a);                                                                            \
    const auto right_ = (b);                                                                           \
    if (!(left_ op right_))                                                                            \
      ::firmtouch::test::fail_values(__FILE__, __LINE__, #a " " #op " " #b, static_cast<double>(left_), \
                                     static_cast<double>(right_));                                     \
  } while (0)
#define CHECK_EQ(a, b) FIRMTOUCH_CHECK_COMPARE(a, ==, b)
#define CHECK_NE(a, b) FIRMTOUCH_CHECK_COMPARE(a, !=, b)
#define CHECK_LE(a, b) FIRMTOUCH_CHECK_COMPARE(a, <=, b)
#define CHECK_LT(a, b) FIRMTOUCH_CHECK_COMPARE(a, <, b)
#define CHECK_GE(a, b) FIRMTOUCH_CHECK_COMPARE(a, >=, b)
