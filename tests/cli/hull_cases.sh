# Cases of tests/cli/run about hulls.

AHullIsWrittenAndIsAModelItself() {
  f make part -o part.obj --triangles 4000; exits 0
  for strategy in 1 2 lazy; do
    f hull part.obj --faces 500 --strategy $strategy -o hull.obj; exits 0
    says '500 faces enclose' 'void' 'proven outside in exact arithmetic'
    same "$(grep -c '^f ' hull.obj)" 500
    f bake hull.obj -o hull.fta; exits 0
    says 'closed: inside and outside are known'
  done
  f hull part.obj --faces 500 -o again.obj; exits 0
  cmp -s hull.obj again.obj || fail 'a second run gave other bytes'
  f hull part.obj --faces 500 --hull-grid 16 -o coarse.obj; exits 0
  says 'grid of'
}

LevelsAreNestedAndReadBackFromEachFormat() {
  f make part -o part.obj --triangles 3000; exits 0
  for form in obj stl; do
    f hull part.obj --faces 1500,600,200 -o hull.$form --json; exits 0; well_formed
    says '1500 faces enclose' '600 faces enclose' '200 faces enclose'
    member '"file": "hull_200.'$form'", "triangles": 200' '"levels": [{"file": "hull_1500.'$form'", "triangles": 1500'
    for faces in 1500 600 200; do
      bake hull_$faces.$form -o $form$faces.fta --keep-triangles; says "$faces triangles" 'closed: inside and outside are known'
    done
  done
  absent hull.obj
  f hull part.obj --faces 600 -o one.stl; exits 0
  cmp -s one.stl hull_600.stl || { f bake one.stl -o one.fta; says '600 triangles'; }
  # No vertex of a finer level is outside of the next; a format changes no distance.
  for pair in 'part 1500' '1500 600' '600 200'; do
    finer=${pair% *} coarser=${pair#* }
    [ "$finer" = part ] && finer=part.obj || finer=hull_$finer.obj
    { echo x,y,z; sed -n 's/^v \(.*\) \(.*\) \(.*\)/\1,\2,\3/p' "$finer"; } >vertices.csv
    f query obj$coarser.fta hull_$coarser distance <vertices.csv; exits 0
    inside=$(printf '%s\n' "$out" | awk -F, 'NR > 1 && $1 < -1e-6 { ++inside } NR > 1 && $1 > 1e-8 { bad = 1 } END { print bad ? 0 : inside }')
    [ "$inside" -gt 50 ] || fail "$finer is not inside $coarser"
    printf '%s\n' "$out" | cut -d, -f1 >of_obj
    f query stl$coarser.fta hull_$coarser distance <vertices.csv; exits 0
    printf '%s\n' "$out" | cut -d, -f1 | cmp -s - of_obj || fail "the .stl of $coarser has other distances"
  done
}

BadModelsAreNoHulls() {
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n' >open.obj
  f hull open.obj --faces 4 -o h.obj; exits 3; says open.obj '3 open edges' '--close-holes'; absent h.obj
  f hull open.obj --faces 4 --close-holes -o h.obj; exits 0; says 'closed 1 hole' 'written as it is'; rm h.obj
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 -1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 1 2 5\n' >fin.obj
  f hull fin.obj --faces 4 -o h.obj; exits 3; says fin.obj 'share'; absent h.obj
  box | sed 's/^f \(.\) \(.\) \(.\) \(.\)/f \4 \3 \2 \1/' >inward.obj
  f hull inward.obj --faces 12 -o h.obj; exits 0; says 'turned 1 piece of 12 faces wound inside out' 'void 0 %'
  : >empty.obj; rm h.obj
  f hull empty.obj --faces 4 -o h.obj; exits 3; says empty.obj; absent h.obj
  { box; echo 'f 1 1 2'; } >flat.obj
  f hull flat.obj --faces 12 -o h.obj; exits 0; says 'mended'; rm h.obj
}

AHullThatCannotBeCoarserSaysWhereAndWhy() {
  f make part -o part.obj --triangles 2000; exits 0
  f hull part.obj --faces 4 -o h.obj; exits 0
  says 'stops at' 'of the 4 requested' 'may collapse' 'first the edge at vertex' '--compactness'
  [ -s h.obj ] || fail 'the best was not kept'
  f hull part.obj --faces 100000 -o h.obj; exits 0; says 'written as it is'
}

HullsNeedFacesAndAnObjFile() {
  box >box.obj
  f hull box.obj -o h.obj; exits 2; says '--faces N'
  f hull box.obj --faces 8; exits 2; says '-o FILE.obj'
  f hull box.obj --faces 8 -o h.vti; exits 2; says '.obj' '.stl'
  for faces in 8,8 4,8 8, ,8 8,x 8,3 -8; do f hull box.obj "--faces=$faces" -o h.obj; exits 2; says '--faces'; done
  f hull box.obj --faces 8,4 -o -; exits 2; says 'name a file'
  f hull box.obj --faces 8,4 -o ./box.obj; exits 0; rm box_8.obj box_4.obj
  f hull box.obj --faces 12,8 -o h.obj; cp h_8.obj box_8.obj; f hull box_8.obj --faces 12,8 -o box.obj; exits 2; says 'box_8.obj'
  rm h_12.obj h_8.obj
  f hull box.obj --faces 3 -o h.obj; exits 2; says '--faces'
  f hull box.obj --faces 8 -o box.obj; exits 2; says 'box.obj'
  f hull box.obj --faces 8 --strategy 3 -o h.obj; exits 2; says '--strategy'
  f hull box.obj --faces 8 --compactness 2 -o h.obj; exits 2; says 'at most 1'
  f hull box.obj --faces 8 --max-deviation-deg 91 -o h.obj; exits 2; says 'at most 90'
  absent h.obj
}

AModelThatCrossesItselfListsThePlaces() {
  box >two.obj
  box | sed -n 's/^v \(.*\) \(.*\) \(.*\)/\1 \2 \3/p' |
    awk '{ print "v", $1 + 0.7, $2 + 1.1, $3 + 1.3 }' >>two.obj
  box | awk '/^f/ { print "f", $2 + 8, $3 + 8, $4 + 8, $5 + 8 }' >>two.obj
  f hull two.obj --faces 24 -o h.obj; exits 0; says 'crosses itself in' 'place 1 of 1'
}

WhatIsNoSoundSurfaceIsNamedOrMendedFirst() {
  box >box.obj
  sed '$d' box.obj >open.obj
  f hull open.obj --faces 8 -o h.obj; exits 3; says 'open.obj' 'open edges around 1 hole' 'first the edge'
  { box; printf 'v 9 9 9\nf 1 2 9\n'; } >three.obj
  f hull three.obj --faces 8 -o h.obj; exits 3; says 'three.obj' 'more than two faces share'
  f bake three.obj -o a.fta --hull-faces 8; exits 3; says 'more than two faces share'
  absent h.obj; absent a.fta
  awk '/^f/ { print "f", $5, $4, $3, $2; next } { print }' box.obj >turned.obj
  f hull turned.obj --faces 8 -o h.obj; exits 0; says 'turned 1 piece' 'wound inside out'
  { box; echo 'f 1 1 2'; } >twice.obj
  f hull twice.obj --faces 8 -o h.obj; exits 0; says 'dropped 1 face that names a vertex twice'
  f make part -o part.obj --triangles 2000; exits 0
  vertices=$(grep -c '^v ' part.obj)
  { cat part.obj; awk -v n="$vertices" '/^v / { print "v", $2 + 1, $3, $4 } /^f / { print "f", $2 + n, $3 + n, $4 + n }' part.obj; } >apart.obj
  f hull apart.obj --faces 800 -o h.obj; exits 0; says '800 faces enclose'
  [ "$(awk '/^v / { if ($2 < 0.5) a++; else b++ } END { print (a > 100 && b > 100) }' h.obj)" = 1 ] ||
    fail 'the pieces were not coarsened each by itself'
}

AHullIsBakedShownAndAsked() {
  f make part -o part.obj --triangles 2000; exits 0
  f bake part.obj -o s.fta --hull-faces 200 --hull-grid 16 --keep-triangles; exits 0
  says 'progressive hull down to 200 faces' 'RAM of a refinement' 'proven with' 'opens in about'
  f bake part.obj -o again.fta --hull-faces 200 --hull-grid 16 --keep-triangles; cmp -s s.fta again.fta || fail 'another hull the second time'
  f info s.fta; exits 0
  printf '%s\n' "$out" | grep -q 'hull boxes of stars' || fail "$out"
  f bake part.obj -o bare.fta --hull-faces 200 --hull-grid 16 --no-tree; exits 0; says 'only queries of its hull'
  f info bare.fta; exits 0
  printf 'ax,ay,az,bx,by,bz\n-1,0.01,0.002,1,0.012,0.003\n0,0,-1,0.03,0.01,1\n0,0,3,1,0,3\n' >g.csv
  f query s.fta part segment --all <g.csv; exits 0; tree=$out
  [ "$(printf '%s\n' "$tree" | wc -l)" -gt 3 ] || fail "too few to tell: $tree"
  f query s.fta part hull --all <g.csv; exits 0; same "$out" "$tree"
  f query bare.fta part hull --all <g.csv; exits 0; same "$out" "$tree"
  f query s.fta part segment <g.csv; exits 0; tree=$(printf '%s\n' "$out" | cut -d, -f1-3)
  for mode in '' '--mode complete' '--mode refine' '--mode refine --base 800'; do
    # shellcheck disable=SC2086
    f query s.fta part hull $mode <g.csv; exits 0
    same "$(printf '%s\n' "$out" | cut -d, -f1-3)" "$tree"
    same "$(printf '%s\n' "$out" | sed -n 1p)" hit,t,triangle,steps,exact
  done
  f query s.fta part hull --mode refine --budget 3 <g.csv; exits 0
  f query s.fta part hull --time <g.csv; exits 0
  printf '%s\n' "$out" | grep -qxE 'us_per_query [0-9]+\.[0-9]{4} queries 3' || fail "$out"
}

AHullIsAskedWithRaysAndTriangles() {
  f make part -o part.obj --triangles 2000; exits 0
  f bake part.obj -o s.fta --hull-faces 200 --hull-grid 16; exits 0
  printf 'ax,ay,az,bx,by,bz\n-1,0.01,0.002,1,0.012,0.003\n0,0,-1,0.03,0.01,1\n' >g.csv
  printf 'ax,ay,az,dx,dy,dz\n-1,0.01,0.002,2,0.002,0.001\n0,0,-1,0.03,0.01,2\n' >r.csv
  f query s.fta part hull --all <g.csv; exits 0; segments=$(printf '%s\n' "$out" | cut -d, -f1,3)
  f query s.fta part hull --all --primitive ray <r.csv; exits 0; same "$(printf '%s\n' "$out" | cut -d, -f1,3)" "$segments"
  f query s.fta part hull <g.csv; exits 0; first=$(printf '%s\n' "$out" | sed -n 2p | cut -d, -f2)
  f query s.fta part hull --primitive ray <r.csv; exits 0
  printf '%s\n' "$out" | sed -n 2p | awk -F, -v t="$first" '{ exit !($1 == 1 && $2 - t < 1e-5 && t - $2 < 1e-5) }' || fail "$out"
  printf 'ax,ay,az,dx,dy,dz\n0,0,0,0,0,0\n' >none.csv
  f query s.fta part hull --primitive ray <none.csv; exits 3; says 'row 1' 'direction'
  printf 'ax,ay,az,bx,by,bz,cx,cy,cz\n-1,0.01,0.002,1,0.012,0.003,0,0,1\n0,0,3,1,0,3,0,1,3\n' >t.csv
  f query s.fta part hull --primitive triangle --all <t.csv; exits 0; whole=$out
  [ "$(printf '%s\n' "$whole" | wc -l)" -gt 5 ] || fail "too few to tell: $whole"
  same "$(printf '%s\n' "$whole" | sed -n 1p)" asked,triangle
  printf '%s\n' "$whole" | grep -q '^1,' && fail 'a triangle far off crosses something'
  f query s.fta part hull --primitive triangle <t.csv; exits 0
  same "$(printf '%s\n' "$out" | cut -d, -f1)" "$(printf 'hit\n1\n0')"
  f query s.fta part hull --primitive triangle --mode refine --all <t.csv; exits 0
  printf '%s\n' "$out" | sort >refined; printf '%s\n' "$whole" | sort >whole
  [ -z "$(comm -23 refined whole)" ] || fail 'refinement makes some up'
  f query s.fta part hull --primitive triangle --time <t.csv; exits 0
  f query s.fta part hull --primitive sphere <t.csv; exits 2; says '--primitive'
  f query s.fta part segment --primitive ray <r.csv; exits 2; says '--primitive'
}

WhatAHullCannotDoIsRefused() {
  box >box.obj
  f bake box.obj -o a.fta --hull-grid 16; exits 2; says '--hull-faces N'
  f bake box.obj -o a.fta --no-tree; exits 2; says '--hull-faces N'
  f bake box.obj -o a.fta --hull-faces 8 --unsigned; exits 2; says 'needs an inside'
  f bake box.obj -o a.fta --hull-faces 8 --max-valence 40; exits 2; says 'at most 31'
  f bake box.obj -o a.fta --hull-faces 8 --no-tree --distance-map 9; exits 2; says 'needs the tree'
  absent a.fta
  f bake box.obj -o a.fta; exits 0
  printf 'ax,ay,az,bx,by,bz\n5,0,0,-5,0.1,0.2\n' >g.csv
  f query a.fta box hull <g.csv; exits 3; says 'has no hull' '--hull-faces'
  f bake box.obj -o a.fta --hull-faces 4 --no-tree; exits 0; says 'stops at' 'void 0 %'
  f query a.fta box segment <g.csv; exits 3; says '--no-tree'
  f query a.fta box hull --base 4 <g.csv; exits 2; says '--mode complete'
  f query a.fta box hull --mode refine --base 4 <g.csv; exits 3; says 'down to'
  f query a.fta box hull --mode exact <g.csv; exits 2; says '--mode'
}
