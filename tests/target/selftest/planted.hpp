#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/hal/asset_slots.hpp"
#include "firmtouch/hal/parameters.hpp"

// The functions of the HAL that the self-test calls, one of them broken as the number in the
// asset's slot says (planted.cpp). Qualified names find these before those of the board.
namespace firmtouch::planted {

using namespace hal;  // NOLINT: what is not declared below

void board_begin();
const char* board_name();
core::Bytes board_asset();
void board_print(const char* text);
[[noreturn]] void board_exit(int status);
bool board_may_exit();
uint32_t board_stack_high_bytes();
uint32_t clock_us();
uint32_t clock_work();
uint32_t clock_work_per_1000();
void clock_start_servo(uint32_t period_us, void (*tick)());
bool encoders_read(int32_t (&counts)[3]);
uint32_t link_read(uint8_t* to, uint32_t capacity);
uint32_t link_write(const uint8_t* from, uint32_t count);
void link_wait();
void motors_state(bool may_push);
void motors_write_N(const float (&motor_N)[3]);
void motors_off();
uint32_t motors_lines();
ParameterFlash board_parameters();
bool board_erase_parameters(uint32_t sector);
bool board_program_parameters(uint32_t sector, uint32_t offset, core::Bytes bytes);
AssetSlots board_asset_slots();
bool board_erase_asset(uint32_t slot, uint32_t offset);
bool board_program_asset(uint32_t slot, uint32_t offset, core::Bytes bytes);
void watchdog_begin(uint32_t timeout_us);
void watchdog_feed();

}  // namespace firmtouch::planted
