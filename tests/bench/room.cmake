if(TARGET firmtouch_tools_bench)
  firmtouch_test_room(bench LINKS firmtouch_tools_bench)
endif()
