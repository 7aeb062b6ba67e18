# The record ring, model-checked: tests/record/ring.pml over every order of its steps, on a machine with store buffers and
# early loads; and that the model's steps are those of the source. Read by tests/check/run.
# shellcheck source=/dev/null
. "$here/spin_model.sh"

# The atomic steps of push(), ready() and release(), in their order.
code() {
  awk '/^  bool push\(/ || /ready\(\) const/ || /void release\(/ { on = 1 } on { print } /^  }/ { on = 0 }' \
    firmware/firmtouch/record/ring.hpp | grep -o '__atomic_[a-z]*_n([^;]*__ATOMIC_[A-Z]*)'
}
check() { check_model tests/record/ring.pml firmware/firmtouch/record/ring.hpp 100000; }

edits() {
  bugs_of tests/record/ring.pml
  cat <<'END'
order_in_the_code @ firmware/firmtouch/record/ring.hpp @ s/__atomic_store_n(&kept_, kept + 1, __ATOMIC_RELEASE)/__atomic_store_n(\&kept_, kept + 1, __ATOMIC_RELAXED)/ @ no longer those of firmware/firmtouch/record/ring.hpp
END
}
