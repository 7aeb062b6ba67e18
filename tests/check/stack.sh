# Size and worst stack of every composition of the controller program on every board, and what must not be in its call
# graph (tools/check/image, which joins the compiler's call graphs). Needs the boards' presets built. Read by
# tests/check/run.

boards='mps2-an500 netduinoplus2'

check() {
  bad=0
  for board in ${only:-$boards}; do
    FIRMTOUCH_HOST_TOOLS=$work_tools sh "$root/tools/check/image" "$board" "$PWD/build/$board" || bad=1
  done
  return $bad
}
work_tools=$root/build/host/bin

# To plant in: the call graphs and the first program of each board; what is planted is found before the next is missed.
copy_tree() {
  for board in $boards; do
    (cd "$root" && find "build/$board/firmware" "build/$board/hal" -name '*.ci') >"$1/files"
    (cd "$root" && tar cf - -T "$1/files" build/$board/bin/firmtouch_app.elf) | (cd "$1" && tar xf -)
  done
}
# plant SOURCE: a call graph of this source beside those of the Cortex-M7's controller
plant() {
  only=mps2-an500
  printf '%s\n' "$1" >planted.cpp
  arm-none-eabi-g++ -mcpu=cortex-m7 -mthumb -std=c++17 -O1 -fno-exceptions -fcallgraph-info=su,da -c planted.cpp \
    -o build/mps2-an500/firmware/planted.o
  [ -e build/mps2-an500/firmware/planted.ci ]
}

plant_recursion() {
  plant 'int planted_fib(int n) { return n < 2 ? n : planted_fib(n - 1) * planted_fib(n - 2); }'
  expect='recursion.*planted_fib|planted_fib.*recurs|planted_fib.* -> .*planted_fib'
}
plant_recursion_through_another() {
  plant 'int planted_odd(int n);
[[gnu::noinline]] int planted_even(int n) { return n == 0 ? 3 : 7 * planted_odd(n - 1); }
[[gnu::noinline]] int planted_odd(int n) { return n == 0 ? 5 : 9 * planted_even(n - 1); }'
  expect='planted_(odd|even).* -> .*planted_(odd|even)|recursion.*planted_'
}
plant_frame_without_a_bound() {
  plant 'extern void take(char*);
void planted_frame(int n) { char* p = static_cast<char*>(__builtin_alloca(n)); take(p); }'
  expect='planted_frame'
}
plant_program_in_the_assets_slot() {
  only=mps2-an500
  arm-none-eabi-objcopy --strip-symbol __firmtouch_asset_slot --add-symbol __firmtouch_asset_slot=0x1000,global \
    build/mps2-an500/bin/firmtouch_app.elf
  expect='the program reaches into the asset'
}
plant_indirect_call() {
  plant 'int planted_pointer(int (*f)(int), int n) { return 3 * f(n); }'
  expect='planted_pointer'
}
plant_too_much_stack() {
  only=mps2-an500
  work_tools=$PWD
  printf '#!/bin/sh\nfor word; do shift; case $last in --limit) word=64 ;; esac; last=$word; set -- "$@" "$word"; done\nexec "%s/build/host/bin/firmtouch-stack" "$@"\n' "$root" >firmtouch-stack
  chmod +x firmtouch-stack
  expect='64|more than|limit'
}
plant_program_linked_with_flto() {
  only=mps2-an500
  : >build/mps2-an500/bin/firmtouch_app.elf.ltrans0.ltrans.ci
  expect='is linked with -flto'
}
plant_program_over_its_budget() {
  only=mps2-an500
  cp "$root/build/mps2-an500/bin/firmtouch_app_all_tool.elf" build/mps2-an500/bin/firmtouch_app.elf
  expect='over the budget of'
}
