# Cases of tests/cli/run about `firmtouch bench`.

# No message, lines of progress apart.
is_quiet() { same "$(printf '%s\n' "$err" | grep -v '^ *[0-9]* s  ')" ''; }

# Not a parser: brackets outside of strings match.
well_formed() {
  printf '%s' "$out" | sed 's/\\.//g; s/"[^"]*"//g' >bare
  ! grep -q '"' bare || fail "a string of the JSON does not end: $out"
  tr -cd '{[' <bare | wc -c >open
  tr -cd '}]' <bare | wc -c >close
  cmp -s open close || fail "brackets of the JSON do not match: $out"
  case $out in '{'*'}') ;; *) fail "not one object: $out" ;; esac
}

BenchListsTheBenches() {
  f bench
  exits 0
  printf '%s\n' "$out" | grep -qE '^  distance  +[a-z]' || fail "$out"
  f bench --json
  exits 0
  well_formed
  printf '%s\n' "$out" | grep -qF '"name": "distance"' || fail "$out"
}

BenchNeedsWhatItIsGiven() {
  f bench warmth; exits 2; says "'warmth' is no bench" distance; same "$out" ''
  f bench distance missing.obj; exits 3; says 'bench distance' missing.obj; same "$out" ''
  box | sed '$d' >open.obj
  f bench distance open.obj; exits 3; says open.obj 'open edge'
  f bench distance --peer; exits 2; says '--peer needs a value'
}

# By the program beside it; a copy of its own says how they are run.
BenchOfTheSimulatorIsRunByIt() {
  if [ -x "${firmtouch%/*}/firmtouch-sim" ]; then
    f bench friction
    exits 0
    printf '%s\n' "$out" | grep -qE 'stick-slip at 1 mm/s: period, error .* met' || fail "$out"
    f bench friction --moving; exits 2; says 'firmtouch-sim' '--moving is for feel'; same "$out" ''
  fi
  cp "$firmtouch" alone
  beside=$firmtouch firmtouch=./alone
  f bench passivity; exits 2; says "is run as \`firmtouch-sim bench passivity\`"
  firmtouch=$beside
}

BenchRacesAPeerOrSaysThatItIsAbsent() {
  box >box.obj
  f bench distance box.obj
  exits 0
  is_quiet
  printf '%s\n' "$out" | grep -qE 'touching path.*against the peer.*peer absent' || fail "$out"
  f bench distance box.obj --json
  exits 0
  well_formed
  printf '%s\n' "$out" | grep -qF '"value": null, "unit": "", "remark": "peer absent"' || fail "$out"
  # A peer that says it takes an hour a query loses, one that takes next to nothing wins.
  f bench distance box.obj --peer 'echo us_per_query 3600000000;:'
  exits 0
  printf '%s\n' "$out" | grep -qE 'against the peer .*goal <= 0.4000  met' || fail "$out"
  f bench distance box.obj --bar --peer 'echo us_per_query 0.000001;:'
  exits 1
  says 'not met'
  printf '%s\n' "$out" | grep -qE 'against the peer .*goal <= 0.4000  NOT MET' || fail "$out"
  # The peer of a warm race is warm; its cold figure stands beside it.
  f bench distance box.obj --peer 'w() { case $4 in --warm) echo us_per_query 3600 ;; *) echo us_per_query 7200 ;; esac; }; w'
  exits 0
  printf '%s\n' "$out" | grep -qE 'touching path, warm, the peer .* 3,?600( |\.)' || fail "$out"
  printf '%s\n' "$out" | grep -qE 'touching path, warm, the peer, cold .* 7,?200( |\.)' || fail "$out"
  printf '%s\n' "$out" | grep -qE 'random points, cold, exact, the peer .* 7,?200( |\.)' || fail "$out"
  f bench distance box.obj --json --peer 'echo us_per_query 0.000001;:'
  exits 0
  well_formed
  printf '%s\n' "$out" | grep -qF '"goal": 0.4, "goal_is": "at most", "ok": false' || fail "$out"
}

BenchNamesAPeerThatFails() {
  box >box.obj
  mkdir temporary
  TMPDIR=$PWD/temporary
  export TMPDIR
  f bench distance box.obj --peer 'exit 9;'
  exits 3
  says 'exit code 9' 'closest' 'box.obj' '--peer'
  f bench distance box.obj --peer 'echo nothing'
  exits 3
  says 'us_per_query'
  same "$(ls temporary)" ''
  unset TMPDIR
}

BenchNamesTheLabForItsTrials() {
  f bench orders part.obj; exits 2; says "'orders' is now run as \`firmtouch-lab orders\`" FIRMTOUCH_LAB
  same "$out" ''
}

BenchTouchRunsAsManyTicksAsItIsGiven() {
  f bench touch --ticks 0; exits 2; says --ticks
  f bench touch --ticks many; exits 2; says --ticks
  f bench touch --seed -1; exits 2; says --seed
  box >box.obj
  f bench touch box.obj --ticks 700 --seed 4
  exits 0
  printf '%s\n' "$out" | grep -qE 'moves that cross .* in 700 ticks' || fail "$out"
  first=$out
  f bench touch box.obj --ticks 700 --seed 5
  [ "$out" != "$first" ] || fail "--seed changes nothing: $out"
  f bench touch "$here/../spline/cad/torus.igs" --ticks 2000
  exits 0
  printf '%s\n' "$out" | grep -qE 'solution +torus .*goal >= 95' || fail "$out"
}

BenchTouchReleaseRunsOnlyHandsThatLeave() {
  box >box.obj
  f bench touch box.obj --release
  exits 0
  is_quiet
  printf '%s\n' "$out" | grep -qE 'leaving hand is let go, or a fault .* of 1500 contacts longer' || fail "$out"
  printf '%s\n' "$out" | grep -qE 'leaving hand is let go, hull of .* of 1500 contacts longer' || fail "$out"
  # Hands that the surface keeps from nothing would not leave it, but enter the part.
  ! printf '%s\n' "$out" | grep -q 'NOT MET' || fail "$out"
  ! printf '%s\n' "$out" | grep -q 'moves that cross' || fail "$out"
}
