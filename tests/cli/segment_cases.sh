# Segments: the first crossing and all of them. Read by run.

SegmentsHitABoxWhereTheyShould() {
  small_scene
  printf 'ax,ay,az,bx,by,bz\n0.3,0.1,5,0.3,0.1,1\n5,0.2,0.3,7,0.2,0.3\n0.3,0.1,0,0.3,0.1,-6\n' >g.csv
  f query scene.fta box segment <g.csv
  exits 0
  same "$(printf '%s\n' "$out" | cut -d, -f1,2)" 'hit,t
1,0.5
0,1
1,0.5'
  same "$(printf '%s\n' "$out" | sed -n 1p)" hit,t,triangle,steps,exact
  same "$(printf '%s\n' "$out" | sed -n 3p | cut -d, -f3)" -1
}

ASegmentThatTheWorkCutsShortIsNoMiss() {
  f make part -o part.obj --triangles 2000; exits 0
  f bake part.obj -o s.fta --hull-faces 200; exits 0
  printf 'ax,ay,az,bx,by,bz\n-1,0.01,0.002,1,0.012,0.003\n1,1,1,2,2,2\n' >g.csv
  printf 'ax,ay,az,bx,by,bz,cx,cy,cz\n-1,0.01,0.002,1,0.012,0.003,0,0,1\n' >t.csv
  for kind in segment hull 'hull --mode refine'; do
    # shellcheck disable=SC2086
    f query s.fta part $kind <g.csv; exits 0
    same "$(printf '%s\n' "$out" | cut -d, -f1,5 | tr '\n' ' ')" 'hit,exact 1,1 0,1 '
    # shellcheck disable=SC2086
    f query s.fta part $kind --work 10 <g.csv; exits 0
    same "$(printf '%s\n' "$out" | sed -n 2p | cut -d, -f5)" 0
    # shellcheck disable=SC2086
    f query s.fta part $kind --all --work 10 <g.csv; exits 0; says 'ended the queries of 1 rows' 'raise --work'
    # shellcheck disable=SC2086
    f query s.fta part $kind --all <g.csv; exits 0; same "$err" ''
  done
  for mode in complete refine; do
    f query s.fta part hull --mode $mode --primitive triangle <t.csv; exits 0
    same "$(printf '%s\n' "$out" | cut -d, -f1,4 | tr '\n' ' ')" 'hit,exact 1,1 '
    f query s.fta part hull --mode $mode --primitive triangle --work 10 <t.csv; exits 0
    same "$(printf '%s\n' "$out" | sed -n 2p | cut -d, -f4)" 0
    f query s.fta part hull --mode $mode --primitive triangle --all --work 10 <t.csv; exits 0; says 'of 1 rows'
  done
}

EveryCrossingOfASegmentIsARowInOrder() {
  small_scene
  printf 'ax,ay,az,bx,by,bz\n5,0.2,0.3,7,0.2,0.3\n0.3,0.1,-6,0.3,0.1,6\n-4,-4,-4,4,4,4\n0.3,0.1,0,0.3,0.1,4\n' >g.csv
  f query scene.fta box segment --all <g.csv
  exits 0
  same "$(printf '%s\n' "$out" | sed -n 1p)" segment,t,triangle
  same "$(printf '%s\n' "$out" | cut -d, -f1 | tr '\n' ' ')" 'segment 1 1 2 2 3 '
  printf '%s\n' "$out" | awk -F, 'NR > 2 && $1 == row && $2 <= t { exit 1 } { row = $1; t = $2 }' || fail "not in order: $out"
  f query scene.fta box segment --all --time <g.csv
  exits 0
  printf '%s\n' "$out" | grep -qxE 'us_per_query [0-9]+\.[0-9]{4} queries 4' || fail "$out"
  printf 'x,y,z\n0,0,0\n' >p.csv
  f query scene.fta box distance --all <p.csv; exits 2; says '--all has no meaning for distance'
}
