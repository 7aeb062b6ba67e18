firmtouch_test_module(hal LINKS firmtouch_core)
# Motors, encoders and watchdog of the STM32 boards, with registers in memory (registers/cortex-m) of one of them.
set(stm32 ${PROJECT_SOURCE_DIR}/hal/stm32)
target_sources(test_hal PRIVATE ${stm32}/motors.cpp ${stm32}/encoders.cpp ${stm32}/watchdog.cpp ${stm32}/../silicon/wiring.cpp
               ${stm32}/../crash_record/crash_record.cpp ${stm32}/../parts/fault_text.cpp)
target_include_directories(test_hal PRIVATE ${CMAKE_CURRENT_LIST_DIR}/registers ${CMAKE_CURRENT_LIST_DIR}/motors
                                            ${PROJECT_SOURCE_DIR}/hal)
target_compile_definitions(test_hal PRIVATE FIRMTOUCH_TEST_REGISTERS="nucleo-g474re/registers.hpp")
set_target_properties(firmtouch_no_joints PROPERTIES EXCLUDE_FROM_ALL OFF)
add_test(NAME hal.forgotten_joint_does_not_link
         COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_joints ${CMAKE_CXX_COMPILER} $<TARGET_FILE:firmtouch_no_joints> "${CMAKE_CXX_FLAGS}")
