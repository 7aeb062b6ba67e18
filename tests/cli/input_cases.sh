# Cases of tests/cli/run: what model files may hold.

# refused FILE TEXT...: exit 3, a message with the file and each text, no file left
refused() {
  file=$1
  shift
  f bake "$file" -o bad.fta
  exits 3
  says "$file" "$@"
  absent bad.fta
}

BadModelsAreRefusedWithPlaceCountAndRemedy() {
  : >empty.stl; refused empty.stl empty 'export'
  : >empty.csv; refused empty.csv empty 'x,y,z'
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj; refused one.obj '3 open edges' '--unsigned'
  box | sed 's/^f 1 4 3 2/f 1 4 3 9/; s/^f 5 6 7 8/f 5 6 7 -9/' >range.obj
  refused range.obj ':9:' 'index 9 is out of range' '2 times' 'last at line 10' 'Export'
  box | sed 's/-1 -2 -3/-1 nan -3/; s/1 2 3$/inf nan 3/' >nan.obj; refused nan.obj ':1:' 'not finite' '5 times' 'line 8'
  box | sed 's/^v 1/v 1,5/' >comma.obj; refused comma.obj ':2:' 'with a point' '4 times' 'last at line 7'
  printf 'solid x\n facet normal 0 0 1\n' >cut.stl; refused cut.stl ':2:' 'cut short' 'export'
  { printf '%080d' 0; printf '\002\0\0\0'; printf '%050d' 0; } >cut.stl
  refused cut.stl 'byte 80' 'states 2 facets' 'holds 1 whole' 'export'
  printf 'PK\003\004zip' >x.stl; refused x.stl 'zip archive'
  printf 'ply\nformat binary_little_endian 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty float z\nend_header\nabcd' >cut.ply
  refused cut.ply 'byte ' 'vertex 0' 'cut short' 'export'
  box >big.obj
  f bake big.obj -o bad.fta --unit in; exits 0; rm bad.fta
  box | sed '/^v/s/[123]/&e30/g' >big.obj; refused big.obj 'large' '--unit'
}

# limit KILOBYTES: of address space. The sanitizers reserve terabytes: under them there is no limit.
limit() { if (ulimit -v "$1" && "$firmtouch" --version) >/dev/null 2>&1; then ulimit -v "$1"; fi; }

# 1 GB if FIRMTOUCH_LONG is set; never more than a little of it is held.
ALineThatDoesNotEndIsRefusedInBoundedMemory() {
  megabytes=40
  [ -n "${FIRMTOUCH_LONG:-}" ] && megabytes=1024
  for kind in obj off ply stl csv; do
    case $kind in
      obj) head='v 0 0 0\nf ' ;;
      off) head='OFF\n3 1 0\n' ;;
      ply) head='ply\nformat ascii 1.0\nelement vertex 3\n' ;;
      stl) head='solid ' ;;
      csv) head='x,y,z\n' ;;
    esac
    # shellcheck disable=SC2059
    { printf "$head"; head -c "${megabytes}m" /dev/zero | tr '\0' 1; } >line.$kind
    # 400 MB of address space: the program, its threads and 16 MB of the line.
    (limit 400000 && exec "$firmtouch" bake line.$kind -o bad.fta) >.out 2>.err
    status=$?
    err=$(cat .err)
    exits 3
    says "line.$kind" 'line ' 'longer than 16777216 bytes'
    absent bad.fta
    [ $kind = csv ] || rm line.$kind
  done
  small_scene
  f query scene.fta box distance <line.csv
  exits 3
  says 'standard input: line 2 is longer'
  rm line.csv
}

AnStlIsBakedAsTheSameModelInObj() {
  f make part --triangles 2000 -o part.obj
  f make walk part.obj --points 300 -o walk.csv
  awk '/^v/ { x[++n] = $2 " " $3 " " $4 }
       /^f/ { print "facet normal 0 0 0\nouter loop\nvertex " x[$2] "\nvertex " x[$3] "\nvertex " x[$4] "\nendloop\nendfacet" }
       BEGIN { print "solid part" } END { print "endsolid part" }' part.obj >part.stl
  bake part.obj -o obj.fta
  bake part.stl -o stl.fta
  f query obj.fta part distance <walk.csv
  same "$(printf '%s\n' "$out" | wc -l | tr -d ' ')" 301
  wanted=$out
  f query stl.fta part distance <walk.csv
  same "$(printf '%s\n' "$out" | cut -d, -f1,2,9 | cksum)" "$(printf '%s\n' "$wanted" | cut -d, -f1,2,9 | cksum)"
  bake part.stl -o mm.fta --unit mm
  f make walk part.stl --points 10 -o w.csv
  exits 0
}

WhatAReaderPassesOverIsTold() {
  { printf 'solid a\n'; printf 'facet normal 0 0 1 outer loop vertex %s endloop endfacet\n' \
      '0 0 0 vertex 0 1 0 vertex 1 0 0' '0 0 0 vertex 1 0 0 vertex 0 0 1' \
      '1 0 0 vertex 0 1 0 vertex 0 0 1' '0 0 0 vertex 0 0 1 vertex 0 1 0'; printf 'endsolid a\n'; } >t.stl
  bake t.stl -o a.fta
  says 'read: passed over stored normals' 'of 4 facets 1 have one opposite'
  box | awk '/^v/ { $2 += 20000.1 } { print }' >far.obj
  bake far.obj -o a.fta
  says 'far from 0: stored from the origin (20000, 0, 0 m)'
  box >near.obj
  bake far.obj near.obj -o a.fta
  says 'read: rounded coordinates to 32 bits' 'bake it alone'
}

RealModelsAreBakedMendedOrRefused() {
  models=${FIRMTOUCH_MODELS:-}
  [ -n "$models" ] || return 0
  for model in spot.obj rocker-arm.off fandisk.obj teapot.bpt; do bake "$models/$model" -o a.fta; rm a.fta; done
  for model in cow.obj suzanne.obj stanford-bunny.obj; do
    f bake "$models/$model" -o a.fta
    exits 3
    says "$model"
    absent a.fta
  done
  bake "$models/stanford-bunny.obj" -o a.fta --unsigned
  says 'dropped 1113 vertices'
}

NeedlesMendedInVainAreWrapped() {
  printf 'v %s\n' '0 0 0' '1 0 0' '0.3 2e-4 5e-5' '0.31 -1e-4 3e-4' >needle.obj
  printf 'f %s\n' '1 3 2' '1 2 4' '2 3 4' '3 1 4' >>needle.obj
  f bake needle.obj -o a.fta --mend; exits 3; says 'too sharp a needle'; absent a.fta
  bake needle.obj -o a.fta --mend --wrap 1%
  says 'wrapped: ' 'mending alone was not enough: the corner at'
}

# Random points of a sphere: joined, and no gap between them is left open.
APointCloudBecomesASolid() {
  sphere() {  # sphere SEED COUNT FORMAT
    awk -v x="$1" -v n="$2" -v format="$3" 'function random() { return (x = (x * 16807) % 2147483647) / 2147483647 }
      BEGIN { for (i = 0; i < n; ++i) { z = 2 * random() - 1; a = 6.28318530718 * random(); r = sqrt(1 - z * z)
        printf format "\n", r * cos(a), r * sin(a), z } }'
  }
  sphere 7 600 'v %.6f %.6f %.6f' >cloud.obj
  bake cloud.obj -o scene.fta --wrap 2%
  says 'wrapped: 600 points' 'in 1 piece with 0 handles'
  { echo x,y,z; sphere 8 2000 '%.6f,%.6f,%.6f'; echo 0,0,0; } >between.csv
  f query scene.fta cloud distance <between.csv
  same "$(printf '%s\n' "$out" | awk -F, 'NR > 1 && $2 != -1 { ++n } END { print n + 0 }')" 0
}

# As the controller chooses: meshes before splines, then by name (host_sim.Scene...). `aa` is a spline surface.
OfSeveralSurfacesAndGuidesTheUsedOneIsNamed() {
  box >b.obj
  box >c.obj
  cp "$here/../spline/cad/torus.igs" aa.igs
  bend >way.csv
  bake way.csv c.obj b.obj aa.igs -o scene.fta
  says 'a controller uses surface `b`, not `c`, `aa`; a scenario may choose: mesh NAME'
  simulator=${firmtouch%/*}/firmtouch-sim
  if [ -x "$simulator" ]; then
    printf 'asset scene.fta\nduration 0.01 s\n' >s.scenario
    "$simulator" run s.scenario >ran 2>&1
    grep -q 'surface `b`, guide `way`; not used: surface' ran || fail "$(cat ran)"
  fi
  bake b.obj way.csv -o scene.fta
  case $err in *'a controller uses'*) fail "$err" ;; esac
}

AnAssetBakedBeforeIsTakenAsItIs() {
  box >box.obj
  f make path --points 400 -o path.csv; exits 0
  f bake box.obj path.csv -o both.fta; exits 0
  f bake box.obj -o box.fta; exits 0
  f bake path.csv box.fta -o added.fta --size 2m; exits 0
  says 'box: baked before' 'mesh;guide'
  f bake box.fta path.csv -o added.fta; exits 0
  cmp -s both.fta added.fta || fail 'not the bytes of a bake of both'
  cp box.obj other.obj
  f bake box.fta box.obj -o bad.fta; exits 3
  says "names its asset 'box', as box.fta" 'rename'
  f bake both.fta other.obj path.csv -o bad.fta; exits 3
  says "names its asset 'path', as both.fta"
  head -c 5000 both.fta >cut.fta
  f bake cut.fta path.csv -o bad.fta; exits 3
  says 'cut.fta: not a sound asset'
  absent bad.fta
}

# Where FIRMTOUCH_LONG is set; else a twentieth of it.
AMillionTrianglesBakeIn25SecondsAnd300MiB() {
  triangles=50000
  [ -n "${FIRMTOUCH_LONG:-}" ] && triangles=1000000
  f make part --triangles $triangles -o million.obj; exits 0
  before=$(date +%s)
  (limit 307200; exec "$firmtouch" bake million.obj -o million.fta 2>.err) || fail "no bake in 300 MiB: $(cat .err)"
  seconds=$(($(date +%s) - before))
  [ $seconds -le 25 ] || fail "$seconds s"
}

# The box at (1000.1, -2000.2, 3000.3): its sides are at 1001.1 and 3003.3, the corner at all three.
FarPartsAnswerInTheFilesCoordinates() {
  box | awk '/^v/ { $2 += 1000.1; $3 -= 2000.2; $4 += 3000.3 } { print }' >far.obj
  bake far.obj -o far.fta --hull-faces 8
  f info far.fta
  same "$(printf '%s\n' "$out" | sed -n 's/^  \([xyz]_m\)  */\1 /p' | paste -sd, -)" 'x_m 1000,y_m -2000,z_m 3000.5'
  printf 'x,y,z\n1001.2,-2000.2,3000.3\n1000.1,-2000.2,3003.4\n' >rows.csv
  f query far.fta far distance <rows.csv
  same "$(printf '%s\n' "$out" | sed 1d | cut -d, -f3-5)" '1001.1,-2000.2,3000.3
1000.1,-2000.2,3003.3'
  same "$(printf '%s\n' "$out" | sed 1d | awk -F, '{ printf "%.6f ", $1 }')" '0.100000 0.100000 '
  for kind in segment hull; do
    printf 'ax,ay,az,bx,by,bz\n1002.1,-2000.3,3000.4,998.1,-2000.3,3000.4\n' >rows.csv
    f query far.fta far $kind --all <rows.csv
    same "$(printf '%s\n' "$out" | sed 1d | awk -F, '{ printf "%.6f ", $2 }')" '0.250000 0.750000 '
  done
  printf 'ax,ay,az,dx,dy,dz\n1002.1,-2000.3,3000.4,-2,0,0\n' >rows.csv
  f query far.fta far hull --primitive ray <rows.csv
  same "$(printf '%s\n' "$out" | sed 1d | awk -F, '{ printf "%.6f ", $2 }')" '0.500000 '
  bend | awk -F, 'NR > 1 { $0 = $1 + 1000.1 "," $2 - 2000.2 "," $3 + 3000.3 } { print }' >rail.csv
  bake rail.csv -o rail.fta
  says 'reaches 3001 m from the origin'
  printf 'x[mm],y[mm],z[mm]\n1002100,-2000150,3000300\n' >rows.csv
  f query rail.fta rail curve <rows.csv
  same "$(printf '%s\n' "$out" | sed 1d | awk -F, '{ printf "%.6f %.6f %.6f %.6f", $1, $2, $3, $4 }')" \
    '0.050000 1002.100000 -2000.200000 3000.300000'
}

# What a message quotes of a file is short and printable.
AWordOfABinaryFileIsQuotedInShort() {
  { head -c 100000 /dev/zero | tr '\0' 'A'; printf '\033[31m 1\n'; } >long.tool
  refused long.tool ':1:' 'is expected instead of'
  [ ${#err} -lt 1200 ] || fail "${#err} characters in a message"
}

# A pipe stays one: a renamed file would stand where the device was.
ADeviceOrAPipeIsWrittenTo() {
  box >box.obj
  bake box.obj -o box.fta
  mkfifo pipe
  cat pipe >read.fta &
  reader=$!
  bake box.obj -o pipe
  [ -p pipe ] || { fail 'the pipe is gone'; kill $reader 2>/dev/null; }
  wait $reader
  cmp -s box.fta read.fta || fail 'other bytes'
}

AnInputWithoutAnEndIsRefusedAtOnce() {
  f info /dev/zero
  exits 3
  says '/dev/zero: is a device, which may have no end; name a file'
}

# Before any work: the model is not even read.
AnOutputThatCannotBeIsRefusedAtOnce() {
  mkdir folder
  for output in folder folder/; do
    f bake missing.obj -o $output
    exits 3
    says "$output: is a folder; name a file in it"
  done
  mkdir ./-
  box >box.obj
  f bake box.obj -o -
  exits 0
  rmdir folder ./- || fail 'a file is left'
  for command in 'bake missing.obj -o none/x.fta' 'bake missing.obj -o x.fta --cpp none/x.cpp' \
    'hull missing.obj --faces 9 -o none/x.obj' 'voxelize missing.obj -n 9 -o none/x.vti'; do
    f $command
    exits 3
    says ': cannot be written: there is no folder none; make it, or name a file elsewhere'
  done
}

APipeAsInputIsRefusedWhereItIsReadTwice() {
  box >box.obj
  mkfifo pipe.obj pipe.fta
  for input in pipe.obj pipe.fta; do
    refused $input 'is a pipe or a device, and it is read twice; copy it to a file first'
  done
  f mend pipe.obj -o m.obj --centre
  exits 3
  says 'pipe.obj: is a pipe'
  cat box.obj >pipe.obj &
  f mend pipe.obj -o m.obj
  exits 0
}

# useless INPUT OPTION...: exit 2, each option is named, no file left
useless() {
  input=$1
  shift
  for option in "$@"; do
    # shellcheck disable=SC2086
    f bake "$input" -o bad.fta $option
    exits 2
    says "bake: ${option%% *} is of a " 'none is given: add one, or leave it out'
    absent bad.fta
  done
}

AnOptionThatNoInputUsesIsRefused() {
  box >box.obj
  printf 'x,y,z\n0,0,0\n1,0,0\n1,1,0\n' >path.csv
  printf 'sphere 0 0 0 mm radius 5 mm\n' >tip.tool
  useless box.obj --smooth --curve-tree --decimal-comma '--teach a'
  useless path.csv --unsigned --mend --close-holes '--wrap 1%' --small --fast --bounded --desktop --keep-triangles \
    '--distance-map 9' '--hull-faces 8' '--materials no.txt' '--teach a'
  bake box.obj -o box.fta
  useless box.fta '--unit mm' '--scale 2' '--up y' '--rotate z:90' '--size 1' --centre '--translate 1,0,0' --smooth --small
  bake box.obj path.csv tip.tool -o all.fta --smooth --curve-tree --small --unit mm
}
