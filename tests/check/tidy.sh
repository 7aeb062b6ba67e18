# clang-tidy over every source of the firmware that the host build compiles (.clang-tidy says by which rules). Needs
# build/host/compile_commands.json, which tools/test makes. Version 14 (Debian 12) decides: others know other rules.
# Read by tests/check/run; takes a minute, so only tools/test --long runs it.

not_run() {
  version_14 clang-tidy >/dev/null && return 1
  echo 'there is no clang-tidy 14'
}

files=
check() {
  commands=$root/build/host/compile_commands.json
  [ -r "$commands" ] || {
    echo "no $commands: cmake --preset host -DCMAKE_EXPORT_COMPILE_COMMANDS=ON makes it"
    return 1
  }
  # For the tree at hand, which may be a copy.
  place=$(mktemp -d) || return 1
  for folder in firmware hal; do printf 's|%s/%s|%s/%s|g\n' "$root" $folder "$PWD" $folder; done >"$place/rules"
  sed -f "$place/rules" "$commands" >"$place/compile_commands.json"
  bad=0
  checked=0
  for file in ${files:-$(find firmware -name '*.cpp' | LC_ALL=C sort)}; do
    grep -qF "\"$PWD/$file\"" "$place/compile_commands.json" || continue  # of a board
    checked=$((checked + 1))
    # Some of the warnings are GCC's alone.
    "$(version_14 clang-tidy)" -p "$place" --extra-arg=-std=c++17 --extra-arg=-Wno-unknown-warning-option --quiet "$file" \
      >"$place/said" 2>"$place/noise" || {
      grep -E 'error:|warning:' "$place/said" || cat "$place/said" "$place/noise"
      bad=1
    }
  done
  rm -rf "$place"
  [ $checked -gt 0 ] || { echo "$commands names no source of the firmware"; bad=1; }
  return $bad
}

plant() {  # plant FILE TEXT
  files=$1
  printf '%s\n' "$2" >>"$1"
}
plant_name() {
  plant firmware/firmtouch/core/crc32.cpp 'namespace firmtouch { int PlantedName() { return 1; } }'
  expect='core/crc32.cpp:[0-9]+:[0-9]+: error: invalid case style for function .PlantedName'
}
plant_suspicious_code() {
  plant firmware/firmtouch/core/crc32.cpp 'namespace firmtouch { int planted(int a) { return a & 1 ? sizeof(sizeof(a)) : 0; } }'
  expect='core/crc32.cpp:[0-9]+:[0-9]+: error: .*bugprone-sizeof-expression'
}
