if(TARGET firmtouch_tools_field)
  firmtouch_test_module(field LINKS firmtouch_tools_field firmtouch_tools_bake firmtouch_field)
endif()
