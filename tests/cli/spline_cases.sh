# Cases of tests/cli/run about splines.

# A quarter of a unit arc (about) in one Bezier patch of a roof, 1 m deep: .bpt.
roof() {
  printf '1\n1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16\n16\n'
  for y in 0 0.333333333 0.666666667 1; do
    printf '%s\n' "0,$y,0" "0.3,$y,0.4" "0.7,$y,0.4" "1,$y,0"
  done
}

ASplineIsBakedToldAndAsked() {
  roof >roof.bpt
  bake roof.bpt -o a.fta
  says 'spline surface, 1 entity' 'worst query seen' 'instructions on a Cortex-M7'
  f info a.fta
  exits 0
  printf '%s\n' "$out" | grep -q 'spline pieces' || fail "info: $out"
  printf 'x,y,z\n0.5,0.5,1.3\n0,-1,0\n' >p.csv
  f query a.fta roof spline <p.csv
  exits 0
  same "$(printf '%s\n' "$out" | sed -n 1p)" 'distance,cx,cy,cz,piece,u,v,lower,steps,exact'
  same "$(printf '%s\n' "$out" | awk -F, 'NR > 1 { printf "%.5f,%s,%s\n", $1, $5, $10 }')" '1.00000,0,1
1.00000,0,1'
  f query a.fta roof spline --work 1 --cold <p.csv
  exits 0
  same "$(printf '%s\n' "$out" | sed 1d | cut -d, -f9,10)" '0,0
0,0'
  f query a.fta roof distance <p.csv
  exits 3
  says "holds no mesh 'roof'" 'splines: roof'
}

# Counting ended after minutes on the first, and never on the second.
AFoldedSurfaceIsNamedAndOneWithoutAreaRefused() {
  printf '1\n1 1\n0 0 0\n1 0 0\n2 0 0\n3 0 1e-3\n' >fold.bpt
  bake fold.bpt -o a.fta
  says 'or more' 'warning: ' 'of 4000 queries were not exact after 60000 units of work, nearest to patch 0 in line 2' 'folded on itself'
  seen=$(printf '%s\n' "$err" | sed -n 's/.*worst seen \([0-9]*\).*/\1/p' | sort -n | tail -n 1)
  worst=$(printf '%s\n' "$err" | sed -n 's/.*worst query seen: [a-z ]*\([0-9]*\) steps.*/\1/p')
  [ "$worst" -ge "$seen" ] || fail "worst query $worst, but $seen seen"
  printf '1\n1 1\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n' >line.bpt
  f bake line.bpt -o b.fta
  exits 3
  says 'line.bpt:2: patch 0 in line 2 has no area' 'remove it'
  absent b.fta
}

AUnitGivenStandsAboveTheFiles() {
  roof >roof.bpt
  bake roof.bpt -o a.fta --unit mm
  says 'extent 0.001 m'
}

EveryFootPointIsListedWithItsKind() {
  roof >roof.bpt
  bake roof.bpt -o a.fta
  printf 'x,y,z\n0.5,0.5,1.3\n0.5,0.5,-3\n' >p.csv
  f query a.fta roof footpoints <p.csv
  exits 0
  same "$(printf '%s\n' "$out" | sed -n 1p)" 'point,kind,distance,cx,cy,cz,piece,u,v'
  same "$(printf '%s\n' "$out" | awk -F, '$2 != "end" && NR > 1 { printf "%s,%s,%.5f\n", $1, $2, $3 }')" '0,min,1.00000
1,saddle,3.30000'
  same "$(printf '%s\n' "$out" | awk -F, '$2 == "end" && $1 == 0' | wc -l | tr -d ' ')" 8 # corners, middles of the edges
  f query a.fta roof footpoints --budget 3 <p.csv; exits 2; says '--budget has no meaning for footpoints'
}

ACadKernelsFileIsBakedAndAskedInItsUnit() {
  cad=$here/../spline/cad
  bake "$cad/circle-and-ellipse.igs" "$cad/torus.igs" "$cad/wave-in-inches.igs" -o a.fta
  printf 'x,y,z\n0.1,0.005,0\n' >p.csv
  f query a.fta circle-and-ellipse footpoints <p.csv
  exits 0
  same "$(printf '%s\n' "$out" | awk -F, '$7 == 0 { printf "%s,%.6f\n", $2, $3 }')" 'min,0.050000
max,0.130000'
  printf 'x,y,z\n0.06,0.01,0.005\n' >p.csv
  f query a.fta torus footpoints <p.csv
  exits 0
  same "$(printf '%s\n' "$out" | sed 1d | cut -d, -f2 | sort | tr '\n' ' ')" 'max min saddle saddle '
  f bake "$cad/trimmed-face.igs" -o bad.fta
  exits 3
  says 'trimmed-face.igs:6: entity 144 in line 6' 'trimmed surfaces are not read'
  absent bad.fta
}

# A walk of a spline goes through its box and a fifth of its extent beyond, in even steps; of a curve in a plane it stays there.
AWalkAboutSplinesKeepsToTheirBox() {
  f make curve -o c.igs; exits 0
  f make curve --space -o s.igs; exits 0
  for name in c s; do
    f make walk $name.igs --points 3000 -o w.csv; exits 0
    f bake $name.igs -o a.fta; exits 0
    extent=$(printf '%s\n' "$err" | sed -n 's/.*extent \([0-9.]*\) m.*/\1/p')
    awk -F, -v extent="$extent" -v planar="$([ $name = c ] && echo 1)" '
      NR == 1 { next }
      NR > 2 { step = sqrt(($1 - x) ^ 2 + ($2 - y) ^ 2 + ($3 - z) ^ 2); if (step > 1.002 * 0.002 * extent) far++; sum += step }
      { for (i = 1; i <= 3; i++) { if (NR == 2 || $i < low[i]) low[i] = $i; if (NR == 2 || $i > high[i]) high[i] = $i }
        x = $1; y = $2; z = $3 }
      END { for (i = 1; i <= 3; i++) if (high[i] - low[i] > 1.41 * extent) exit 1
            exit far > 0 || sum < 0.0019 * extent * 2900 || (planar != "") != (high[3] == low[3]) }' w.csv ||
      fail "the walk of $name.igs"
  done
  printf 'no spline\n' >bad.igs
  f make walk bad.igs -o w2.csv; exits 3; says bad.igs; absent w2.csv
}
