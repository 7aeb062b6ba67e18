# Somebody else's project on the library as it is. Needs the ARM compiler and QEMU: without them there is no such test.
find_program(FIRMTOUCH_ARM_COMPILER arm-none-eabi-g++)
find_program(FIRMTOUCH_QEMU qemu-system-arm)
if(FIRMTOUCH_ARM_COMPILER AND FIRMTOUCH_QEMU AND TARGET firmtouch)
  add_test(NAME consumer.BuildsAndFeelsItsOwnShapeAndEffect
           COMMAND ${CMAKE_COMMAND} -E env FIRMTOUCH_HOST_TOOLS=$<TARGET_FILE_DIR:firmtouch>
                   ${PROJECT_SOURCE_DIR}/tests/consumer/run ${CMAKE_BINARY_DIR}/consumer)
  set_tests_properties(consumer.BuildsAndFeelsItsOwnShapeAndEffect PROPERTIES TIMEOUT 600)
endif()
