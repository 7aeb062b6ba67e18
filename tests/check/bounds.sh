# Every figure of instructions that a header's `Bounds:` states is at least what the worst of many inputs takes on an
# emulated Cortex-M7 (tests/target/bounds), and at most twice as much. Needs the presets host and mps2-an500 built. Read by
# tests/check/run.

copies='firmware/firmtouch hal'
board=mps2-an500
program=$root/build/$board/bin/bounds.elf

not_run() {
  [ -x "$root/build/host/bin/firmtouch" ] && [ -r "$program" ] && return 1
  echo "the presets host and $board are not built"
}

# What the program needs in the board's slot: triangles of three materials, a field, a curve, a spline surface.
bake_asset() {
  tool=$root/build/host/bin/firmtouch
  cat >"$1/materials.txt" <<'END'
material plain stiffness 500 N/m friction 0.4 viscous 1 Ns/m
material waves stiffness 800 N/m friction 0.6 waves 0.2 mm every 4 mm along 1 0 0 and 0 1 0
material map stiffness 600 N/m friction 0.2 map tile.pgm 0.2 mm every 8 mm along 1 0 0 and 0 1 0
END
  awk 'BEGIN { print "P2 16 16 255"; for (i = 0; i < 256; ++i) print int(127 + 120 * sin(i * 0.3927) * cos(int(i / 16) * 0.3927)) }' \
    >"$1/tile.pgm"
  "$tool" make part -o "$1/part.obj" --triangles 4000 && "$tool" make path -o "$1/path.csv" &&
    "$tool" make surface --weights -o "$1/surface.igs" &&
    awk '/^f / { print 1 + n++ % 3 }' "$1/part.obj" >"$1/numbers.txt" &&
    "$tool" bake "$1/part.obj" "$1/path.csv" "$1/surface.igs" --distance-map 16 --materials "$1/materials.txt" \
      --material-numbers "$1/numbers.txt" -o "$1/bounds.fta"
}
measure() {
  rows=$root/build/$board/bounds.rows
  [ "$rows" -nt "$program" ] && [ "$rows" -nt "$root/build/host/bin/firmtouch" ] && grep -q '^complete' "$rows" && return 0
  asset=$(mktemp -d) || return 1
  slot=$(arm-none-eabi-nm "$program" | sed -n 's/^\([0-9a-f]*\) . __firmtouch_asset_slot$/0x\1/p')
  bake_asset "$asset" >"$asset/log" 2>&1 &&
    sh "$root/hal/emulate" $board "$program" -device "loader,file=$asset/bounds.fta,addr=$slot,force-raw=on" >"$rows" ||
    { cat "$asset/log"; [ ! -r "$rows" ] || cat "$rows"; }
  rm -rf "$asset"
  grep -q '^complete' "$rows"
}

check() {
  measure || { echo 'nothing was measured'; return 1; }
  find firmware/firmtouch hal -name '*.hpp' | LC_ALL=C sort | xargs awk -f "$here/bounds.awk" |
    awk 'FILENAME != "-" { if (NF == 2) is[$1, ++measured[$1]] = $2; next }
      { ++stated[$1]; ++figures
        if (!(($1, stated[$1]) in is)) { print $1 ": " $2 " instructions are stated and not measured"; bad = 1; next }
        own = is[$1, stated[$1]]
        if ($2 < own || $2 > 2 * own) { print $1 ": " $2 " instructions are stated, the worst seen is " own; bad = 1 }
      }
      END {
        for (header in measured)
          if (measured[header] != stated[header]) { print header ": " measured[header] " figures are measured, " stated[header] + 0 " stated"; bad = 1 }
        if (figures < 25) { print "only " figures + 0 " figures"; bad = 1 }
        exit bad
      }' "$rows" -
}

plants() {
  cat <<'END'
a_figure_of_nothing @ firmware/firmtouch/mesh/loss.hpp @ /// Bounds: about 90 instructions. @ mesh/loss.hpp: 90 instructions are stated and not measured
END
}
edits() {
  cat <<'END'
too_small_figure @ firmware/firmtouch/scene/stored_objects.hpp @ s/45,000/8,000/ @ scene/stored_objects.hpp: 8000 instructions are stated, the worst seen is
generous_figure @ firmware/firmtouch/query/coherence.hpp @ s/about 90 i/about 900 i/ @ query/coherence.hpp: 900 instructions are stated, the worst seen is
figure_over_two_lines @ firmware/firmtouch/mesh/compensated_distance.hpp @ s/200 instructions at a/20 instructions at a/ @ mesh/compensated_distance.hpp: 20 instructions are stated
figure_taken_away @ firmware/firmtouch/math/arithmetic_check.hpp @ s/420 instructions/some instructions/ @ math/arithmetic_check.hpp: 1 figures are measured, 0 stated
END
}
