# Which way includes run. The arrows are the LINKS lists of firmware/CMakeLists.txt; scene takes one header of servo on
# top, the input type that it fills. Read by tests/check/run.

together=1
check() {
  find firmware hal host_sim tools tests -type f \( -name '*.hpp' -o -name '*.cpp' -o -name '*.h' \) |
    LC_ALL=C sort | awk -v arrows="$(module_arrows)" -f "$here/includes.awk"
}
plants() {
  cat <<'END'
upward_include @ firmware/firmtouch/core/status.hpp @ #include "firmtouch/mesh/view.hpp" @ ^firmware/firmtouch/core/status.hpp:[0-9]+: core may not include mesh
sideways_include @ firmware/firmtouch/curve/planted.cpp @ #include "firmtouch/mesh/view.hpp" @ planted.cpp:[0-9]+: curve may not include mesh
servo_in_scene @ firmware/firmtouch/scene/planted.cpp @ #include "firmtouch/servo/step.hpp" @ planted.cpp:[0-9]+: scene may not include servo
hal_in_firmware @ firmware/firmtouch/query/certificate.hpp @   #  include "firmtouch/hal/clock.hpp" @ certificate.hpp:[0-9]+: query may not include hal
controller_in_a_room @ firmware/firmtouch/servo/planted.cpp @ #include "firmtouch/controller/controller.hpp" @ planted.cpp:[0-9]+: servo may not include controller
tools_in_firmware @ firmware/firmtouch/mesh/planted.cpp @ #include "bake/asset/section.hpp" @ planted.cpp:[0-9]+: firmware may not include "bake/asset/section.hpp"
tests_in_firmware @ firmware/firmtouch/mesh/planted.cpp @ #include "../../../tests/harness/test.hpp" @ planted.cpp:[0-9]+: firmware may not include "../../../tests/harness/test.hpp"
geometry_in_hal @ hal/firmtouch/hal/clock.hpp @ #include "firmtouch/math/vec3.hpp" @ clock.hpp:[0-9]+: hal may not include math
host_sim_in_hal @ hal/firmtouch/hal/clock.hpp @ #include "host_sim/plant/device.hpp" @ clock.hpp:[0-9]+: hal may not include "host_sim/plant/device.hpp"
hosted_header @ firmware/firmtouch/math/planted.cpp @ #include <cmath> @ planted.cpp:[0-9]+: <cmath> is not freestanding
intrinsics_elsewhere @ firmware/firmtouch/mesh/planted.cpp @ #include <arm_acle.h> @ planted.cpp:[0-9]+: <arm_acle.h> is not freestanding
hosted_header_in_hal @ hal/libc/planted.cpp @ #include <string.h> @ planted.cpp:[0-9]+: <string.h> is not freestanding
eigen_in_tools @ tools/surface/planted.cpp @ #include <Eigen/Dense> @ planted.cpp:[0-9]+: Eigen is for tests/\*_host_test.cpp
tests_in_tools @ tools/bake/planted.cpp @ #include "harness/test.hpp" @ planted.cpp:[0-9]+: tools may not include "harness/test.hpp"
hosted_header_in_a_test @ tests/core/core_test.cpp @ #include <cstring> @ core_test.cpp:[0-9]+: <cstring> is not freestanding, and this runs on the controller
END
}

# module_arrows: `module:link link ...;` for every firmtouch_module(module LINKS link ...)
module_arrows() {
  sed 's/#.*//' firmware/CMakeLists.txt | tr '\n' ' ' | grep -o 'firmtouch_module([^)]*)' | sed 's, HOT [^)]*),),; s, FOLDER [a-z/_]*,,' |
    sed 's/firmtouch_module( *\([a-z_]*\) *\(LINKS\)\{0,1\} *\(.*\))/\1:\3;/' | tr -d '\n'
}

add() {  # add FILE LINE
  printf '%s\n' "$2" >>"$1"
}
plant_hosted_header_behind_a_test() {
  add tests/core/planted.hpp '#include <string.h>'
  add tests/core/core_test.cpp '#include "core/planted.hpp"'
  expect='core/planted.hpp:1: <string.h> is not freestanding'
}
plant_circle_of_rooms() {
  edit firmware/CMakeLists.txt 's/firmtouch_module(record LINKS core)/firmtouch_module(record LINKS core link)/'
  expect='firmware/CMakeLists.txt: record links itself'
}
