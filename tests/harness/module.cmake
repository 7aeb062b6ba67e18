# The harness is tested from outside: a program of planted failures, and what must be said about them.
add_executable(harness_planted harness/planted.cpp harness/host_main.cpp)
target_link_libraries(harness_planted PRIVATE firmtouch_harness)
firmtouch_hosted(harness_planted)
add_executable(harness_empty harness/host_main.cpp)
target_link_libraries(harness_empty PRIVATE firmtouch_harness)
firmtouch_hosted(harness_empty)
add_test(NAME harness.FailuresAreReported
         COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/harness/self_test.sh
                 $<TARGET_FILE:harness_planted> $<TARGET_FILE:harness_empty>)
# A TEST that CTest does not know (indented, or spelled over two lines) would never run.
add_test(NAME harness.EveryTestIsRegistered
         COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/harness/registered.sh
                 ${CMAKE_CTEST_COMMAND} ${PROJECT_BINARY_DIR})
set_tests_properties(harness.FailuresAreReported harness.EveryTestIsRegistered
                     PROPERTIES TIMEOUT 120)
