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
