if(TARGET firmtouch_tools_bake)
  find_package(Threads REQUIRED)
  firmtouch_test_module(controller LINKS Threads::Threads firmtouch_tools_bake firmtouch_tools_surface firmtouch_controller)
endif()
