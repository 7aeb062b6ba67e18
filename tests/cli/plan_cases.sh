# Cases of tests/cli/run about `firmtouch plan`.

plan_fact() { printf '%s\n' "$out" | grep -oE "\"$1\": [0-9.]+" | sed -n "${2:-1}p" | sed 's/.*: //'; }
# The row of image_budgets.txt that has the parts, and what its flash and its RAM with stack and record ring are.
budget() {  # budget BOARD PARTS
  awk -v board="$1" -v parts="$2" '$1 == board && $2 == parts { print $4, $5 + $6 + 10112 }' \
    "$here/../../tools/check/image_budgets.txt"
}

APlanThatFitsBakesToItsSize() {
  f make part --triangles 2000 -o 'my part.obj'; exits 0
  f make path -o path.csv; exits 0
  f plan 'my part.obj' path.csv --unit mm --flash 2M --ram 64K --core m4f --json; exits 0
  well_formed
  chosen=$(($(plan_fact chosen) + 1))
  asset=$(plan_fact asset $chosen) flash=$(plan_fact flash $chosen) ram=$(plan_fact ram $chosen)
  same "$flash $ram" "$(budget netduinoplus2 'mesh;field;hull;guide' | awk -v asset="$asset" '{ print $1 + asset, $2 }')"
  # What field and hull add to the fast tree, except padding and the options in the provenance.
  added=$((asset - $(plan_fact asset) - $(plan_fact field $chosen) - $(plan_fact hull $chosen)))
  [ "$(plan_fact hull $chosen)" -gt 9000 ] && [ $added -ge 0 ] && [ $added -lt 600 ] || fail "$added bytes are of nothing"
  command=$(printf '%s\n' "$out" | sed -n 's/.*"bake: firmtouch \(.*\) -o SCENE.fta".*/\1/p')
  eval "f $command -o scene.fta"; exits 0
  same "$(wc -c <scene.fta)" "$asset"
  # Exactly so much is enough, and a byte less is not.
  f plan 'my part.obj' path.csv --unit mm --flash "$flash" --ram "$ram" --core m4f --json; same "$(plan_fact flash $chosen)" "$flash"
  same "$(($(plan_fact chosen) + 1))" $chosen
  f plan 'my part.obj' path.csv --unit mm --flash $((flash - 1)) --ram "$ram" --core m4f --json; exits 0
  [ "$(($(plan_fact chosen) + 1))" != $chosen ] || fail 'a byte too many fits'
}

APlanThatDoesNotFitSaysWhatWould() {
  f make part --triangles 4000 -o part.obj; exits 0
  f plan part.obj --flash 160K --ram 16K --core m7; exits 1
  flash=$(printf '%s\n' "$out" | sed -n 's/^flash: --flash \([0-9]*\) would do, with --small$/\1/p')
  ram=$(printf '%s\n' "$out" | sed -n 's/^RAM: --ram \([0-9]*\) would do.*/\1/p')
  triangles=$(printf '%s\n' "$out" | sed -n 's/^or meshes of about \([0-9]*\) triangles (now [0-9]*).*/\1/p')
  f plan part.obj --flash "$flash" --ram "$ram" --core m7; exits 0
  f plan part.obj --flash $((flash - 1)) --ram "$ram" --core m7; exits 1
  f plan part.obj --flash "$flash" --ram $((ram - 1)) --core m7; exits 1
  # The mesh that it names: a tenth smaller, for bytes a triangle differ a little.
  f make part --triangles $((triangles * 9 / 10)) -o smaller.obj; exits 0
  f plan smaller.obj --flash 160K --ram "$ram" --core m7; exits 0
}

APlanTakesTheProgramsOfYourBuildAndRefusesOthers() {
  box >box.obj
  printf '[{"board": "mine", "parts": "mesh;trusted", "flash": 1, "ram": 1, "record_ring": 1, "stack": {"opening": 1, "lock_step": 1, "running": 1}},
  {"board": "mine", "parts": "mesh", "flash": 1000, "ram": 20, "record_ring": 7, "stack": {"opening": 3, "lock_step": 5, "running": 4}}]' >own.json
  f plan box.obj --flash 1M --ram 32 --resources own.json --json; exits 0
  same "$(plan_fact ram) $(($(plan_fact flash) - $(plan_fact asset)))" '32 1000'
  printf '%s\n' "$out" | grep -q '"refused": "no program of these has its parts: mesh;field"' || fail "$out"
  f plan box.obj --flash 1M --ram 31 --resources own.json; exits 1
  printf '%s\n' "$out" | grep -q '^RAM: --ram 32 would do' || fail "$out"
  sed 's/"ram": 20, //' own.json >less.json
  f plan box.obj --flash 1M --ram 32 --resources less.json; exits 3; says "less.json: program 1 has no 'ram'"
  echo '[]' >none.json
  f plan box.obj --flash 1M --ram 32 --resources none.json; exits 3; says 'names no program'
  head -c 90 own.json >cut.json
  f plan box.obj --flash 1M --ram 32 --resources cut.json; exits 3; says 'cut.json: byte 90' 'the JSON is damaged'
  f plan box.obj --flash 1M --ram 32 --resources own.json --core m7; exits 2; says 'leave out --core'
}

APlanTakesAProgramThatHasEachPartOfTheAsset() {
  box_obj usemtl >box.obj; feel >feel.txt
  image() { printf '{"board": "mine", "parts": "%s", "flash": %d, "ram": 20, "record_ring": 7, "stack": {"opening": 3, "lock_step": 5, "running": 4}}' "$1" "$2"; }
  # `all` is not every part: materials, objects, tools and homing are named.
  printf '[%s, %s, %s]' "$(image all 900)" "$(image 'all;materials' 1000)" "$(image 'all;homing' 1100)" >own.json
  f plan box.obj --materials feel.txt --flash 1M --ram 32 --resources own.json; exits 0
  printf '%s\n' "$out" | grep -q '^program: the parts all;materials, at most 1000 bytes' || fail "$out"
  f plan box.obj --flash 1M --ram 32 --resources own.json; exits 0
  printf '%s\n' "$out" | grep -q '^program: the parts all, at most 900 bytes' || fail "$out"
  f plan box.obj --device haply_pantograph --flash 1M --ram 32 --resources own.json; exits 0
  printf '%s\n' "$out" | grep -q '^program: the parts all, at most 900 bytes' || fail "$out"
  # What homes a linkage moves one; `all` with a tool has objects.
  printf '[%s, %s]' "$(image 'mesh;homing' 900)" "$(image 'all;tool' 1000)" >own.json
  f plan box.obj --device haply_pantograph --flash 1M --ram 32 --resources own.json; exits 0
  printf '%s\n' "$out" | grep -qE -- '--fast +mesh;homing ' || fail "$out"
  echo 'object lid of box' >scene.objects
  f plan box.obj scene.objects --flash 1M --ram 32 --resources own.json; exits 0
  printf '%s\n' "$out" | grep -q '^program: the parts all;tool, at most 1000 bytes' || fail "$out"
  f plan box.obj --materials feel.txt --flash 1M --ram 32 --resources own.json; exits 1
  printf '%s\n' "$out" | grep -qF 'build one with -DFIRMTOUCH_APP="mesh;materials"' || fail "$out"
}

APlanChoosesThePoolOfATickByWhatTheCoreDoes() {
  f make path -o path.csv; exits 0
  f plan path.csv --flash 1M --ram 64K --rate 1k --mips 460; exits 0
  printf '%s\n' "$out" | grep -q '^tick_work 1000: 465 units for queries; 230 of 460 million' || fail "$out"
  f plan path.csv --flash 1M --ram 64K --rate 3k --mips 460; exits 0
  printf '%s\n' "$out" | grep -q '^tick_work 666: 131 units' || fail "$out"
  f plan path.csv --flash 1M --ram 64K --rate 4k --mips 123.3; exits 0
  printf '%s\n' "$out" | grep -q 'geometry at most at 1000 Hz then' || fail "$out"
  # The page of the budget derives the same bound of a tick.
  grep -q '230,000 with the default of 1,000' "$here/../../firmware/firmtouch/query/README.md" || fail 'another bound'
  f plan path.csv --flash 1M --ram 64K; exits 0
  printf '%s\n' "$out" | grep -q '^tick_work 1000 takes at most 230000 instructions a tick' || fail "$out"
}

APlanForAToolHasWorkForEachSphere() {
  box_obj usemtl >box.obj
  printf 'sphere -1 0 0 mm radius 1 mm\nsphere 1 0 0 mm radius 1 mm\nsphere 2 0 0 mm radius 1 mm\n' >bar.tool
  f plan box.obj bar.tool --flash 1M --ram 64K --rate 1k --mips 460; exits 0
  printf '%s\n' "$out" | grep -q '^tick_work 1470: 465 units for queries; 338.1 of 460 million' || fail "$out"
  printf '%s\n' "$out" | grep -q '^mesh_work 1110: of 3 spheres each' || fail "$out"
  f plan box.obj bar.tool --flash 1M --ram 64K --rate 1k; exits 0
  printf '%s\n' "$out" | grep -q '^the least pool, 1006, ' || fail "$out"
}

APlanSaysWhetherYourProgramHasTwoRates() {
  f make path -o path.csv; exits 0
  image() { printf '[{"board": "mine", "parts": "all", %s"flash": 900, "ram": 20, "record_ring": 7, "stack": {"opening": 3, "lock_step": 5, "running": 4}}]' "$1"; }
  for rates in '' '"two_rates": false, '; do
    image "$rates" >own.json
    f plan path.csv --flash 1M --ram 64K --rate 4k --mips 123.3 --resources own.json; exits 0
    printf '%s\n' "$out" | grep -q ': build with -DFIRMTOUCH_APP_TWO_RATES=ON$' || fail "$out"
    printf '%s\n' "$out" | grep -q '^program: the parts all, at most 900 bytes' || fail "$out"
  done
  image '"two_rates": true, ' >own.json
  f plan path.csv --flash 1M --ram 64K --rate 4k --mips 123.3 --resources own.json; exits 0
  printf '%s\n' "$out" | grep -q ': the program has two rates$' || fail "$out"
  printf '%s\n' "$out" | grep -q '^program: the parts all at two rates, at most 900 bytes' || fail "$out"
  f plan path.csv --flash 1M --ram 64K --resources own.json --json; exits 0; well_formed
  printf '%s\n' "$out" | grep -q '"two_rates": true' || fail "$out"
}

WhatIsNoPlanIsRefused() {
  box >box.obj
  f plan box.obj --ram 64K; exits 2; says '--flash'
  f plan box.obj --flash 64Q --ram 64K; exits 2; says '--flash 64Q'
  f plan box.obj --flash nan --ram 64K; exits 2; says '--flash nan'
  f plan box.obj --flash 1M --ram 64K --rate 50k; exits 2; says '--rate'
  f plan box.obj --flash 1M --ram 64K --rate 0; exits 2; says '--rate 0: a number such as 1k or 4k'
  f plan box.obj --flash 1M --ram 64K --unit kg; exits 2; says 'plan: --unit kg' 'firmtouch plan --help'
  f plan box.obj --flash 1M --ram 64K --picture none/p.svg; exits 3; says 'none/p.svg' 'there is no folder none'
  f plan box.obj --flash 1M --ram 64K --core m0; exits 2; says '--core m0'
  f plan box.obj --flash 1M --ram 64K --picture box.obj; exits 2; says 'box.obj'
  f plan missing.obj --flash 1M --ram 64K --picture p.svg; exits 3; says missing.obj; absent p.svg
  f plan box.obj --flash 1M --ram 64K --picture p.svg; exits 0
  same "$(grep -c '<rect' p.svg) $(grep -c '</svg>' p.svg)" "$((5 + 4 * $(printf '%s\n' "$out" | grep -c ' yes ' )  )) 1"
}
