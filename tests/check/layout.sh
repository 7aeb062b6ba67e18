# The shape of the tree: the five folders, small files, POSIX scripts, nothing left for later, nothing of one machine.
# Read by tests/check/run.

sources() {
  find firmware hal host_sim tests tools .ci -type f ! -name '*.swp' | LC_ALL=C sort
}

together=1
check() {
  bad=0
  complain() { echo "$1"; bad=1; }
  for entry in *; do
    [ -d "$entry" ] || continue
    case $entry in
      firmware | hal | host_sim | tests | tools | build) ;;
      *) complain "$entry/: the top level has only firmware, hal, host_sim, tests and tools" ;;
    esac
  done
  for file in CMakeLists.txt CMakePresets.json LICENSE README.md DESIGN.md SAFETY.md VERIFICATION.md tools/demo tools/test .ci/run \
    tools/FORMAT.md hal/PORTING.md .clang-format .clang-tidy; do
    [ -e "$file" ] || complain "$file is missing"
  done
  # Pages: their largest size in bytes; a module's page has at least 3,000.
  while read -r most page; do
    bytes=$(wc -c <"$page" 2>/dev/null) || { complain "$page is missing"; continue; }
    [ "$bytes" -le "$most" ] || complain "$page: $bytes bytes; $most is the most: say less, or say it in a module's README.md"
  done <<EOF
8000 README.md
20000 DESIGN.md
8000 SAFETY.md
20000 VERIFICATION.md
EOF
  for module in firmware/firmtouch/*/; do
    case $module in */arch/) continue ;; esac  # primitives of math
    page=${module}README.md
    bytes=$(wc -c <"$page" 2>/dev/null) || { complain "$page is missing: figure, algorithm, errors, cost, how to change it"; continue; }
    [ "$bytes" -le 10000 ] && [ "$bytes" -ge 3000 ] || complain "$page: $bytes bytes; 3,000 to 10,000 are a page"
  done
  for file in tools/demo tools/test .ci/run; do
    [ ! -e "$file" ] || [ -x "$file" ] || complain "$file is not executable: chmod +x"
  done
  sources | tr '\n' '\0' | xargs -0 awk '
    function complain(text) { print FILENAME ":" FNR ": " text; bad = 1 }
    FNR == 1 { flush() ; name = FILENAME; words = FILENAME ~ /^tests\/check\/layout\.sh$/ }
    { lines = FNR }
    name ~ /\.(cpp|hpp|h|c|cmake|awk|sh|txt|ld)$/ && / +$/ && name !~ /\.txt$/ { complain("ends in blanks") }
    name ~ /\.(cpp|hpp|h|sh|cmake|md)$/ && !words && /(^|[^A-Za-z_])(TODO|FIXME|XXX|HACK)([^A-Za-z_]|$)/ {
      complain("left for later: do it, or say in DESIGN.md what is not built")
    }
    !words && /(^|[^A-Za-z0-9_.\/])\/(work|home|root)\// { complain("a path of one machine") }
    name ~ /\.(cpp|hpp|h)$/ && length($0) > 100 && /\/\// { complain("a comment beyond 100 columns") }
    name ~ /\.hpp$/ && FNR < 12 && /^#pragma once/ { once[name] = 1 }
    function flush() {
      if (name == "") return
      if (name ~ /\.(cpp|hpp|h|c|sh|awk|cmake)$/ && lines > 400) {
        print name ": " lines " lines; 400 is the most: does it hold more than one idea?"; bad = 1
      }
      if (name ~ /\.hpp$/ && !(name in once)) { print name ": no #pragma once at its head"; bad = 1 }
    }
    END { flush(); exit bad }' || bad=1
  sources | grep -E '\.(cpp|hpp|h)$' | tr '\n' '\0' | xargs -0 awk -f "$here/functions.awk" || bad=1
  for example in tests/examples/*.cpp; do
    [ "$(wc -l <"$example")" -lt 120 ] || complain "$example: a first program has less than 120 lines"
    case $(head -n 1 "$example") in
      '// What you feel: '*) ;;
      *) complain "$example: does not open with what one feels" ;;
    esac
    grep -qF "](${example##*/})" tests/examples/README.md || complain "$example: not in the README.md beside it"
    picture=pictures/$(basename "$example" .cpp).svg
    [ -s "tests/examples/$picture" ] && grep -qF "($picture)" tests/examples/README.md && grep -qxF "// Picture: $picture" "$example" ||
      complain "$example: $picture is missing, or not named there and in the README.md"
  done
  # Scripts are for any POSIX shell; .ci/run is read by bash.
  scripts=
  for script in $(sources | grep -E '\.sh$|^tools/[a-z_]*$|^hal/[a-z_]*$|^tests/.*/[a-z_]*$|^\.ci/' | tr '\n' '\0' |
    xargs -0 awk 'FNR == 1 && (/^#!\/bin\/(ba)?sh/ || FILENAME ~ /\.sh$/) { print (/bash/ ? "bash:" : "sh:") FILENAME }'); do
    file=${script#*:} shell=$posix_shell
    case $script in
      bash:.ci/run) shell=bash ;;
      bash:*) complain "$file: scripts are POSIX sh" ;;
      *) scripts="$scripts $file" ;;
    esac
    text=$("$shell" -n "$file" 2>&1) || complain "$text"
  done
  # shellcheck disable=SC2086  # a word a file
  text=$(grep -nE '^[^#]*(\[\[ |<<<|^function |\blocal -|declare |<\(|&>|\$RANDOM|pipefail)' $scripts |
    grep -v 'grep -nE\|plant\|printf' | head -n 3)
  [ -z "$text" ] || complain "not POSIX sh: $text"
  return $bad
}
posix_shell=$(command -v dash || echo sh)

plant_folder() {
  mkdir docs
  expect='^docs/: the top level'
}
plant_long_file() {
  yes '// a line' | head -n 401 >>firmware/firmtouch/core/crc32.cpp
  expect='core/crc32.cpp: [0-9]* lines; 400 is the most'
}
lines() { yes "$1" | head -n "$2"; }
plant_long_function() {
  { echo 'float planted(float x) {'; lines '  x += 1.0f;' 78; echo '  return x;'; echo '}'; } >>firmware/firmtouch/core/crc32.cpp
  expect='core/crc32.cpp:[0-9]*: a function of 81 lines'
}
plant_long_test() {  # behind one of 80 lines, in a class, behind a template's head over two lines
  { echo 'TEST(Planted) {'; lines '  CHECK(true);' 78; echo '}'
    echo 'struct Planted {'; echo '  template <class A,'; echo '            class B>'; echo '  void run(A a, B b) {'; lines '    a = b;' 80
    echo '  }'; echo '};'; } >>tests/core/status_test.cpp
  expect='status_test.cpp:[0-9]*: a function of 84 lines'
}
plant_long_example() {
  lines '// a line' 120 >>tests/examples/wall.cpp
  expect='examples/wall.cpp: a first program has less than 120 lines'
}
plant_example_that_nobody_lists() {
  echo '// A wall.' >tests/examples/other_wall.cpp
  expect='examples/other_wall.cpp: not in the README.md beside it'
}
plant_example_without_a_picture() {
  rm tests/examples/pictures/friction.svg
  expect='examples/friction.cpp: pictures/friction.svg is missing'
}
plant_unguarded_header() {
  echo 'int f();' >firmware/firmtouch/core/planted.hpp
  expect='planted.hpp: no #pragma once'
}
plant_missing_file() {
  rm LICENSE
  expect='^LICENSE is missing'
}
plant_left_for_later() {
  echo '// TODO: bounds' >>firmware/firmtouch/core/crc32.cpp
  expect='crc32.cpp:[0-9]*: left for later'
}
plant_machine_path() {
  echo '# see /home/me/firmtouch' >>tests/CMakeLists.txt
  expect='tests/CMakeLists.txt:[0-9]*: a path of one machine'
}
plant_broken_script() {
  printf '#!/bin/sh\nif true; then\n' >tools/broken.sh
  expect='tools/broken.sh: .*yntax'
}
plant_bashism() {
  printf '#!/bin/sh\nif [[ -n $1 ]]; then echo; fi\n' >tools/bashism.sh
  expect='not POSIX sh: tools/bashism.sh:2'
}
plant_blanks() {
  printf 'int x;  \n' >firmware/firmtouch/core/planted.cpp
  expect='planted.cpp:1: ends in blanks'
}
plant_script_nobody_can_run() {
  chmod -x tools/test
  expect='tools/test is not executable'
}
plant_long_page() {
  yes 'One more sentence.' | head -n 500 >>SAFETY.md
  expect='^SAFETY.md: [0-9]* bytes; 8000 is the most'
}
plant_module_without_a_page() {
  rm firmware/firmtouch/mesh/README.md
  expect='^firmware/firmtouch/mesh/README.md is missing'
}
plant_wide_comment() {
  echo '// A comment that does not end before the hundredth column, which is where clang-format wraps it if it can.' >>firmware/firmtouch/core/crc32.cpp
  expect='crc32.cpp:[0-9]*: a comment beyond 100 columns'
}
