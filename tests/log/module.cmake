if(TARGET firmtouch_tools_log)
  find_package(Threads REQUIRED)
  firmtouch_test_module(log LINKS firmtouch_tools_log firmtouch_record Threads::Threads)
  target_sources(test_log PRIVATE log/folder.cpp)
  target_include_directories(test_log PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_definitions(test_log PRIVATE FIRMTOUCH_ROOT="${PROJECT_SOURCE_DIR}")
  # A hundred million tries (--long).
  set_tests_properties(log.ADamagedLogGivesNoBlockThatWasNotWritten PROPERTIES TIMEOUT 7200)
  # Ten minutes of real time (--long).
  set_tests_properties(log.Stall_DefaultRingLosesNothing_At10kHz
    PROPERTIES TIMEOUT 1800)
  if(TARGET firmtouch-sim AND TARGET firmtouch-app-posix)
    add_test(NAME log.commands COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_commands $<TARGET_FILE_DIR:firmtouch-sim>)
  endif()
endif()
