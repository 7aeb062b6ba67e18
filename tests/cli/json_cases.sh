# Cases of tests/cli/run about --json, and - for standard input and output. (well_formed: bench_cases.sh.)

member() {  # member TEXT...: each stands in the JSON
  for text in "$@"; do printf '%s\n' "$out" | grep -qF -- "$text" || fail "no $text in: $out"; done
}
BakeJsonIsWhatInfoPrintsAndTheReport() {
  box >'a "<b>".obj'
  f bake 'a "<b>".obj' -o scene.fta --json
  exits 0
  well_formed
  member '"file": "scene.fta"' '"triangles": 12' '"name": "a \"\u003cb>\""' '"reported": ["a \"\u003cb>\": '
  case $out in *'<'*) fail 'a < ends the script of a page' ;; esac
  printf '%s\n' "$out" | sed 's/, "reported".*//' >baked
  f info scene.fta --json
  well_formed
  same "$(cat baked)" "$(printf '%s\n' "$out" | sed 's/}$//')"
}
HullMendAndVoxelizeHaveJson() {
  box >box.obj
  f hull box.obj --faces 12 -o hull.obj --json
  exits 0
  well_formed
  member '"file": "hull.obj", "triangles": 12, "of_triangles": 12, "void_share": ' '"reported": ['
  f mend box.obj -o mended.obj --json
  exits 0
  well_formed
  member '"file": "mended.obj", "triangles": 12'
  f voxelize box.obj -n 6 --json
  exits 0
  well_formed
  member '"file": null, "voxels": [' '"disagreements": 0'
}
AFileCalledMinusIsStandardInputOrOutput() {
  box >box.obj
  bake box.obj -o scene.fta
  "$firmtouch" bake box.obj -o - 2>note | cmp - scene.fta || fail 'bake -o - differs'
  "$firmtouch" info - <scene.fta >from_stdin || fail 'info - fails'
  grep -q '^-: ' from_stdin || fail "$(cat from_stdin)"
  f hull box.obj --faces 12 -o hull.obj
  "$firmtouch" hull box.obj --faces 12 -o - 2>note | cmp - hull.obj || fail 'hull -o - differs'
  f mend box.obj -o mended.obj
  "$firmtouch" mend box.obj -o - 2>note | cmp - mended.obj || fail 'mend -o - differs'
  f make path -o path.csv
  "$firmtouch" make path -o - 2>note | cmp - path.csv || fail 'make -o - differs'
  for command in bake mend; do f $command box.obj -o - --json; exits 2; says 'leave out --json'; done
  f bake box.obj -o - --cpp a.cpp; exits 2; says 'leave out --json and --cpp'
  absent -
}
AQueryIsACoProcess() {
  small_scene
  mkfifo questions answers
  "$firmtouch" query scene.fta box distance --line-buffered <questions >answers 2>note &
  program=$!
  exec 7>questions 8<answers
  read -r header <&8
  printf '# points\n\nx (mm),y (mm),z (mm)\n' >&7
  for x in 5000 7000 2000; do  # each answer is read before the next point is written
    echo "$x,0,0" >&7
    read -r row <&8
    printf '%s\n' "$row" >>rows
  done
  echo '1,two,3' >&7
  wait $program
  same $? 3
  exec 7>&- 8<&-
  grep -q "standard input:7: column 'y': 'two' is not a number" note || fail "$(cat note)"
  printf 'x/mm,y/mm,z/mm\n5000,0,0\n7000,0,0\n2000,0,0\n' | "$firmtouch" query scene.fta box distance >batch
  same "$(echo "$header"; cat rows)" "$(cat batch)"
  printf 'ax,ay,az,bx,by,bz\n5,0,0,-5,0,0\n' >segments
  for kind in 'segment' 'segment --all'; do
    # shellcheck disable=SC2086  # two words
    "$firmtouch" query scene.fta box $kind <segments >batch
    "$firmtouch" query scene.fta box $kind --line-buffered <segments | cmp - batch || fail "$kind differs"
  done
  bake box.obj -o hulled.fta --hull-faces 12
  "$firmtouch" query hulled.fta box hull <segments >batch
  "$firmtouch" query hulled.fta box hull --line-buffered <segments | cmp - batch || fail 'hull differs'
  printf '' | "$firmtouch" query scene.fta box distance --line-buffered >.out 2>.err
  same $? 3
  err=$(cat .err) says 'standard input: is empty'
  f query scene.fta box distance --line-buffered --time; exits 2; says 'leave out --line-buffered'
}
AQueryAnswersInJsonOrAsNpy() {
  small_scene
  printf 'x,y,z\n5,0,0\n0,0,9\n' >points.csv
  f query scene.fta box distance <points.csv
  csv=$out
  "$firmtouch" query scene.fta box distance --json <points.csv >rows
  out=$(sed -n 1p rows) && well_formed
  member '{"distance": 4, "sign": 1, "cx": 1, ' '"feature": "' '"exact": true}'
  same "$(wc -l <rows | tr -d ' ')" 2
  # The names of the columns are the CSV's, and a record has their bits: 5 floats, 3 doubles, 3 integers, a word of 8 letters, a flag.
  "$firmtouch" query scene.fta box distance --npy <points.csv >rows.npy || fail 'no .npy'
  head=$(($(od -An -tu2 -j8 -N2 rows.npy) + 10))
  head -c $head rows.npy | tail -c +11 >head
  same "$(tr , '\n' <head | sed -n "s/.*('\([a-z]*\)'$/\1/p" | paste -sd, -)" "$(printf '%s\n' "$csv" | sed 1q)"
  grep -q "'shape': (2,), }" head || fail "$(cat head)"
  same "$((head % 64)) $(wc -c <rows.npy | tr -d ' ')" "0 $((head + 2 * (5 * 4 + 6 * 8 + 32 + 1)))"
  same "$(od -An -tf4 -j$head -N4 rows.npy | tr -d ' ')" 4
  f query scene.fta box distance --npy --time; exits 2; says 'leave out --time'
  f query scene.fta box distance --npy --line-buffered; exits 2; says 'leave out --line-buffered'
}
