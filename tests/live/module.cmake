# Drives a browser that shows tools/live.html: tests/live/run_live, once the boards are built (tools/test).
add_executable(live_page live/page_main.cpp live/browser.cpp)
target_include_directories(live_page PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
firmtouch_hosted(live_page)
set_target_properties(live_page PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
