# The controller program as a process, against a controller in this one.
if(TARGET firmtouch AND TARGET firmtouch-app-posix)
  firmtouch_bake(TARGET app_test_asset INPUTS app/cube.obj app/guide.csv OUTPUT app_test.fta)
  firmtouch_bake(TARGET app_test_other INPUTS examples/block.obj OUTPUT app_test_other.fta OPTIONS --unit mm)
  firmtouch_test_module(app LINKS firmtouch_controller firmtouch_link firmtouch_params firmtouch_hal)
  # The program's own servo interrupt, over joints of the test (logging_host_test.cpp).
  target_sources(test_app PRIVATE app/app_process.cpp app/moved_joints.cpp
                                  ${PROJECT_SOURCE_DIR}/firmware/app/servo_interrupt.cpp
                                  ${PROJECT_SOURCE_DIR}/firmware/app/servo.cpp
                                  ${PROJECT_SOURCE_DIR}/firmware/app/saved_parameters.cpp)
  target_link_libraries(test_app PRIVATE firmtouch_no_parameters)
  firmtouch_compose(test_app all asset_slots)
  target_include_directories(test_app PRIVATE ${PROJECT_SOURCE_DIR}/firmware/app)
  target_compile_definitions(
    test_app PRIVATE FIRMTOUCH_APP_PROGRAM="$<TARGET_FILE:firmtouch-app-posix>"
                     FIRMTOUCH_TEST_ASSET="$<TARGET_PROPERTY:app_test_asset,FIRMTOUCH_ASSET>"
                     FIRMTOUCH_TEST_OTHER="$<TARGET_PROPERTY:app_test_other,FIRMTOUCH_ASSET>")
  add_dependencies(test_app firmtouch-app-posix app_test_asset app_test_other)
endif()
