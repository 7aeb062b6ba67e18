#pragma once
#include "bench/touch_subject.hpp"

namespace firmtouch::bench {

/// What rides through a subject have counted.
struct TouchSums {
  uint64_t ticks = 0, moves = 0, crossings = 0, places = 0, too_near = 0, longer = 0;
  double longer_m = 0;  // without friction, the worst
  // At 1 m/s, with the default budget and radii from 0.5 mm on:
  uint64_t usual = 0, queries = 0, most_queries = 0, optimal = 0, starved = 0;
  // Of these, those that nothing held back, and the others that had solved it.
  uint64_t free = 0, held_optimal = 0;
};

/// One ride: a hand leads a tool of random radius and friction from place to place in 1.2 boxes.
/// Even seeds give usual rides, odd ones any speed to 10 m/s and any budget.
void ride(TouchSubject& subject, uint64_t seed, uint64_t ticks, TouchSums& sums);

/// A contact whose hand leaves while a tick has 20 work units.
struct Leaving {
  bool is_contact = false;  // the tool was pressed on the surface
  bool is_fault = false;    // ten ticks in a row were uncertain
  uint32_t ticks = 0;       // until it was let go or the fault
};
Leaving leave(TouchSubject& subject, uint64_t seed);

}  // namespace firmtouch::bench
