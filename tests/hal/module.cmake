firmtouch_test_module(hal LINKS firmtouch_core)
set_target_properties(firmtouch_no_joints PROPERTIES EXCLUDE_FROM_ALL OFF)
add_test(NAME hal.forgotten_joint_does_not_link
         COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_joints ${CMAKE_CXX_COMPILER} $<TARGET_FILE:firmtouch_no_joints> "${CMAKE_CXX_FLAGS}")
