if(TARGET firmtouch_tools_lab)
  firmtouch_test_module(lab LINKS firmtouch_tools_lab firmtouch_tools_field)
endif()
