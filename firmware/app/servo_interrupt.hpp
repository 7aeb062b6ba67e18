#pragma once
#include "composition.hpp"
#include "firmtouch/link/command_mailbox.hpp"
#include "firmtouch/record/tick_ring.hpp"
#include "saved_parameters.hpp"
#include "turn_watch.hpp"

namespace firmtouch::app {

using Records = record::TickRing;

// Shared by the servo interrupt and the main loop. Each is safe between the two by its own
// contract.
extern AppController controller;
extern link::CommandMailbox commands;  // main loop -> interrupt
extern Records records;                // interrupt -> main loop
extern TurnWatch main_loop;            // main loop -> interrupt: it goes on
extern SavedCommands saved_commands;   // main loop, until the servo runs; then interrupt

// At two rates the interrupt renders the last local model while the main loop makes the next one:
// for a servo that is faster than a query.
#ifdef FIRMTOUCH_APP_TWO_RATES
constexpr bool kTwoRates = true;
#else
constexpr bool kTwoRates = false;
#endif

// With simulated joints (demo/joints.hpp).
#ifdef FIRMTOUCH_APP_DEMO
constexpr bool kDemo = true;
#else
constexpr bool kDemo = false;
#endif

// With part `crash_record`: cause and last ticks outlive a reset (last_crash.hpp).
#ifdef FIRMTOUCH_APP_CRASH_RECORD
constexpr bool kKeepsCrash = true;
#else
constexpr bool kKeepsCrash = false;
#endif

// With part `asset_slots`: a host can load another asset (asset_update.hpp).
#ifdef FIRMTOUCH_APP_ASSET_SLOTS
constexpr bool kHasSlots = true;
#else
constexpr bool kHasSlots = false;
#endif

// With part `brake`: the board has a motors_brake().
#ifdef FIRMTOUCH_APP_BRAKE
constexpr bool kHasBrake = true;
#else
constexpr bool kHasBrake = false;
#endif

/// One tick: from the encoders to the motors. Called by the board's timer.
void servo_interrupt();

}  // namespace firmtouch::app
