# What freestanding code must not say: heap, exceptions, run-time types, virtual functions, double, the standard
# library. Comments and strings are taken out before. Read by tests/check/run.

together=1
check() {
  find firmware hal -type f \( -name '*.hpp' -o -name '*.cpp' -o -name '*.h' \) ! -path 'hal/posix/*' |
    LC_ALL=C sort | awk -f "$here/words.awk"
}
plants() {
  cat <<'END'
new @ firmware/firmtouch/mesh/planted.cpp @ int* f() { return new int(3); } @ mesh/planted.cpp:[0-9]*: new
malloc @ firmware/firmtouch/mesh/planted.cpp @ void* f() { return malloc(8); } @ planted.cpp:[0-9]*: malloc
double @ firmware/firmtouch/math/planted.cpp @ /* a double in a comment is fine */ float f(double x); @ planted.cpp:[0-9]*: double$
double_literal @ firmware/firmtouch/math/planted.cpp @ float f(float x) { return x * 0.5; } @ planted.cpp:[0-9]*: 0.5 is a double
double_literal_with_exponent @ firmware/firmtouch/math/planted.cpp @ float f(float x) { return x * 1e-6; } @ planted.cpp:[0-9]*: 1e-6 is a double
throw @ firmware/firmtouch/servo/planted.cpp @ void f() { throw 1; } @ planted.cpp:1: throw
virtual @ hal/libc/planted.cpp @ struct S { virtual void f(); }; @ planted.cpp:1: virtual
standard_library @ firmware/firmtouch/core/planted.cpp @ int f() { return std::min(1, 2); } @ planted.cpp:1: std::
fast_math @ firmware/CMakeLists.txt @ target_compile_options(firmtouch_mesh PRIVATE -ffast-math) @ firmware/CMakeLists.txt:[0-9]*: -ffast-math
END
}

plant_word_after_a_comment() {
  printf '%s\n' '/* one' 'two */ int* f() { return new int; }' >firmware/firmtouch/core/two_lines.cpp
  expect='two_lines.cpp:2: new'
}
