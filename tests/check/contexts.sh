# Every function of hal states in its header from which contexts it is called, and the call graph of the controller program
# on the Cortex-M7 agrees. Needs the preset mps2-an500 built. Read by tests/check/run.

graphs=$root/build/mps2-an500

not_run() {
  [ ! -d "$graphs/firmware/app" ] || return 1
  echo 'the preset mps2-an500 is not built'
}

check() {
  find "$graphs/firmware" "$graphs/hal" -name '*.ci' | awk '!/\/firmware\/app\// || /\/firmtouch_app\.dir\//' |
    LC_ALL=C sort | xargs awk -f "$here/contexts.awk" hal/firmtouch/hal/*.hpp
}

edits() {
  cat <<'END'
unstated_context @ hal/firmtouch/hal/board.hpp @ s/^\(.*Name of the board.*\) Context: any\./\1/ @ board.hpp: board_name\(\) states no context
servo_interrupt_left_out @ hal/firmtouch/hal/encoders.hpp @ s/Context: servo interrupt/Context: main loop/ @ encoders_read\(\) is called from the servo interrupt
fault_handler_left_out @ hal/firmtouch/hal/board.hpp @ s/main loop, fault handler; never/main loop; never/ @ board_print\(\) is called from the fault handler
main_loop_left_out @ hal/firmtouch/hal/link.hpp @ s/Context: main loop/Context: servo interrupt/ @ link_read\(\) is called from the main loop
END
}
