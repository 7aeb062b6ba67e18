if(TARGET firmtouch_tools_bake)
  firmtouch_test_module(scene LINKS firmtouch_tools_bake firmtouch_tools_surface firmtouch_tools_spline firmtouch_scene firmtouch_servo)
endif()
