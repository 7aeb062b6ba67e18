if(TARGET firmtouch_tools_surface)
  firmtouch_test_room(surface LINKS firmtouch_tools_surface)
endif()
