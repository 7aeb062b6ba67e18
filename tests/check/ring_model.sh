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

bug() { plant_in_model tests/record/ring.pml "$1"; }
plant_kept_not_release() { bug BUG_KEPT_NOT_RELEASE; }
plant_kept_not_acquire() { bug BUG_KEPT_NOT_ACQUIRE; }
plant_taken_not_release() { bug BUG_TAKEN_NOT_RELEASE; }
plant_taken_not_acquire() { bug BUG_TAKEN_NOT_ACQUIRE; }
plant_off_by_one() { bug BUG_OFF_BY_ONE; }
plant_uncounted() { bug BUG_UNCOUNTED; }
plant_number() { bug BUG_NUMBER; }
plant_release_more() { bug BUG_RELEASE_MORE; }
plant_order_in_the_code() {
  edit firmware/firmtouch/record/ring.hpp \
    's/__atomic_store_n(&kept_, kept + 1, __ATOMIC_RELEASE)/__atomic_store_n(\&kept_, kept + 1, __ATOMIC_RELAXED)/'
  expect='no longer those of firmware/firmtouch/record/ring.hpp'
}
