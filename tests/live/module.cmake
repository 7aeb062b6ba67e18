# Drive a browser that shows the live page (tests/live/run_live) and a report (tests/live/run_report).
foreach(page live report)
  add_executable(${page}_page live/${page}_main.cpp live/browser.cpp)
  target_include_directories(${page}_page PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  firmtouch_hosted(${page}_page)
  set_target_properties(${page}_page PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
endforeach()
