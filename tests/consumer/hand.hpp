#pragma once
#include <stdint.h>

// The scripted hand: its position at each tick, in encoder counts of 10 um. It moves down onto the
// torus, the gem and the wall in turn and rests on each.
void hand_counts(uint32_t tick, int32_t (&counts)[3]);

enum class Place { kFree, kOnTorus, kOnGem, kOnWall, kEnd };
/// What the hand rests on at this tick; kEnd after the last stop. `settled`: the force is constant.
Place hand_place(uint32_t tick, bool& settled);
