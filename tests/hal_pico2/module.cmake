# Motors and encoders of the Pico 2, with registers in memory.
firmtouch_test_module(hal_pico2 LINKS firmtouch_core)
set(hal ${PROJECT_SOURCE_DIR}/hal)
target_sources(test_hal_pico2 PRIVATE ${hal}/rp2350/motors.cpp ${hal}/rp2350/encoders.cpp ${hal}/silicon/wiring.cpp)
target_include_directories(test_hal_pico2 PRIVATE ${CMAKE_CURRENT_LIST_DIR}/../hal/registers ${CMAKE_CURRENT_LIST_DIR}/../hal/motors ${hal})
target_compile_definitions(test_hal_pico2 PRIVATE FIRMTOUCH_TEST_REGISTERS="pico2/registers.hpp")
