# The package of tools/packaging/pack: each manifest obeys the rules that its system publishes, has the version of version.hpp,
# and names only files that are there, every source among them; the flags are those of CMake's targets; the build id is
# CMake's. Read by tests/check/run. The rules: arduino-lint's schemas of library.properties, in its strictest mode;
# PlatformIO's manifest/schema.py and library.json; the schema in Zephyr's zephyr_module.py; for PACK.xsd see pack.xsd.

copies="CHANGELOG.md LICENSE firmware hal/firmtouch tools/packaging"
not_run() { command -v xmllint >/dev/null && return 1; echo 'there is no xmllint'; }

# obeys FILE SEPARATOR: each line of FILE is a key, SEPARATOR and a value, and each row of the standard input a rule:
# `KEY need|may LENGTH PATTERN`, of the whole value. Keys without a rule are complained about.
obeys() {
  text=$(awk -v separator="$2" '
    NR == FNR { need[$1] = $2; most[$1] = $3; key = $1; sub(/^[^ ]+ [^ ]+ [^ ]+ /, ""); pattern[key] = "^(" $0 ")$"; next }
    /^[{}]$/ { next }
    {
      at = index($0, separator); key = substr($0, 1, at - 1); value = substr($0, at + length(separator))
      gsub(/[ "]/, "", key); sub(/^ /, "", value); sub(/,$/, "", value); seen[key] = 1
      if (!at || !(key in need)) print "no key of the schema: " $0
      else if (length(value) > most[key] || value !~ pattern[key]) print key " is against the schema: " value
    }
    END { for (key in need) if (need[key] == "need" && !(key in seen)) print "no " key }' - "$1")
  [ -z "$text" ] || complain "$(printf '%s\n' "$text" | sed "s|^|${1##*/}: |")"
}
properties() {
  obeys "$1" = <<'END'
name need 16 [a-zA-Z][a-zA-Z0-9_.-]*
version need 20 (0|[1-9][0-9]*)[.](0|[1-9][0-9]*)[.](0|[1-9][0-9]*)
author need 100 .+
maintainer need 100 .+
sentence need 200 .+
paragraph need 500 .*
category need 30 Display|Communication|Signal Input/Output|Sensors|Device Control|Timing|Data Storage|Data Processing|Other
url need 200 https?://[^ ]+
architectures need 100 .+
includes may 100 [A-Za-z_]+[.]h
license may 20 MIT
END
  grep -qx "version=$version" "$1" || complain "library.properties: another version than $version"
  # These belong to official libraries, and say nothing.
  text=$(grep -iE '^(name|maintainer)=.*(arduino|library)' "$1") && complain "library.properties: $text"
  for header in $(sed -n 's/^includes=//p' "$1"); do [ -e "$made/src/$header" ] || complain "library.properties: no src/$header"; done
}
json() {
  obeys "$1" : <<'END'
name need 102 "[^":;/,@<>]+"
version need 52 "[0-9]+[.][0-9]+[.][0-9]+"
description may 1002 "[^"]+"
keywords may 200 \[("[a-z0-9+. -]+"(, )?)+\]
homepage may 257 "https?://[^" ]+"
authors may 200 \[[{] "name": "[^"]+", "maintainer": (true|false) [}]\]
license may 257 "MIT"
frameworks may 52 "([a-z0-9_-]+|[*])"
platforms may 52 "([a-z0-9_-]+|[*])"
headers may 100 \["[A-Za-z_]+[.]h"\]
build may 2000 [{] "srcDir": "src", "flags": \[("[^"]+"(, )?)+\], "unflags": \[("[^"]+"(, )?)+\] [}]
END
  grep -qx "  \"version\": \"$version\"," "$1" || complain "library.json: another version than $version"
  awk 'NR > 2 && (last ~ /,$/) == ($0 == "}") { bad = 1 } { last = $0 } END { exit bad || last != "}" }' "$1" ||
    complain 'library.json: a comma is missing, or one too many'
  for flag in $arithmetic; do grep -qF "\"$flag\"" "$1" || complain "library.json: no $flag"; done
}
module() {
  obeys "$made/zephyr/module.yml" : <<'END'
name need 100 [a-zA-Z0-9_-]+
build need 0 .*
cmake need 100 [a-zA-Z0-9_/.-]+
kconfig need 100 [a-zA-Z0-9_/.-]+
END
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
  text=$(xmllint --noout --schema "$here/pack.xsd" "$1" 2>&1) || complain "$text"
  for element in "component .*Cversion" 'release version'; do
    grep -q "<$element=\"$version\"" "$1" || complain "pdsc: another version than $version"
  done
  sed -n 's/.*<file .* name="\([^"]*\)".*/\1/p' "$1" >"$folder/named"
  while IFS= read -r file; do [ -e "$made/$file" ] || complain "pdsc: there is no $file"; done <"$folder/named"
  (cd "$made" && find src -name '*.cpp') >"$folder/sources"
  grep -vxF -f "$folder/named" "$folder/sources" >"$folder/missing" && complain "$(sed 's/.*/pdsc: & is missing/' "$folder/missing")"
  [ "$(wc -l <"$folder/sources")" -gt 90 ] || complain 'pdsc: hardly any source'
}
check() {
  bad=0
  complain() { echo "$1"; bad=1; }
  folder=$(mktemp -d) made=$folder/firmtouch
  part() { sed -n "s/^#define FIRMTOUCH_VERSION_$1 //p" firmware/firmtouch/version.hpp; }
  version=$(part MAJOR).$(part MINOR).$(part PATCH)
  [ "$(sed -n 's/^## \([0-9][0-9.]*\).*/\1/p' CHANGELOG.md | head -n 1)" = "$version" ] || complain "CHANGELOG.md: its first release is another than $version"
  arithmetic='-ffp-contract=off -fno-associative-math -fno-finite-math-only -fno-unsafe-math-optimizations -fno-reciprocal-math -fsigned-zeros'
  sh tools/packaging/pack "$folder" https://example.org/firmtouch >"$folder/said" 2>&1 || complain "pack: $(cat "$folder/said")"
  ! sh tools/packaging/pack "$folder" https://example.org >"$folder/said" 2>&1 || complain 'pack: writes over a package'
  ! sh tools/packaging/pack "$folder/other" example.org >"$folder/said" 2>&1 || complain 'pack: takes what is no URL'
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
plant_release_without_changes() { edit CHANGELOG.md 's/^## 0.1.0/## 0.0.9/'; expect='CHANGELOG.md: its first release'; }
plant_lost_comma() { in_pack 's/"license": "MIT",/"license": "MIT"/' 'library.json: a comma is missing'; }
plant_lost_key() { in_pack '/^sentence=/d' 'library.properties: no sentence'; }
plant_lost_flags() { edit firmware/cmake/firmtouch_options.cmake 's/ -ffp-contract=off//'; expect='library.json: no -ffp-contract=off'; }
plant_lost_sources() { in_pack "s/files_of '\*.cpp'/files_of 'a*.cpp'/" 'pdsc: src/firmtouch/.* is missing'; }
plant_file_that_is_not_there() { in_pack 's/name="CHANGELOG.md"/name="NEWS.md"/' 'pdsc: there is no NEWS.md'; }
plant_moved_primitives() { mv firmware/firmtouch/arch/armv7em_fpv5 firmware/firmtouch/arch/fpv5; expect='zephyr: no firmtouch/arch/armv7em_fpv5'; }
plant_moved_kconfig() { in_pack 's|kconfig: zephyr/Kconfig|kconfig: Kconfig|' 'module.yml: no Kconfig'; }
plant_other_sum() { edit tools/packaging/build_id 's/ | sort)/ | sort -r)/'; expect="another than CMake's"; }
plant_category_of_our_own() { in_pack 's/^category=.*/category=Robots/' 'library.properties: category is against the schema: Robots'; }
plant_key_nobody_reads() { in_pack 's/^includes=/include=/' 'library.properties: no key of the schema: include='; }
plant_name_of_others() { in_pack 's/^maintainer=.*/maintainer=Arduino/' 'library.properties: maintainer=Arduino'; }
plant_keyword_in_capitals() { in_pack 's/"haptics"/"Haptics"/' 'library.json: keywords is against the schema'; }
plant_key_of_module() { in_pack 's|^  kconfig: |  Kconfig: |' 'module.yml: no key of the schema: *Kconfig:'; }
plant_element_that_is_not_closed() { in_pack 's|</releases>||' 'Opening and ending tag mismatch: releases'; }
plant_class_of_one_letter() { in_pack 's/Cclass="Haptics"/Cclass="H"/' "attribute 'Cclass'.*minLength"; }
plant_category_of_file() { in_pack 's/ sourceCpp)/ cpp)/' "attribute 'category'"; }
plant_lost_releases() { in_pack '/<releases>/,/<.releases>/d' 'Missing child element.*releases'; }
plant_dots_in_vendor() { in_pack 's|<vendor>Firmtouch<|<vendor>firm.touch<|' "Element 'vendor'"; }
