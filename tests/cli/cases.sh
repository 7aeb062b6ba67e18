# Cases of tests/cli/run: a function a claim.

# A box of 2 x 4 x 6 about the origin; face 0 and 1 at the bottom, 2 and 3 on top.
box() {
  printf 'v %s\n' '-1 -2 -3' '1 -2 -3' '1 2 -3' '-1 2 -3' '-1 -2 3' '1 -2 3' '1 2 3' '-1 2 3'
  printf 'f %s\n' '1 4 3 2' '5 6 7 8' '1 2 6 5' '2 3 7 6' '3 4 8 7' '4 1 5 8'
}
# Along x for 3 m, unevenly, then 1 m up.
bend() { printf 'x,y,z\n0,0,0\n1,0,0\n3,0,0\n3,0,1\n'; }
small_scene() {
  box >box.obj
  bend >bend.csv
  bake box.obj bend.csv -o scene.fta
}

EveryCommandHelps() {
  for command in '' make bake info query bench; do
    # shellcheck disable=SC2086
    f $command --help
    exits 0
    same "$err" ''
    case $out in usage:*) ;; *) fail "$command: $out" ;; esac
  done
}

WithoutACommandTheUsageGoesToStderr() {
  f
  exits 2
  same "$out" ''
  says 'usage: firmtouch COMMAND'
}

WhatDoesNotExistIsAUsageError() {
  f bend; exits 2; says "'bend' is no command"
  f bake x.obj --fats -o a.fta; exits 2; says 'unknown option --fats' 'firmtouch bake --help'
  f make ball -o a.obj; exits 2; says "'ball' cannot be made"
  f query a.fta a touch; exits 2; says "'touch' is no kind of query"
  f bake x.obj -o a.fta --unit furlong; exits 2; says 'furlong' 'm, mm, cm, in'
  f query a.fta a distance --budget -1; exits 2; says '--budget -1'
  f query a.fta a distance --budget; exits 2; says '--budget needs a value'
  f query a.fta a distance --cold --cold; exits 2; says '--cold is given twice'
  f query a.fta a; exits 2; says 'missing'
  f info a.fta b.fta; exits 2; says "one word too many: 'b.fta'"
  f bake x.obj; exits 2; says '-o SCENE.fta'
  f make part; exits 2; says '-o FILE'
  f make walk -o w.csv; exits 2; says 'MODEL'
}

OptionsWithoutMeaningAreRefused() {
  small_scene
  f query scene.fta box distance --mode exact </dev/null; exits 2; says '--mode has no meaning for distance'
  f query scene.fta bend curve --n 3 </dev/null; exits 2; says '--n has no meaning for --mode exact'
  f make part --points 9 -o p.obj; exits 2; says '--points has no meaning for part'
  f make surface --space -o s.igs; exits 2; says '--space has no meaning for surface'
}

AMissingFileIsNamed() {
  f bake missing.obj -o a.fta; exits 3; says missing.obj; absent a.fta
  f bake missing.csv -o a.fta; exits 3; says missing.csv
  f info missing.fta; exits 3; says missing.fta
  f query missing.fta a distance; exits 3; says missing.fta
  f make walk missing.off -o w.csv; exits 3; says missing.off; absent w.csv
  mkdir folder.obj
  f bake folder.obj -o a.fta; exits 3; says folder.obj
}

AFailingCommandLeavesNoFile() {
  box | sed 1d >box.obj
  bend >bend.csv
  f bake bend.csv box.obj -o a.fta --cpp a.cpp
  exits 3
  says box.obj
  absent a.fta
  absent a.cpp
  box >box.obj
  f bake box.obj -o a.fta --cpp nowhere/a.cpp
  exits 3
  says nowhere/a.cpp
  absent a.fta
  f bake box.obj -o nowhere/a.fta
  exits 3
  says nowhere/a.fta
}

AnInputIsNeverOverwritten() {
  box >box.obj
  f bake box.obj -o box.obj; exits 2; says 'overwrite'
  f bake box.obj -o a.fta --cpp ./box.obj; exits 2; says 'overwrite'
  cp box.obj box.csv
  f make walk box.csv -o box.csv; exits 2; says 'overwrite'
  same "$(box | cksum)" "$(cksum <box.obj)"
  f bake box.obj -o a.fta --cpp a.fta; exits 2; absent a.fta
}

AnOpenSurfaceIsRefusedUnlessUnsigned() {
  box | sed '$d' >box.obj
  f bake box.obj -o a.fta
  exits 3
  says box.obj 'open edge' '--unsigned'
  absent a.fta
  bake box.obj -o a.fta --unsigned
  says 'unsigned'
  printf 'x,y,z\n0,0,5\n' >p.csv
  f query a.fta box distance <p.csv
  exits 0
  same "$(printf '%s\n' "$out" | sed -n 2p | cut -d, -f1,2)" 2,0
}

TwoInputsOfOneNameAreRefused() {
  mkdir a
  box >box.obj
  bend >a/box.csv
  f bake box.obj a/box.csv -o a.fta
  exits 3
  says a/box.csv box.obj "'box'" rename
}

ANameTooLongIsRefused() {
  name=a234567890123456789012345678901
  box >$name.obj
  bake $name.obj -o a.fta
  box >${name}2.obj
  f bake ${name}2.obj -o b.fta
  exits 3
  says ${name}2 31
}

NamesMayHoldSpacesAndUmlauts() {
  box >'mein Körper 2.obj'
  bake 'mein Körper 2.obj' -o 'meine Szene.fta'
  printf 'x,y,z\n0,0,5\n' >p.csv
  f query 'meine Szene.fta' 'mein Körper 2' distance <p.csv
  exits 0
}

TheSameInputsGiveTheSameBytes() {
  small_scene
  mkdir b
  cp box.obj bend.csv b/
  bake b/bend.csv b/box.obj -o again.fta
  cmp -s scene.fta again.fta || fail 'other bytes'
  bake box.obj bend.csv -o mm.fta --unit mm
  cmp -s scene.fta mm.fta && fail '--unit changed nothing'
}

AMadeFileIsWhatItsNameSays() {
  f make part -o p.ply; exits 2; says "'p.ply'" '.obj' '-o p.obj'; absent p.ply
  f make part -o p; exits 2; says '.obj'; absent p
  f make path -o p.obj; exits 2; says '.csv'; absent p.obj
  f make curve -o c.bpt; exits 2; says "'c.bpt'" '.igs'; absent c.bpt
  box >box.obj
  f make walk box.obj -o w.txt; exits 2; says "'w.txt'" '.csv'; absent w.txt
  f make part --triangles 2000 -o P.OBJ; exits 0
}

MakingIsDeterministicToo() {
  for kind in 'part --triangles 2000' path 'curve --space' 'surface --weights'; do
    case $kind in part*) end=obj ;; path) end=csv ;; *) end=igs ;; esac
    # shellcheck disable=SC2086
    f make $kind --seed 3 -o a.$end
    exits 0
    # shellcheck disable=SC2086
    f make $kind --seed 3 -o b.$end
    exits 0
    cmp -s a.$end b.$end || fail "$kind: other bytes"
    # shellcheck disable=SC2086
    f make $kind --seed 4 -o c.$end
    exits 0
    cmp -s a.$end c.$end && fail "$kind: --seed changed nothing"
  done
}

DistancesOfABoxAreKnown() {
  small_scene
  printf 'x,y,z\n0,0,5\n0.25,0,2.5\n3,0,0\n4,6,3\n4,6,15\n' >p.csv
  f query scene.fta box distance <p.csv
  exits 0
  same "$err" ''
  same "$(printf '%s\n' "$out" | sed -n 1p)" 'distance,sign,cx,cy,cz,nx,ny,nz,triangle,feature,lower,steps,exact'
  same "$(printf '%s\n' "$out" | sed 1d | cut -d, -f1,2,5,13)" '2,1,3,1
-0.5,-1,3,1
2,1,0,1
5,1,3,1
13,1,3,1'
  same "$(printf '%s\n' "$out" | sed -n 6p | cut -d, -f10)" vertex
  case $(printf '%s\n' "$out" | sed -n 2p | cut -d, -f9) in 2 | 3) ;; *) fail "triangle of the file: $out" ;; esac
}

CadPartsAreBaked() {
  f make cad --seed 3 -o sheet.obj; exits 0
  bake --unit mm sheet.obj -o sheet.fta
  f make cad --triangles 9 -o c.obj; exits 2; says "--triangles has no meaning for cad"
}

EveryBakeTellsTheSameDistances() {
  f make part --triangles 2000 -o p.obj; exits 0
  bake p.obj -o fast.fta --keep-triangles
  awk 'BEGIN { print "x,y,z"; for (i = 0; i < 300; ++i) print (i % 7 - 3) / 40 "," (i % 11 - 5) / 50 "," (i % 13 - 6) / 70 }' >p.csv
  f query fast.fta p distance --cold <p.csv
  exits 0
  of_fast=$(printf '%s\n' "$out" | cut -d, -f1,2,13)
  for option in --bounded --small --desktop; do
    bake p.obj -o other.fta "$option" --keep-triangles
    cmp -s fast.fta other.fta && fail "$option changed nothing"
    f query other.fta p distance --cold <p.csv
    exits 0
    same "$(printf '%s\n' "$out" | cut -d, -f1,2,13)" "$of_fast"
  done
  f bake p.obj -o a.fta --small --desktop; exits 2; says contradict; absent a.fta
  f bake p.obj -o a.fta --fast --bounded; exits 2; says contradict; absent a.fta
}

AFormerOptionNameIsAcceptedWithANote() {
  f make part --triangles 2000 -o p.obj; exits 0
  bake p.obj -o now.fta --bounded
  bake p.obj -o former.fta --steady; says '--steady is called --bounded now'
  cmp -s now.fta former.fta || fail 'the former name bakes other bytes'
  f bake p.obj -o a.fta --steady --bounded; exits 2; says '--bounded is given twice'; absent a.fta
}

TheUnitScalesTheModel() {
  box >box.obj
  bake box.obj -o a.fta --unit cm
  printf 'x,y,z\n0.002,0.001,0.05\n' >p.csv
  f query a.fta box distance <p.csv
  same "$(printf '%s\n' "$out" | sed -n 2p | cut -d, -f2,10)" 1,face
  case $(printf '%s\n' "$out" | sed -n 2p) in 0.02,* | 0.0200000*,* | 0.0199999*,*) ;; *) fail "$out" ;; esac
}

APolylineIsAnsweredBetweenItsSamples() {
  small_scene
  printf 'x,y,z\n2,1,0\n4,0,0.5\n-1,0,0\n' >p.csv
  f query scene.fta bend curve <p.csv
  exits 0
  same "$(printf '%s\n' "$out" | cut -d, -f1-6,9)" 'distance,cx,cy,cz,segment,arc,exact
1,2,0,0,1,0.5,1
1,3,0,0.5,2,0.875,1
1,0,0,0,0,0,1'
  f query scene.fta bend curve --mode nearest --n 1 --arc-penalty 0.1 <p.csv
  exits 0
  same "$(printf '%s\n' "$out" | wc -l | tr -d ' ')" 4
}

RowsOfACurveKeepTheirNumbers() {
  printf 'x,y,z\n0,0,0\n0,0,0\n1,0,0\n2,0,0\n' >c.csv
  bake c.csv -o a.fta
  says mended
  printf 'x,y,z\n1.5,1,0\n' >p.csv
  f query a.fta c curve <p.csv
  same "$(printf '%s\n' "$out" | sed -n 2p | cut -d, -f5)" 2
}

ColumnsComeInAnyOrderWithCrlfAndBlankLines() {
  small_scene
  printf '\357\273\277z, note ,y,x\r\n5,a,0,0\r\n\r\n 2.5,b, 0 ,+0.25\r\n' >p.csv
  f query scene.fta box distance <p.csv
  exits 0
  same "$(printf '%s\n' "$out" | sed 1d | cut -d, -f1)" '2
-0.5'
}

BadRowsAreNamedByLine() {
  small_scene
  printf 'x,y,z\n1,2,3\n\n1,2\n' >p.csv
  f query scene.fta box distance <p.csv; exits 3; says 'standard input:4' "column 'z'" missing; same "$out" ''
  printf 'x,y,z\n1,two,3\n' >p.csv
  f query scene.fta box distance <p.csv; exits 3; says 'standard input:2' "'two' is not a number"
  printf '1,2,3\n' >p.csv
  f query scene.fta box distance <p.csv; exits 3; says 'standard input:1' "no column 'x'" 'x,y,z'
  f query scene.fta box segment <p.csv; exits 3; says 'ax,ay,az,bx,by,bz'
  printf 'x,y,z\n1,2,3\n0,5,1,0\n' >p.csv
  f query scene.fta box distance <p.csv; exits 3; says 'standard input:3' 'has 4 values' 'decimal comma'; same "$out" ''
  printf 'x,y,z,x\n' >p.csv
  f query scene.fta box distance <p.csv; exits 3; says "'x' twice"
  f query scene.fta box distance </dev/null; exits 3; says empty
}

APointThatIsNotANumberGetsAFiniteAnswer() {
  small_scene
  printf 'x,y,z\nnan,0,0\n-inf,0,1e39\n1e400,1,1\n0,0,5\n' >p.csv
  for kind in 'box distance' 'bend curve'; do
    # shellcheck disable=SC2086
    f query scene.fta $kind <p.csv
    exits 0
    same "$(printf '%s\n' "$out" | wc -l | tr -d ' ')" 5
    printf '%s\n' "$out" | grep -qiE '(^|,)-?(nan|inf)' && fail "$out"
  done
  same "$(printf '%s\n' "$out" | sed 1d | awk -F, '{ print $NF }' | tr '\n' ' ')" '0 0 0 1 '
}

ABudgetIsKeptAndTold() {
  f make part --triangles 2000 -o part.obj
  bake part.obj -o a.fta
  f make walk part.obj --points 200 --seed 2 -o walk.csv; exits 0
  same "$(wc -l <walk.csv | tr -d ' ')" 201
  f query a.fta part distance --cold --work 5 <walk.csv; exits 0; five=$out
  printf '%s\n' "$out" | awk -F, 'NR > 1 && !($12 <= 3 * 5 && $11 >= 0) { exit 1 }' || fail 'more than three steps a unit'
  f query a.fta part distance --cold --budget 2 <walk.csv; same "$out" "$five"; says '--budget N is now --work N'
  f query a.fta part distance --cold --work 0 <walk.csv; exits 0; starved=$out
  f query a.fta part distance --cold --budget 0 <walk.csv; same "$out" "$starved"; exits 0
  f query a.fta part distance <walk.csv; warm=$(printf '%s\n' "$out" | cut -d, -f1)
  printf '%s\n' "$out" | awk -F, 'NR > 1 && $13 != 1 { exit 1 }' || fail 'not exact'
  f query a.fta part distance --cold <walk.csv
  same "$(printf '%s\n' "$out" | cut -d, -f1 | head -n 2)" "$(printf '%s\n' "$warm" | head -n 2)"
}

TimeIsOneLineWithoutCsv() {
  small_scene
  printf 'x,y,z\n0,0,5\n1,1,1\n' >p.csv
  for kind in 'box distance' 'bend curve'; do
    # shellcheck disable=SC2086
    f query scene.fta $kind --time <p.csv
    exits 0
    printf '%s\n' "$out" | grep -qxE 'us_per_query [0-9]+\.[0-9]{4} queries 2' || fail "$out"
  done
}

TimeOfNoRowsIsNoFigure() {
  small_scene
  printf 'x,y,z\n' >p.csv
  printf 'ax,ay,az,bx,by,bz\n' >g.csv
  f query scene.fta box distance --time <p.csv; exits 3; says 'no rows'; same "$out" ''
  f query scene.fta bend curve --time <p.csv; exits 3; says 'no rows'; same "$out" ''
  f query scene.fta box segment --time <g.csv; exits 3; says 'no rows'; same "$out" ''
  f query scene.fta box distance <p.csv; exits 0
}

AnAbsentNameIsAnsweredWithTheNamesThereAre() {
  small_scene
  f query scene.fta ball distance </dev/null; exits 3; says scene.fta "'ball'" 'meshes: box' 'curves: bend'
  f query scene.fta bend distance </dev/null; exits 3; says "no mesh 'bend'"
  f query scene.fta box curve </dev/null; exits 3; says "no curve 'box'"
}

ADamagedAssetIsRefusedByRule() {
  small_scene
  head -c 1000 scene.fta >cut.fta
  f info cut.fta; exits 3; says cut.fta 'rule R8' 'bake it again'
  { head -c 1000 scene.fta; printf 'XYZ'; tail -c +1004 scene.fta; } >bent.fta
  same "$(wc -c <bent.fta)" "$(wc -c <scene.fta)"
  f info bent.fta; exits 3; says 'rule R'
  f query box.obj box distance </dev/null; exits 3; says 'box.obj: not a sound asset: rule R3'
  : >empty.fta
  f info empty.fta; exits 3; says 'rule R2'
}

InfoTellsNamesSizesAndProvenance() {
  small_scene
  f info scene.fta
  exits 0
  for text in 'box:' 'bend:' 'source               box.obj' 'triangles            12' 'mesh nodes' 'bytes a triangle     '; do
    printf '%s\n' "$out" | grep -qF "$text" || fail "no '$text' in: $out"
  done
  f info scene.fta --json
  exits 0
  for text in '"triangles": 12' '"diagonal_m": 7.48331' '"tool": "firmtouch' '"source_fnv1a64": "' '"name": "box"' '"name": "bend"' '"source": "box.obj"' '"crc": "'; do
    printf '%s\n' "$out" | grep -qF "$text" || fail "no '$text' in: $out"
  done
  printf '%s' "$out" | tr -cd '{[' | wc -c >open
  printf '%s' "$out" | tr -cd '}]' | wc -c >close
  cmp -s open close || fail 'brackets of the JSON do not match'
}

TheCppSourceHoldsTheAsset() {
  box >box.obj
  bake box.obj -o 'a scene.fta' --cpp a.cpp
  cat >main.cpp <<'CPP'
#include <cstdint>
#include <cstdio>
extern const unsigned char a_scene_fta[];
extern const unsigned a_scene_fta_size;
int main() {
  if (reinterpret_cast<uintptr_t>(a_scene_fta) % 16 != 0) return 1;
  return std::fwrite(a_scene_fta, 1, a_scene_fta_size, stdout) == a_scene_fta_size ? 0 : 1;
}
CPP
  "$compiler" -std=c++17 -Wall -Wextra -Werror main.cpp a.cpp -o main || fail 'does not compile'
  ./main >back.fta || fail 'not aligned'
  cmp -s 'a scene.fta' back.fta || fail 'other bytes'
}

MendedInputIsReportedAndDone() {
  box | sed 's/^f \(.\) \(.\) \(.\) \(.\)/f \4 \3 \2 \1/' >box.obj
  bake box.obj -o a.fta
  says 'mended: ' 'inside out'
  printf 'x,y,z\n0,0,5\n' >p.csv
  f query a.fta box distance <p.csv
  same "$(printf '%s\n' "$out" | sed -n 2p | cut -d, -f1,2)" 2,1
}

AFullDiskIsNoSuccess() {
  [ -w /dev/full ] || return 0
  small_scene
  printf 'x,y,z\n0,0,5\n' >p.csv
  "$firmtouch" query scene.fta box distance <p.csv >/dev/full 2>.err
  status=$?
  err=$(cat .err)
  exits 3
  says 'standard output'
}
