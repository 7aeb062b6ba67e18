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

edits() {
  bugs_of tests/core/handoff.pml
  cat <<'END'
order_in_the_code @ firmware/firmtouch/core/handoff.hpp @ s/__atomic_store_n(&state_, kMade, __ATOMIC_RELEASE)/__atomic_store_n(\&state_, kMade, __ATOMIC_RELAXED)/ @ no longer those of firmware/firmtouch/core/handoff.hpp
END
}
