# Motors and encoders of the Teensy 4.1, with registers in memory.
firmtouch_test_module(hal_teensy41 LINKS firmtouch_core)
set(hal ${PROJECT_SOURCE_DIR}/hal)
target_sources(test_hal_teensy41 PRIVATE ${hal}/imxrt/motors.cpp ${hal}/imxrt/encoders.cpp ${hal}/silicon/wiring.cpp)
target_include_directories(test_hal_teensy41 PRIVATE ${CMAKE_CURRENT_LIST_DIR}/../hal/registers ${CMAKE_CURRENT_LIST_DIR}/../hal/motors ${hal})
target_compile_definitions(test_hal_teensy41 PRIVATE FIRMTOUCH_TEST_REGISTERS="teensy41/registers.hpp")
