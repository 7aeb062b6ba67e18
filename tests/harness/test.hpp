#pragma once
#include <stdint.h>

// A test harness without heap, exceptions or hosted headers, because the same tests run on the
// controller.
//
//     TEST(SliverTriangleAnswersItsLongestEdge) { CHECK(x); CHECK_EQ(a, b); CHECK_LE(a, b); }
//
// A name states a claim and is unique in its module. Files: *_test.cpp run everywhere;
// *_host_test.cpp on the host only.
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
/// Result: 0 if at least one passed and none failed; kSkipped if all were skipped; else 1.
int run(const char* only);
void list();

void fail(const char* file, int line, const char* what);
/// A compared value as failures show it: integers and enumerations in full, floats with nine
/// digits.
struct Value {
  enum class Kind { kSigned, kUnsigned, kFloat } kind;
  uint64_t bits;
  double number;
};
template <class T>
constexpr bool kIsFloat = false;
template <>
inline constexpr bool kIsFloat<float> = true;
template <>
inline constexpr bool kIsFloat<double> = true;
template <class T>
Value value_of(T value) {
  if constexpr (kIsFloat<T>) {
    return {Value::Kind::kFloat, 0, static_cast<double>(value)};
  } else if constexpr (__is_enum(T)) {
    return value_of(static_cast<__underlying_type(T)>(value));
  } else {
    constexpr bool kUnsigned = static_cast<T>(-1) > static_cast<T>(0);
    return {kUnsigned ? Value::Kind::kUnsigned : Value::Kind::kSigned, static_cast<uint64_t>(value),
            0};
  }
}
/// Exact equality, also of floats (-Wfloat-equal warns about ==). NaN is equal to nothing.
template <class A, class B>
bool equal(A a, B b) {
  if constexpr (kIsFloat<A> || kIsFloat<B>) {
    return a <= b && a >= b;
  } else {
    return a == b;
  }
}
void fail_values(const char* file, int line, const char* what, Value a, Value b);
/// Text printed with the failures of the running test, to rerun a random case: a seed, a model's
/// name.
void note(const char* text, int64_t value);
/// Marks the running test as skipped, neither passed nor failed (no real model is given). Return
/// after it.
void skip(const char* reason);
constexpr int kSkipped = 77;  // result of run(); CTest shows it as "Skipped"

}  // namespace firmtouch::test

#define TEST(name)                                                \
  static void test_##name();                                      \
  static ::firmtouch::test::Case case_##name(#name, test_##name); \
  static void test_##name()

#define CHECK(condition)                                                       \
  do {                                                                         \
    if (!(condition)) ::firmtouch::test::fail(__FILE__, __LINE__, #condition); \
  } while (0)
#define FIRMTOUCH_CHECK_COMPARE(a, op, b, holds)                           \
  do {                                                                     \
    const auto left_ = (a);                                                \
    const auto right_ = (b);                                               \
    if (!(holds)) {                                                        \
      ::firmtouch::test::fail_values(__FILE__, __LINE__, #a " " op " " #b, \
                                     ::firmtouch::test::value_of(left_),   \
                                     ::firmtouch::test::value_of(right_)); \
    }                                                                      \
  } while (0)
#define CHECK_EQ(a, b) FIRMTOUCH_CHECK_COMPARE(a, "==", b, ::firmtouch::test::equal(left_, right_))
#define CHECK_NE(a, b) FIRMTOUCH_CHECK_COMPARE(a, "!=", b, !::firmtouch::test::equal(left_, right_))
#define CHECK_LE(a, b) FIRMTOUCH_CHECK_COMPARE(a, "<=", b, left_ <= right_)
#define CHECK_LT(a, b) FIRMTOUCH_CHECK_COMPARE(a, "<", b, left_ < right_)
#define CHECK_GE(a, b) FIRMTOUCH_CHECK_COMPARE(a, ">=", b, left_ >= right_)
#define CHECK_GT(a, b) FIRMTOUCH_CHECK_COMPARE(a, ">", b, left_ > right_)
