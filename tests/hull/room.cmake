if(TARGET firmtouch_tools_hull)
  firmtouch_test_room(hull LINKS firmtouch_tools_hull firmtouch_tools_surface)
endif()
