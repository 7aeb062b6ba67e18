# Every figure of stack that a header states is at least what the call graphs of the Cortex-M7's build give, and at most
# twice as much (1 KB = 1,024 B). Needs the presets host and mps2-an500 built. Read by tests/check/run.

not_run() {
  [ ! -d "$root/build/mps2-an500/firmware" ] || return 1
  echo 'the preset mps2-an500 is not built'
}

check() {
  bad=0
  files=$(mktemp -d) || return 1
  find "$root/build/mps2-an500/firmware" "$root/build/mps2-an500/hal" -name '*.ci' | grep -v '/app/' >"$files/graphs"
  contracts=0
  for header in $(grep -rl 'of stack' firmware/firmtouch --include='*.hpp' | LC_ALL=C sort); do
    awk -f "$here/stack_contracts.awk" "$header" >"$files/stated"
    while read -r stated function; do
      contracts=$((contracts + 1))
      # shellcheck disable=SC2046  # a word a file
      is=$("$root/build/host/bin/firmtouch-stack" --root "$function" --size '__aeabi_*=64' --limit 65536 \
        $(cat "$files/graphs") 2>/dev/null | awk '/bytes of stack at worst/ { print $1; exit }')
      if [ -z "$is" ]; then
        echo "$header: $function is in no call graph"
        bad=1
      elif [ "$stated" -lt "$is" ] || [ "$stated" -gt $((2 * is)) ]; then
        echo "$header: $function states $stated bytes of stack and takes $is"
        bad=1
      fi
    done <"$files/stated"
  done
  rm -rf "$files"
  [ $contracts -ge 15 ] || { echo "only $contracts headers state their stack"; bad=1; }
  return $bad
}

plant_too_small_figure() {
  edit firmware/firmtouch/mesh/closest_point.hpp 's/1\.6 KB of stack/1 KB of stack/'
  expect='mesh::closest_point states 1024 bytes of stack and takes'
}
plant_generous_figure() {
  edit firmware/firmtouch/mesh/closest_point.hpp 's/1\.6 KB of stack/9 KB of stack/'
  expect='mesh::closest_point states 9216 bytes of stack and takes'
}
