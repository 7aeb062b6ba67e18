# Public headers compile alone, without a warning, and hold no floating-point arithmetic: there a user's flags (contraction,
# fast-math) would change the answers' bits. Looked for in what the compiler makes of every inline function; functions
# that are templates are seen only where a header uses them. A header for the library's own units says so in its first
# lines ("own translation units", "for .cpp files", "for x.cpp alone"): no public header and no user's program may reach it.
# Read by tests/check/run.

copies="firmware hal tests/consumer"
private_headers() {
  echo firmware/firmtouch/math/isa.hpp
  find firmware/firmtouch -name '*.hpp' -exec awk '
    FNR == 1 { words = "" }
    FNR > 1 && FNR <= 8 && words != "found" {
      sub(/^\/\/ */, "")
      words = words $0 " "
      if (tolower(words) ~ /own translation units|for [a-z_]*\.cpp (files|alone)/) { print FILENAME; words = "found" }
    }' {} +
}

compile() {  # compile OPTION... <SOURCE
  ${CXX:-g++} -std=c++17 -O0 -ffreestanding -fno-exceptions -fno-rtti -Wall -Wextra -Wconversion -Wdouble-promotion -Wfloat-equal \
    -Wshadow -Werror -Ifirmware -Ihal -x c++ "$@" -
}
arithmetic_of() {  # arithmetic_of HEADER...: names the functions with floating-point arithmetic
  printf '#include "%s"\n' "$@" | compile -S -fkeep-inline-functions -o "$work/out.s" || return
  awk '/^[_A-Za-z].*:$/ { name = $1 }
    /^[ \t]+v?(add|sub|mul|div|sqrt|fmadd)[0-9]*s[sd][ \t]/ || /^[ \t]+f(add|sub|mul|div|madd|msub|sqrt)[ \t]/ { print name }
    ' "$work/out.s" | sort -u | tr '\n' ' '
}

check() {
  work=$(mktemp -d) || return 1
  private_headers | LC_ALL=C sort -u >"$work/private"
  bad=0
  headers=$(find firmware/firmtouch hal/firmtouch -name '*.hpp' | grep -x "${only:-.*}" | grep -vxF -f "$work/private" | LC_ALL=C sort)
  : >"$work/uses"
  for header in $headers; do
    if printf '#include "%s"\n' "${header#*/}" | compile -fsyntax-only -MMD -MF "$work/use" -MT "$header"; then
      cat "$work/use" >>"$work/uses"
    else
      echo "$header: does not compile alone"
      bad=1
    fi
  done
  tr -s ' \\' '\n' <"$work/uses" | awk '
    NR == FNR { private[$1] = 1; next }
    sub(/:$/, "") { header = $1 }
    $1 in private { print header ": public, and reaches " $1 ", which is for the library\047s own units"; bad = 1 }
    END { exit bad }' "$work/private" - || bad=1
  [ $bad = 0 ] || headers=
  # All of them at once; one by one where there is something to find.
  set -- $(printf '%s\n' $headers | sed 's|^[^/]*/||')
  if [ $# -gt 0 ] && [ -n "$(arithmetic_of "$@" || echo unknown)" ]; then
    echo 'the public headers together have floating-point arithmetic, or do not compile:'
    for header in $headers; do
      arithmetic=$(arithmetic_of "${header#*/}")
      [ -z "$arithmetic" ] || echo "$header: floating-point arithmetic in a public header, in ${arithmetic}move it to a .cpp file"
    done
    bad=1
  fi
  for file in $(find tests/consumer firmware/app -name '*.?pp' 2>/dev/null); do
    for used in $(sed -n 's/^#include "\(firmtouch\/.*\)".*/firmware\/\1/p' "$file"); do
      if grep -qx "$used" "$work/private"; then
        echo "$file: uses $used, which is for the library's own units"
        bad=1
      fi
    done
  done
  rm -rf "$work"
  return $bad
}

plant_sum() {
  only=firmware/firmtouch/math/vec3.hpp
  echo 'inline float planted_sum(float a, float b) { return a + b; }' >>$only
  expect='math/vec3.hpp: floating-point arithmetic in a public header, in .*planted_sum'
}
plant_product_in_a_member() {
  only=firmware/firmtouch/query/hint.hpp
  echo 'struct Planted { float v; float twice() const { return v * 2.0f; } };' >>$only
  expect='query/hint.hpp: floating-point arithmetic.*twice'
}
plant_operators_reached() {
  only=firmware/firmtouch/mesh/planted.hpp
  printf '#pragma once\n#include "firmtouch/mesh/planted_private.hpp"\n' >$only
  printf '#pragma once\n// For .cpp files.\n#include "firmtouch/math/vec3_ops.hpp"\n' >firmware/firmtouch/mesh/planted_private.hpp
  expect='mesh/planted.hpp: public, and reaches firmware/firmtouch/math/vec3_ops.hpp'
}
plant_header_that_leans_on_others() {
  only=firmware/firmtouch/core/planted.hpp
  printf '#pragma once\nuint32_t planted();\n' >$only
  expect='core/planted.hpp: does not compile alone'
}
plant_private_header_in_a_program() {
  only=none
  mkdir -p tests/consumer
  echo '#include "firmtouch/math/vec3_ops.hpp"' >tests/consumer/planted.cpp
  expect='tests/consumer/planted.cpp: uses firmware/firmtouch/math/vec3_ops.hpp'
}
