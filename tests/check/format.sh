# clang-format over every source that is there (found in the tree, not listed by git). Read by tests/check/run.
# Version 14 (Debian 12) decides: others lay out a few things differently.

not_run() {
  version_14 clang-format >/dev/null && return 1
  echo 'there is no clang-format 14'
}

together=1
check() {
  formatter=$(version_14 clang-format) || return 1
  complaints=$(find ${only:-firmware hal host_sim tests tools} -type f \( -name '*.cpp' -o -name '*.hpp' \) |
    LC_ALL=C sort | tr '\n' '\0' | xargs -0 "$formatter" --style=file --dry-run --Werror 2>&1 |
    grep 'error:' | LC_ALL=C sort -u -t: -k1,1)
  [ -z "$complaints" ] || {
    printf '%s\n' "$complaints" |
      sed 's/: error:.*/: not as clang-format lays it out: clang-format -i mends it/'
    return 1
  }
}

plant_wide_line() {
  only=firmware/firmtouch/core
  printf 'int   planted( int a ){return a;}\n' >>firmware/firmtouch/core/crc32.cpp
  expect='core/crc32.cpp:[0-9]*:[0-9]*: not as clang-format'
}
plant_in_a_test() {
  only="$only tests/core"
  printf 'int  planted;\n' >tests/core/planted_test.cpp
  expect='planted_test.cpp:1'
}
