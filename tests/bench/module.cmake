if(TARGET firmtouch_tools_bench)
  firmtouch_test_module(bench LINKS firmtouch_tools_bench)
endif()
