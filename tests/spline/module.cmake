if(TARGET firmtouch_tools_spline)
  firmtouch_test_module(spline LINKS firmtouch_tools_spline firmtouch_tools_surface firmtouch_tools_bake firmtouch_spline)
  target_compile_definitions(test_spline PRIVATE FIRMTOUCH_CAD_FILES="${CMAKE_CURRENT_SOURCE_DIR}/spline/cad")
endif()
