#pragma once
#include <stdint.h>

#include "firmtouch/controller.hpp"
#include "firmtouch/link/command_mailbox.hpp"
#include "firmtouch/record/ring.hpp"
#include "firmtouch/record/tick.hpp"

namespace firmtouch::app {

// 64 ticks: 64 ms at 1 kHz and 6.4 ms at 10 kHz, longer than any turn of the main loop (a slice of
// opening, a frame).
using Records = record::Ring<record::TickRecord, 64>;

// What the servo interrupt and the main loop share. Each is safe between the two by its own
// contract.
extern Controller controller;
extern link::CommandMailbox commands;  // main loop -> interrupt
extern Records records;                // interrupt -> main loop

// At two rates the interrupt renders the last local model, and the main loop below it makes the
// next one: for a servo that is faster than a query.
#ifdef FIRMTOUCH_APP_TWO_RATES
constexpr bool kTwoRates = true;
#else
constexpr bool kTwoRates = false;
#endif

/// One turn of the force loop: everything from the encoders to the motors. Called by the board's
/// timer.
void servo_interrupt();

}  // namespace firmtouch::app
