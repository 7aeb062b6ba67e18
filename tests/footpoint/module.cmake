if(TARGET firmtouch_tools_footpoint)
  firmtouch_test_module(footpoint LINKS firmtouch_tools_footpoint firmtouch_tools_bake firmtouch_tools_spline)
  target_compile_definitions(test_footpoint PRIVATE FIRMTOUCH_CAD_FILES="${CMAKE_CURRENT_SOURCE_DIR}/spline/cad")
endif()
