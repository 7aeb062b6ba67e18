# No flag decides what is computed. The arithmetic check built with fast-math, or with a part of it, is refused by the
# compiler or says at run time that the arithmetic is not sound; without the #errors it says so by itself; and a project
# around Firmtouch that sets such flags for everything gets sound arithmetic all the same. Read by tests/check/run.

# Of one compiler's flags, the others know the same. -fassociative-math alone is ignored by GCC: it needs the other two.
fast_math='-ffast-math:-funsafe-math-optimizations:-ffinite-math-only:-freciprocal-math:-fno-signed-zeros
-fassociative-math,-fno-signed-zeros,-fno-trapping-math'
no_errors='-U__FAST_MATH__,-U__ASSOCIATIVE_MATH__,-U__RECIPROCAL_MATH__,-U__FINITE_MATH_ONLY__'
source=firmware/firmtouch/math/arithmetic_check.cpp
arch='-DFIRMTOUCH_ARCH_HEADER="firmtouch/arch/hard_float/primitives.hpp"'

copies="CMakeLists.txt firmware hal tools/cmake"
compile() {  # compile FLAGS FROM TO: FLAGS divided by commas; no warnings
  # shellcheck disable=SC2046
  $compiler -std=c++17 -O2 -w -Ifirmware "$arch" $(printf %s "$1" | tr , ' ') -c "$2" -o "$3" 2>"$work/error"
}
# What comes of the check: sound, unsound, or refused. Linked without flags: GCC's fast-math start-up flushes denormals.
verdict_of() {  # verdict_of OBJECT...
  $compiler "$work/main.o" "$@" -o "$work/main" 2>"$work/error" || { echo unlinked; return; }
  if "$work/main"; then echo sound; else echo unsound; fi
}
built_with() {
  if compile "$1" $source "$work/check.o"; then
    verdict_of "$work/check.o"
  elif grep -q '#error\|error: Firmtouch\|error: "Firmtouch' "$work/error"; then
    echo refused
  else
    echo broken
  fi
}

with_flags() {
  [ "$(built_with -O2)" = sound ] || complain 'without flags it is not sound'
  for flags in $(printf %s "$fast_math" | tr ':' ' '); do
    case $(built_with "$flags") in
      refused | unsound) ;;
      *) complain "$flags is neither refused nor noticed" ;;
    esac
    [ "$(built_with "$flags,$no_errors")" = unsound ] || complain "$flags goes unnoticed at run time"
  done
  for flags in -ffast-math -ffinite-math-only; do  # every compiler reports these
    [ "$(built_with "$flags")" = refused ] || complain "$flags is not refused by math/isa.hpp"
  done
}

in_a_project() {
  mkdir -p "$work/project"
  cat >"$work/project/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.20)
project(around LANGUAGES CXX)
add_compile_options(-ffast-math -ffinite-math-only)
add_subdirectory("$(pwd -P)" firmtouch)
END
  cmake -S "$work/project" -B "$work/build" -DCMAKE_CXX_COMPILER="$(command -v $compiler)" \
    -DCMAKE_CXX_FLAGS='-ffast-math -fno-signed-zeros -freciprocal-math' -DFIRMTOUCH_WERROR=ON >"$work/log" 2>&1 &&
    cmake --build "$work/build" --target $targets >>"$work/log" 2>&1 || {
    complain 'a project with -ffast-math does not build'
    grep error "$work/log"
    return
  }
  [ "$(verdict_of "$work/build/firmtouch/firmware/libfirmtouch_math.a")" = sound ] ||
    complain 'a project with -ffast-math has other arithmetic'
}

check() {
  work=$(mktemp -d) || return 1
  bad=0
  targets='firmtouch_math firmtouch_query'
  [ -z "${only-}" ] || targets=firmtouch_math
  complain() { echo "$compiler: $1"; bad=1; }
  for compiler in g++ clang++; do
    command -v $compiler >/dev/null || continue
    printf '%s\n' '#include "firmtouch/math/arithmetic_check.hpp"' \
      'int main() { return firmtouch::math::arithmetic_is_sound() ? 0 : 1; }' >"$work/main.cpp"
    compile -O0 "$work/main.cpp" "$work/main.o" || complain 'the program around it does not compile'
    [ "${only-flags}" != flags ] || with_flags
    [ "${only-project}" != project ] || in_a_project
    [ $bad = 0 ] || break
  done
  rm -rf "$work"
  return $bad
}

mend() {  # mend FILE SED-SCRIPT: in place
  sed "$2" "$1" >mended
  mv mended "$1"
}
plant_no_word_on_nan() {
  only=flags
  mend firmware/firmtouch/math/isa.hpp '/^#if defined(__FINITE_MATH_ONLY__)/,/^#endif/d'
  expect='-ffinite-math-only is not refused'
}
plant_no_comparison_of_nan() {
  only=flags
  mend $source 's/refuses_nan() && //;s/^bool refuses_nan/[[maybe_unused]] &/'
  expect='-ffinite-math-only goes unnoticed at run time'
}
plant_no_look_at_the_order() {
  only=flags
  mend $source 's/is((one + tiny) - one, 0u) && //;s/is(run_time(kMinus) + 0.0f, 0u)/true/'
  expect='-fassociative-math,.* goes unnoticed at run time'
}
plant_no_look_at_quotients() {
  only=flags
  mend $source 's/is(run_time(0x40A00000u) \/ 3.0f, 0x3FD55555u) &&/true \&\&/'
  expect='-freciprocal-math goes unnoticed at run time'
}
plant_flags_that_do_not_win() {
  only=project
  mend firmware/cmake/firmtouch_options.cmake 's/-fno-unsafe-math-optimizations -fno-finite-math-only//'
  expect='a project with -ffast-math does not build'
}
plant_zeroes_without_a_sign() {
  only=project
  mend firmware/cmake/firmtouch_options.cmake 's/-fno-unsafe-math-optimizations//;s/-fsigned-zeros//'
  expect='a project with -ffast-math has other arithmetic'
}
