if(TARGET firmtouch_tools_hull)
  firmtouch_test_module(hull LINKS firmtouch_tools_bake firmtouch_tools_hull firmtouch_tools_surface firmtouch_hull firmtouch_asset)
endif()
