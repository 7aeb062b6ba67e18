# The double buffer between geometry and servo, model-checked: tests/core/handoff.pml over every order of its steps, on a
# machine with store buffers and early loads; and that the model's steps are those of the source. Read by tests/check/run.
# shellcheck source=/dev/null
. "$here/spin_model.sh"

# All atomic steps of the class: the load of the state that all of them make, then the stores of request(), take() and made().
code() {
  for step in load store; do
    grep -o "__atomic_${step}_n([^;]*__ATOMIC_[A-Z]*)" firmware/firmtouch/core/handoff.hpp
  done
}
check() { check_model tests/core/handoff.pml firmware/firmtouch/core/handoff.hpp 400000; }

bug() { plant_in_model tests/core/handoff.pml "$1"; }
plant_requested_not_release() { bug BUG_REQUESTED_NOT_RELEASE; }
plant_made_not_release() { bug BUG_MADE_NOT_RELEASE; }
plant_fast_not_acquire() { bug BUG_FAST_NOT_ACQUIRE; }
plant_slow_not_acquire() { bug BUG_SLOW_NOT_ACQUIRE; }
plant_no_swap() { bug BUG_NO_SWAP; }
plant_draft_in_use() { bug BUG_DRAFT_IN_USE; }
plant_made_too_early() { bug BUG_MADE_TOO_EARLY; }
plant_requests_untaken() { bug BUG_REQUESTS_UNTAKEN; }
plant_requests_unanswered() { bug BUG_REQUESTS_UNANSWERED; }
plant_order_in_the_code() {
  edit firmware/firmtouch/core/handoff.hpp \
    's/__atomic_store_n(&state_, kMade, __ATOMIC_RELEASE)/__atomic_store_n(\&state_, kMade, __ATOMIC_RELAXED)/'
  expect='no longer those of firmware/firmtouch/core/handoff.hpp'
}
