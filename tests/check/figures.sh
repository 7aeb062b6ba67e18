# The instructions and bytes in README.md are those that tools/test has just measured, in build/test/table. They hold for
# the compiler that README.md names. Read by tests/check/run.

table=$root/build/test/table

not_run() {
  ours=$(arm-none-eabi-g++ -dumpfullversion)
  grep -qF "arm-none-eabi-g++ $ours" "$root/README.md" && return 1
  echo "README.md's are of another compiler than arm-none-eabi-g++ $ours"
}

check() { awk -f "$here/figures.awk" "$table" README.md firmware/firmtouch/hull/README.md firmware/firmtouch/servo/README.md; }

edits() {
  cat <<'END'
wrong_number @ README.md @ /`tools\/bench\/cortex-m7` |$/s/worst [0-9,]*/worst 1,234/ @ ^\| query with sign .*\| mean [0-9,]+, worst [0-9,]+ \| `tools/bench/cortex-m7` \|$
wrong_flash @ README.md @ /`tools\/check\/image netduinoplus2`/s/| [0-9,]* B,/| 12,345 B,/ @ Cortex-M4F \| [0-9,]+ B, [0-9,]+ B, [0-9,]+ B \|
wrong_figure_of_the_servo @ firmware/firmtouch/servo/README.md @ s/and worst [0-9,]* instructions/and worst 1,234 instructions/ @ servo/README.md: the servo at two rates was measured with mean
wrong_figure_of_a_module @ firmware/firmtouch/hull/README.md @ s/and worst [0-9,]* instructions/and worst 1,234 instructions/ @ hull/README.md: the base hull of the demo part was measured with mean
END
}
plant_lost_row() {
  grep -v 'tools/check/image mps2-an500' README.md >new.md
  mv new.md README.md
  expect='there is no row of mps2-an500'
}
