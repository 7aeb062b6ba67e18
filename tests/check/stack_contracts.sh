# Every figure of stack that a header states is at least what the call graphs of both boards' builds give, and at most twice
# as much (1 KB = 1,024 B). Needs the presets host and of the boards built. Read by tests/check/run.

boards='mps2-an500 netduinoplus2'

not_run() {
  for board in $boards; do
    [ -d "$root/build/$board/firmware" ] || { echo "the preset $board is not built"; return 0; }
  done
  return 1
}

# measure BOARD ROOT: bytes of stack
measure() {
  # shellcheck disable=SC2046  # a word a file
  "$root/build/host/bin/firmtouch-stack" --root "$2" --size '__aeabi_*=64' --limit 65536 \
    $(cat "$files/$1") 2>/dev/null | awk '/bytes of stack at worst/ { print $1; exit }'
}

check() {
  bad=0
  files=$(mktemp -d) || return 1
  for board in $boards; do
    find "$root/build/$board/firmware" "$root/build/$board/hal" -name '*.ci' | grep -v '/app/' >"$files/$board"
  done
  find firmware/firmtouch hal -name '*.hpp' | LC_ALL=C sort | xargs awk -f "$here/stack_contracts.awk" >"$files/stated"
  while read -r header stated function; do
    is=0
    for board in $boards; do
      here_is=$(measure "$board" "$function")
      [ "${here_is:-0}" -le "$is" ] || is=$here_is
    done
    if [ "$is" = 0 ]; then
      echo "$header: a figure of stack, and no function in the call graphs: $function"
      bad=1
    elif [ "$stated" -lt "$is" ] || [ "$stated" -gt $((2 * is)) ]; then
      echo "$header: $function states $stated bytes of stack and takes $is"
      bad=1
    fi
  done <"$files/stated"
  contracts=$(wc -l <"$files/stated")
  rm -rf "$files"
  [ "$contracts" -ge 20 ] || { echo "only $contracts headers state their stack"; bad=1; }
  return $bad
}

edits() {
  cat <<'END'
too_small_figure @ firmware/firmtouch/mesh/closest_point.hpp @ s/[0-9.]* KB of stack/1 KB of stack/ @ mesh::closest_point states 1024 bytes of stack and takes
generous_figure @ firmware/firmtouch/mesh/closest_point.hpp @ s/[0-9.]* KB of stack/9 KB of stack/ @ mesh::closest_point states 9216 bytes of stack and takes
figure_over_two_lines @ firmware/firmtouch/mesh/exact_crossing.hpp @ s/1\.9 KB of/1.2 KB of/ @ mesh::exact_crossing states 1228 bytes of stack and takes
figure_of_a_class @ firmware/firmtouch/spline/proof/opening.hpp @ s/3 KB of stack/300 B of stack/ @ 5Proof\* states 300 bytes of stack and takes
END
}
plant_figure_of_nothing() {
  printf '/// Bounds: 3 KB of stack.\nconstexpr int kPlanted = 3;\n' >>firmware/firmtouch/mesh/loss.hpp
  expect='mesh/loss.hpp: a figure of stack, and no function in the call graphs: \?'
}
