# The instructions and bytes in README.md are those that tools/test has just measured, in build/test/table. They hold for
# the compiler that README.md names. Figures of tests/check/figures.txt are those of tools/bench/RESULTS.md. Read by
# tests/check/run.

table=$root/build/test/table

not_run() {
  ours=$(arm-none-eabi-g++ -dumpfullversion)
  grep -qF "arm-none-eabi-g++ $ours" "$root/README.md" && return 1
  echo "README.md's are of another compiler than arm-none-eabi-g++ $ours"
}

check() {
  bad=0
  awk -f "$here/figures.awk" "$table" README.md firmware/firmtouch/hull/README.md firmware/firmtouch/servo/README.md \
    firmware/firmtouch/asset/README.md || bad=1
  awk -v list=tests/check/figures.txt -f "$here/results.awk" tools/bench/RESULTS.md || bad=1
  return $bad
}

edits() {
  cat <<'END'
wrong_number @ README.md @ /`tools\/bench\/cortex-m7` |$/s/worst [0-9,]*/worst 1,234/ @ ^\| the same, demo part .*\| mean [0-9,]+, worst [0-9,]+ \| `tools/bench/cortex-m7` \|$
wrong_flash @ README.md @ /`tools\/check\/image netduinoplus2`/s/| [0-9,]* B,/| 12,345 B,/ @ Cortex-M4F \| [0-9,]+ B, [0-9,]+ B, [0-9,]+ B \|
wrong_figure_of_the_servo @ firmware/firmtouch/servo/README.md @ s/and worst [0-9,]* instructions/and worst 1,234 instructions/ @ servo/README.md: the servo at two rates was measured with mean
wrong_flash_of_a_trusted_asset @ firmware/firmtouch/asset/README.md @ s/takes [0-9,]* instead/takes 12,345 instead/ @ asset/README.md: .mesh;guide. takes [0-9,]+ instead of [0-9,]+ bytes
wrong_figure_of_a_model @ firmware/firmtouch/mesh/README.md @ /^| `--fast` (default)/s/1,981/1,980/ @ mesh/README.md: .*: 1,981 is missing
wrong_figure_of_parts @ README.md @ /cortex-m7 --parts/s/worst [0-9,]*/worst 1,234/ @ README.md: .*--parts.*: 8,869 is missing
lost_words @ firmware/firmtouch/record/README.md @ s/ring-cortex-m7/ring/ @ record/README.md: nothing says .tools/bench/ring-cortex-m7
wrong_figure_of_a_module @ firmware/firmtouch/hull/README.md @ s/and worst [0-9,]* instructions/and worst 1,234 instructions/ @ hull/README.md: the base hull of the demo part was measured with mean
END
}
plant_lost_row() {
  grep -v 'tools/check/image mps2-an500' README.md >new.md
  mv new.md README.md
  expect='there is no row of mps2-an500'
}
