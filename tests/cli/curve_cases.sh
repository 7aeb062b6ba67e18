# Cases of tests/cli/run about curves.

APenaltyHoldsAQueryOnItsPartOfACurve() {
  printf 'x,y,z\n0,0,0\n1,0,0\n1,0.1,0\n0,0.1,0\n' >c.csv
  bake c.csv -o a.fta
  printf 'x,y,z\n0.5,0.02,0\n0.5,0.06,0\n' >p.csv
  f query a.fta c curve <p.csv
  same "$(printf '%s\n' "$out" | sed 1d | cut -d, -f5)" '0
2'
  f query a.fta c curve --arc-penalty 1 <p.csv
  exits 0
  same "$(printf '%s\n' "$out" | sed 1d | cut -d, -f5,9)" '0,1
0,1'
}

ACurveBeyondTheUsualWorkspaceIsTold() {
  printf 'x,y,z\n0,0,0\n700,0,0\n' >c.csv
  bake c.csv -o a.fta
  says 'reaches 700 m' '--unit'
  f bake c.csv -o a.fta --unit mm; exits 0; says 'reaches 0.7 m'
  f bake c.csv -o a.fta --unit in; exits 0; says 'reaches 17.78 m'
}

ASmoothCurveGoesThroughItsSamplesWithoutCorners() {
  printf 'x,y,z\n0,0,0\n0.1,0,0\n0.1,0.1,0\n0.2,0.1,0\n' >c.csv
  bake c.csv -o a.fta --smooth
  says 'open smooth curve, 4 samples'
  f info a.fta; printf '%s\n' "$out" | grep -q 'cubic' || fail "info does not tell: $out"
  printf 'x,y,z\n0.1,0,0\n0.1,0.1,0\n0.15,0.1125,0\n' >p.csv
  f query a.fta c curve <p.csv
  exits 0
  printf '%s\n' "$out" | awk -F, 'NR == 2 || NR == 3 { if (!($1 < 1e-7)) exit 1 } NR == 4 { if (!($1 < 0.01 && $9 == 1)) exit 1 }' ||
    fail "answers: $out"
}

# Read as float32, the step of 3.3e-7 m turns by up to a tenth, and the pieces of 0.8 m beside it with it.
AShortStepBesideALongPieceIsSaid() {
  printf 'x,y,z\n0,0,0\n0.7,0.1,0.3\n0.70000031,0.10000077,0.2999999\n1.1,0.9,0.2\n' >c.csv
  bake c.csv -o a.fta --smooth
  says 'row 2 is 8.3e-07 m from the next one, beside a piece of' 'may lie up to 0.015 m' 'leave one of them out'
  bake c.csv -o a.fta
  case $err in *'leave one'*) fail "$err" ;; esac
  # The step that closes a ring, from row 3.
  printf 'x,y,z\n0.7,0.1,0.3\n1.1,0.9,0.2\n0.70000031,0.10000077,0.2999999\n0.7,0.1,0.3\n' >c.csv
  bake c.csv -o a.fta --smooth
  says 'closed smooth curve' 'row 3 is 8.3e-07 m from the next one'
  printf 'x,y,z\n0,0,0\n0.7,0.1,0.3\n0.701,0.103,0.298\n1.1,0.9,0.2\n' >c.csv
  bake c.csv -o a.fta --smooth
  case $err in *'leave one'*) fail "$err" ;; esac
}

AQueryOfACurveWithoutWorkIsStarvedAndNotRefused() {
  f make path --points 400 -o path.csv
  printf 'x,y,z\n0.3,0.1,0.2\n' >p.csv
  for option in '' --smooth; do
    # shellcheck disable=SC2086  # no word where there is no option
    bake path.csv -o a.fta $option
    f query a.fta path curve <p.csv
    truth=$(printf '%s\n' "$out" | sed 1d | cut -d, -f1)
    for units in 0 1 8; do
      f query a.fta path curve --work $units <p.csv
      exits 0
      printf '%s\n' "$out" | awk -F, -v truth="$truth" 'NR == 2 { exit !($7 <= truth && $1 >= truth && $9 == 0) }' ||
        fail "--work $units $option: $out"
    done
  done
}
