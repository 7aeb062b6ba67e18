if(TARGET firmtouch_tools_surface)
  firmtouch_test_module(surface LINKS firmtouch_tools_surface)
endif()
