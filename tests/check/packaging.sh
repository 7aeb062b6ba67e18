# The package of tools/packaging/pack: each manifest has the keys that its schema requires, the version of version.hpp, and
# names only files that are there, every source among them; the flags are those of CMake's targets; the build id is CMake's.
# Read by tests/check/run. Schemas: Arduino library specification 1.5; PlatformIO library.json; Zephyr's zephyr_module.py;
# Open-CMSIS-Pack PACK.xsd.

copies="CHANGELOG.md LICENSE firmware hal/firmtouch tools/packaging"
properties() {
  for key in name version author maintainer sentence paragraph category url architectures; do
    grep -qE "^$key=.+" "$1" || complain "library.properties: no $key"
  done
  grep -qx "version=$version" "$1" || complain "library.properties: another version than $version"
  grep -v '^[a-z]*=' "$1" && complain 'library.properties: a line without a key'
  for header in $(sed -n 's/^includes=//p' "$1"); do [ -e "$made/src/$header" ] || complain "library.properties: no src/$header"; done
}
json() {
  for key in name version description keywords; do grep -qE "^  \"$key\": (\"[^\"]+\"|\[.+\])," "$1" || complain "library.json: no $key"; done
  grep -qx "  \"version\": \"$version\"," "$1" || complain "library.json: another version than $version"
  # A member a line: commas behind all but the last, quotes and brackets in pairs.
  awk 'NR == 1 { bad = $0 != "{"; next }
    NR > 2 && (last ~ /,$/) == ($0 == "}") { bad = 1 }
    { last = text = $0; gsub(/"[^"]*"/, "", text); opened = gsub(/[[{]/, "", text); if (text ~ /"/ || opened != gsub(/[]}]/, "", text) - ($0 == "}")) bad = 1 }
    END { exit bad || last != "}" }' "$1" || complain 'library.json: is no JSON'
  for flag in $arithmetic; do grep -qF "\"$flag\"" "$1" || complain "library.json: no $flag"; done
}
module() {
  for key in name: '  cmake:' '  kconfig:'; do grep -qE "^$key [a-zA-Z/]+$" "$made/zephyr/module.yml" || complain "module.yml: no $key"; done
  for flag in $arithmetic; do grep -qF -- "$flag" "$made/zephyr/CMakeLists.txt" || complain "zephyr: no $flag"; done
  [ -f "$made/$(sed -n 's/^  cmake: //p' "$made/zephyr/module.yml")/CMakeLists.txt" ] || complain 'module.yml: no CMakeLists.txt'
  [ -f "$made/$(sed -n 's/^  kconfig: //p' "$made/zephyr/module.yml")" ] || complain 'module.yml: no Kconfig'
  for header in $(grep -oE 'firmtouch/arch/[a-z0-9_/.]+' "$made/zephyr/CMakeLists.txt"); do
    [ -f "$made/src/$header" ] || complain "zephyr: no $header"
  done
}
pack() {
  vendor=$(sed -n 's|^  <vendor>\(.*\)</vendor>|\1|p' "$1") name=$(sed -n 's|^  <name>\(.*\)</name>|\1|p' "$1")
  [ "${1##*/}" = "$vendor.$name.pdsc" ] || complain "${1##*/}: is not called vendor.name.pdsc"
  [ -s "$folder/$vendor.$name.$version.pack" ] || complain "no $vendor.$name.$version.pack"
  for element in description url license release; do grep -qE "<$element[^>]*>[^<]+</$element>" "$1" || complain "pdsc: no $element"; done
  for attribute in schemaVersion Cclass Cgroup "Cversion=\"$version\"" "release version=\"$version\""; do
    grep -qF -- "$attribute" "$1" || complain "pdsc: no $attribute"
  done
  sed -n 's/.*<file .* name="\([^"]*\)".*/\1/p' "$1" >"$folder/named"
  while IFS= read -r file; do [ -e "$made/$file" ] || complain "pdsc: there is no $file"; done <"$folder/named"
  (cd "$made" && find src -name '*.cpp') >"$folder/sources"
  while IFS= read -r file; do grep -qxF "$file" "$folder/named" || complain "pdsc: $file is missing"; done <"$folder/sources"
  [ "$(wc -l <"$folder/sources")" -gt 90 ] || complain 'pdsc: hardly any source'
  if command -v xmllint >/dev/null; then xmllint --noout "$1" || complain 'pdsc: is no XML'; fi
}
check() {
  bad=0
  complain() { echo "$1"; bad=1; }
  folder=$(mktemp -d) made=$folder/firmtouch
  part() { sed -n "s/^#define FIRMTOUCH_VERSION_$1 //p" firmware/firmtouch/version.hpp; }
  version=$(part MAJOR).$(part MINOR).$(part PATCH)
  arithmetic='-ffp-contract=off -fno-associative-math -fno-finite-math-only -fno-unsafe-math-optimizations -fno-reciprocal-math -fsigned-zeros'
  sh tools/packaging/pack "$folder" https://example.org/firmtouch >"$folder/said" 2>&1 || complain "pack: $(cat "$folder/said")"
  ! sh tools/packaging/pack "$folder" >"$folder/said" 2>&1 || complain 'pack: writes over a package'
  properties "$made/library.properties"
  json "$made/library.json"
  module
  pack "$made/Firmtouch.firmtouch.pdsc"
  cmake -D SOURCES="$PWD/firmware/firmtouch" -D OUTPUT="$folder/id.cpp" -P firmware/cmake/build_id.cmake
  cmp -s "$folder/id.cpp" "$made/src/firmtouch/link/build_id.cpp" || complain "build_id: another than CMake's"
  rm -rf "$folder"
  return $bad
}

in_pack() { edit tools/packaging/pack "$1"; expect=$2; }
plant_version_of_its_own() { in_pack 's/^version=$version/version=9.9.9/' 'library.properties: another version'; }
plant_version_of_json() { in_pack 's/"version": "$version"/"version": "9.9.9"/' 'library.json: another version'; }
plant_lost_comma() { in_pack 's/"license": "MIT",/"license": "MIT"/' 'library.json: is no JSON'; }
plant_lost_key() { in_pack '/^sentence=/d' 'library.properties: no sentence'; }
plant_lost_flags() { edit firmware/cmake/firmtouch_options.cmake 's/ -ffp-contract=off//'; expect='library.json: no -ffp-contract=off'; }
plant_lost_sources() { in_pack "s/files_of '\*.cpp'/files_of 'a*.cpp'/" 'pdsc: src/firmtouch/.* is missing'; }
plant_file_that_is_not_there() { in_pack 's/name="CHANGELOG.md"/name="NEWS.md"/' 'pdsc: there is no NEWS.md'; }
plant_moved_primitives() { mv firmware/firmtouch/arch/armv7em_fpv5 firmware/firmtouch/arch/fpv5; expect='zephyr: no firmtouch/arch/armv7em_fpv5'; }
plant_moved_kconfig() { in_pack 's|kconfig: zephyr/Kconfig|kconfig: Kconfig|' 'module.yml: no Kconfig'; }
plant_other_sum() { edit tools/packaging/build_id 's/ | sort | / | sort -r | /'; expect="another than CMake's"; }
