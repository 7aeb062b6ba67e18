firmtouch_test_module(asset LINKS firmtouch_tools_bake firmtouch_asset firmtouch_core)
target_compile_definitions(test_asset PRIVATE FIRMTOUCH_ROOT="${PROJECT_SOURCE_DIR}")
