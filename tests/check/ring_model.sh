# The record ring, model-checked: tests/record/ring.pml over every order of its steps, on a machine with store buffers and
# early loads; and that the model's steps are those of the source. Read by tests/check/run.

not_run() {
  command -v spin >/dev/null || { echo 'spin is missing (package spin of Debian and Ubuntu)'; return 0; }
  return 1
}

# The atomic steps of push(), ready() and release(), in their order.
steps_of_the_code() {
  awk '/^  bool push\(/ || /ready\(\) const/ || /void release\(/ { on = 1 } on { print } /^  }/ { on = 0 }' \
    firmware/firmtouch/record/ring.hpp | grep -o '__atomic_[a-z]*_n([^;]*__ATOMIC_[A-Z]*)'
}
steps_of_the_model() { sed -n 's|^ */\* code: \(.*\) \*/$|\1|p' tests/record/ring.pml; }

check() {
  folder=$(mktemp -d) || return 1
  steps_of_the_code >"$folder/code"
  steps_of_the_model >"$folder/model"
  if ! diff "$folder/code" "$folder/model" >"$folder/diff"; then
    echo 'tests/record/ring.pml: its steps are no longer those of record/ring.hpp (< code, > model): model the change'
    cat "$folder/diff"
    rm -rf "$folder"
    return 1
  fi
  model=$(pwd)/tests/record/ring.pml
  (cd "$folder" && spin -a "$model" && ${CC:-cc} -w -O1 -DSAFETY -DMEMLIM=1500 -o pan pan.c && ./pan -m200000) >"$folder/said" 2>&1
  states=$(sed -n 's/^ *\([0-9.e+]*\) states, stored.*/\1/p' "$folder/said")
  if grep -q 'errors: 0' "$folder/said" && ! grep -q 'search depth too small\|max search depth' "$folder/said" &&
    awk -v n="${states:-0}" 'BEGIN { exit !(n > 100000) }'; then
    echo "$states states"
    rm -rf "$folder"
    return 0
  fi
  grep -v '^$' "$folder/said" | head -n 12
  rm -rf "$folder"
  return 1
}

bug() {  # bug NAME PATTERN: the model with this defect
  printf '#define %s\n' "$1" | cat - tests/record/ring.pml >ring.new && mv ring.new tests/record/ring.pml
  expect=$2
}
plant_kept_not_release() { bug BUG_KEPT_NOT_RELEASE 'assertion violated'; }
plant_kept_not_acquire() { bug BUG_KEPT_NOT_ACQUIRE 'assertion violated'; }
plant_taken_not_release() { bug BUG_TAKEN_NOT_RELEASE 'assertion violated'; }
plant_taken_not_acquire() { bug BUG_TAKEN_NOT_ACQUIRE 'assertion violated'; }
plant_off_by_one() { bug BUG_OFF_BY_ONE 'assertion violated'; }
plant_uncounted() { bug BUG_UNCOUNTED 'assertion violated'; }
plant_number() { bug BUG_NUMBER 'assertion violated'; }
plant_release_more() { bug BUG_RELEASE_MORE 'assertion violated'; }
plant_order_in_the_code() {
  sed 's/__atomic_store_n(&kept_, kept + 1, __ATOMIC_RELEASE)/__atomic_store_n(\&kept_, kept + 1, __ATOMIC_RELAXED)/' \
    firmware/firmtouch/record/ring.hpp >ring.new && mv ring.new firmware/firmtouch/record/ring.hpp
  expect='no longer those of record/ring.hpp'
}
