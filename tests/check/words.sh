# What freestanding code must not say: heap, exceptions, run-time types, virtual functions, double, the standard
# library. Comments and strings are taken out before. Read by tests/check/run.

check() {
  find firmware hal -type f \( -name '*.hpp' -o -name '*.cpp' -o -name '*.h' \) ! -path 'hal/posix/*' |
    LC_ALL=C sort | awk -f "$here/words.awk"
}

add() { printf '%s\n' "$2" >>"$1"; }
plant_new() {
  add firmware/firmtouch/mesh/planted.cpp 'int* f() { return new int(3); }'
  expect='mesh/planted.cpp:1: new'
}
plant_malloc() {
  add firmware/firmtouch/mesh/planted.cpp 'void* f() { return malloc(8); }'
  expect='planted.cpp:1: malloc'
}
plant_double() {
  add firmware/firmtouch/math/planted.cpp '/* a double in a comment is fine */ float f(double x);'
  expect='planted.cpp:1: double$'
}
plant_double_literal() {
  add firmware/firmtouch/math/planted.cpp 'float f(float x) { return x * 0.5; }'
  expect='planted.cpp:1: 0.5 is a double'
}
plant_double_literal_with_exponent() {
  add firmware/firmtouch/math/planted.cpp 'float f(float x) { return x * 1e-6; }'
  expect='planted.cpp:1: 1e-6 is a double'
}
plant_throw() {
  add firmware/firmtouch/servo/planted.cpp 'void f() { throw 1; }'
  expect='planted.cpp:1: throw'
}
plant_virtual() {
  add hal/libc/planted.cpp 'struct S { virtual void f(); };'
  expect='planted.cpp:1: virtual'
}
plant_standard_library() {
  add firmware/firmtouch/core/planted.cpp 'int f() { return std::min(1, 2); }'
  expect='planted.cpp:1: std::'
}
plant_word_after_a_comment() {
  printf '%s\n' '/* one' 'two */ int* f() { return new int; }' >firmware/firmtouch/core/planted.cpp
  expect='planted.cpp:2: new'
}
plant_fast_math() {
  add firmware/CMakeLists.txt 'target_compile_options(firmtouch_mesh PRIVATE -ffast-math)'
  expect='firmware/CMakeLists.txt:[0-9]*: -ffast-math'
}
