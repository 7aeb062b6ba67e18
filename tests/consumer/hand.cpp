#include "hand.hpp"

namespace {

struct Stop {
  uint32_t tick;
  int32_t counts[3];
  Place until_next;  // between this stop and the next one; only where both are the same place
};

constexpr Stop kStops[] = {
    {0, {0, 0, 2500}, Place::kFree},       {200, {0, 0, 2500}, Place::kFree},
    {500, {-2000, 0, 2500}, Place::kFree}, {800, {-2000, 0, 600}, Place::kOnTorus},
    {1000, {-2000, 0, 600}, Place::kFree}, {1300, {-2000, 0, 2500}, Place::kFree},
    {1900, {4000, 0, 3000}, Place::kFree}, {2200, {4000, 0, 1500}, Place::kOnGem},
    {2400, {4000, 0, 1500}, Place::kFree}, {2700, {4000, 0, 3000}, Place::kFree},
    {3200, {500, 0, 3000}, Place::kFree},  {3800, {500, 0, -1800}, Place::kOnWall},
    {4000, {500, 0, -1800}, Place::kEnd},
};
constexpr uint32_t kStopCount = sizeof kStops / sizeof kStops[0];

uint32_t stop_before(uint32_t tick) {
  uint32_t i = 0;
  while (i + 2 < kStopCount && kStops[i + 1].tick <= tick) ++i;
  return i;
}

}  // namespace

void hand_counts(uint32_t tick, int32_t (&counts)[3]) {
  const Stop &from = kStops[stop_before(tick)], &to = kStops[stop_before(tick) + 1];
  const int32_t span = static_cast<int32_t>(to.tick - from.tick);
  const int32_t gone = static_cast<int32_t>((tick < to.tick ? tick : to.tick) - from.tick);
  for (int k = 0; k < 3; ++k)
    counts[k] = from.counts[k] + (to.counts[k] - from.counts[k]) * gone / span;
}

Place hand_place(uint32_t tick, bool& settled) {
  const uint32_t i = stop_before(tick);
  settled = false;
  if (tick >= kStops[kStopCount - 1].tick) return Place::kEnd;
  for (int k = 0; k < 3; ++k) {
    if (kStops[i].counts[k] != kStops[i + 1].counts[k]) return Place::kFree;
  }
  settled = tick > kStops[i].tick + 50;  // the ramp and the filter have died away
  return kStops[i].until_next;
}
