if(TARGET firmtouch_tools_spline)
  firmtouch_test_room(spline LINKS firmtouch_tools_spline firmtouch_tools_surface)
endif()
