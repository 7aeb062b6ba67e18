# The instructions and bytes in README.md are those that tools/test has just measured, in build/test/table. They hold for
# the compiler that README.md names. Read by tests/check/run.

table=$root/build/test/table

not_run() {
  ours=$(arm-none-eabi-g++ -dumpfullversion)
  grep -qF "arm-none-eabi-g++ $ours" "$root/README.md" && return 1
  echo "README.md's are of another compiler than arm-none-eabi-g++ $ours"
}

check() { awk -f "$here/figures.awk" "$table" README.md firmware/firmtouch/hull/README.md; }

plant_wrong_number() {
  edit README.md '/`tools\/bench\/cortex-m7` |$/s/worst [0-9,]*/worst 1,234/'
  expect='^\| query with sign .*\| mean [0-9,]+, worst [0-9,]+ \| `tools/bench/cortex-m7` \|$'
}
plant_wrong_flash() {
  edit README.md '/`tools\/check\/image netduinoplus2`/s/| [0-9,]* B,/| 12,345 B,/'
  expect='Cortex-M4F \| [0-9,]+ B, [0-9,]+ B, [0-9,]+ B \|'
}
plant_wrong_figure_of_a_module() {
  edit firmware/firmtouch/hull/README.md 's/and worst [0-9,]* instructions/and worst 1,234 instructions/'
  expect='hull/README.md: the base hull of the demo part was measured with mean'
}
plant_lost_row() {
  grep -v 'tools/check/image mps2-an500' README.md >new.md
  mv new.md README.md
  expect='there is no row of mps2-an500'
}
