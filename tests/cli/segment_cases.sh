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
  same "$(printf '%s\n' "$out" | sed -n 1p)" hit,t,triangle,steps
  same "$(printf '%s\n' "$out" | sed -n 3p | cut -d, -f3)" -1
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
