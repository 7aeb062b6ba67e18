if(TARGET firmtouch_tools_field)
  firmtouch_test_module(field LINKS firmtouch_tools_field firmtouch_tools_bake firmtouch_field)
  # Its tests of vector instructions, without the baker: what tools/test builds for this processor each day.
  add_executable(test_field_lanes EXCLUDE_FROM_ALL field/distance_field_host_test.cpp field/voxel_grid_host_test.cpp
                                                   harness/host_main.cpp)
  target_link_libraries(test_field_lanes PRIVATE firmtouch_harness firmtouch_tools_field)
  firmtouch_hosted(test_field_lanes -O1)
endif()
