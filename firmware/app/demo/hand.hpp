#pragma once

namespace firmtouch::demo {

/// Moves the simulated joints for one tick, before the encoders are read. Servo interrupt only.
void move_hand();

}  // namespace firmtouch::demo
