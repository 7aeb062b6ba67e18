# What the checks ring_model and handoff_model share: a Spin model over every order of its steps, and that its steps are those
# of the source. Read by both.

copies="firmware/firmtouch/core firmware/firmtouch/record tests/core tests/record"
not_run() {
  command -v spin >/dev/null || { echo 'spin is missing (package spin of Debian and Ubuntu)'; return 0; }
  return 1
}

# check_model MODEL SOURCE STATES: `code` prints the atomic steps of the source, in the order of the model's; a model of
# fewer states than STATES has lost some of them.
check_model() {
  model=$1 source=$2 least=$3
  folder=$(mktemp -d) || return 1
  code >"$folder/code"
  sed -n 's|^ */\* code: \(.*\) \*/$|\1|p' "$model" >"$folder/model"
  if ! diff "$folder/code" "$folder/model" >"$folder/diff"; then
    echo "$model: its steps are no longer those of $source (< code, > model): model the change"
    cat "$folder/diff"
    rm -rf "$folder"
    return 1
  fi
  model=$(pwd)/$model
  (cd "$folder" && spin -a "$model" && ${CC:-cc} -w -O0 -DSAFETY -DMEMLIM=1500 -o pan pan.c && ./pan -m200000) >"$folder/said" 2>&1
  states=$(sed -n 's/^ *\([0-9.e+]*\) states, stored.*/\1/p' "$folder/said")
  if grep -q 'errors: 0' "$folder/said" && ! grep -q 'search depth too small\|max search depth' "$folder/said" &&
    awk -v n="${states:-0}" -v least="$least" 'BEGIN { exit !(n > least) }'; then
    echo "$states states"
    rm -rf "$folder"
    return 0
  fi
  grep -v '^$' "$folder/said" | head -n 12
  rm -rf "$folder"
  return 1
}

# bugs_of MODEL: prints an edit for each `BUG_` of the model, which switches it on
bugs_of() {
  sed -n 's/^#ifn*def BUG_\([A-Z_]*\)$/\1/p' "$1" | while read -r bug; do
    echo "$(echo "$bug" | tr '[:upper:]' '[:lower:]') @ $1 @ s/^#ifdef BUG_$bug\$/#if 1/;s/^#ifndef BUG_$bug\$/#if 0/ @ assertion violated"
  done
}
