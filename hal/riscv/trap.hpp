#pragma once

/// Defined by the board: the machine timer's interrupt.
extern "C" void machine_timer_handler();
