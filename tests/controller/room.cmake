if(TARGET firmtouch_tools_bake)
  firmtouch_test_room(controller LINKS firmtouch_tools_bake firmtouch_tools_surface firmtouch_controller)
endif()
