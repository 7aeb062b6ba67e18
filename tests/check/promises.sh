# The promise table of VERIFICATION.md names only what exists. Its columns: promise | mechanism (file) | attack (test) |
# figure (command). In backquotes stand files of the tree, tests as CTest names them (module.Test, check.name, target.name)
# and commands. Read by tests/check/run.

check() {
  names=$(
    grep -rhoE '^TEST\([A-Za-z0-9_]+' tests --include='*.cpp' | sed 's/TEST(/any./'
    grep -roE '^TEST\([A-Za-z0-9_]+' tests --include='*.cpp' | sed 's|^tests/\([^/]*\)/.*:TEST(|\1.|'
    for file in tests/*/*cases.sh; do  # shell functions, one a test
      sed -n "s/^\([A-Z][A-Za-z0-9]*\)() *{.*/$(basename "$(dirname "$file")").\1/p" "$file"
    done
    for file in tests/check/*.sh; do basename "$file" .sh | sed 's/^/check./'; done
    find tests \( -name CMakeLists.txt -o -name '*.cmake' \) -exec sed -n 's/.*NAME \([a-z_]*\.[A-Za-z0-9_.]*\).*/\1/p' {} +
  )
  # Words that the programs know as their first argument.
  words=$(grep -ohE '"[a-z]+"' tools/cli/*.cpp host_sim/*/*.cpp 2>/dev/null | tr -d '"' | sort -u)
  files=$(find . \( -name build -o -name .git \) -prune -o -type f -print | sed 's/^\.\///')
  { printf '%s\n' "$names" | sed 's/^/test /'
    printf '%s\n' "$words" | sed 's/^/word /'
    printf '%s\n' "$files" | sed 's/^/file /'
    sed 's/^/text /' VERIFICATION.md
    for page in SAFETY.md DESIGN.md $(find firmware tools hal -name README.md); do
      [ ! -f "$page" ] || sed "s|^|page $page |" "$page"
    done
  } | awk -f "$here/promises.awk"
}

row() {  # row MECHANISM ATTACK FIGURE COMPLAINT: puts a row after the table's head
  expect="planted: $4"
  awk -v row="| planted | $1 | $2 | $3 |" '
    { print } /^\| promise \| mechanism/ { table = 1 } table && /^\|---/ && !done { print row; done = 1 }' VERIFICATION.md >new.md
  mv new.md VERIFICATION.md
}
plant_missing_file() {
  row '`firmware/firmtouch/mesh/nowhere.cpp`' '`check.words`' '`tools/test`' 'there is no firmware/firmtouch/mesh/nowhere.cpp'
}
plant_missing_test() {
  row '`tools/test`' '`mesh.NobodyWroteThis`' '`tools/test`' 'there is no test mesh.NobodyWroteThis'
}
plant_missing_command() {
  row '`tools/test`' '`check.words`' '`build/host/bin/firmtouch frobnicate x.fta`' 'no command frobnicate of build/host/bin/firmtouch'
}
plant_help_as_a_figure() {
  row '`tools/test`' '`check.words`' '`build/host/bin/firmtouch bake --help`' '`build/host/bin/firmtouch bake --help` prints no figure'
}
plant_command_that_waits() {
  row '`tools/test`' '`check.words`' '`build/host/bin/firmtouch query part.fta part distance`' '.* waits on standard input'
}
plant_missing_script() {
  row '`tools/test`' '`check.words`' '`tools/nothing --long`' 'there is no tools/nothing'
}
plant_row_without_an_attack() {
  row '`tools/test`' 'by hand' '`tools/test`' 'names no attack'
}
plant_no_table() {
  grep -v '^|' VERIFICATION.md >new.md
  mv new.md VERIFICATION.md
  expect='no promise table'
}
plant_missing_test_on_another_page() {
  echo 'See `servo.NobodyWroteThis`.' >>SAFETY.md
  expect='^SAFETY.md: there is no test servo.NobodyWroteThis'
}
plant_missing_file_in_a_module() {
  echo 'See `nowhere.hpp`.' >firmware/firmtouch/core/README.md
  expect='^firmware/firmtouch/core/README.md: there is no nowhere.hpp'
}
