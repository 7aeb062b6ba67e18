#pragma once
#include <cstdint>
#include <vector>

#include "surface/surface.hpp"

namespace firmtouch::tools {

// The demo's part: a grooved cam knob. A disc of 0.1 m with a bored collar and a lobed rim; its top
// face rises and falls, and a groove with sharp lips winds around the collar for a finger or a
// follower to run in.

constexpr double kGrooveDepth_m = 0.0028;
constexpr double kGrooveHalfWidth_m = 0.0032;
// The guide runs this far above the groove's floor: a tool of 3 mm radius, centred on it, just
// touches the floor.
constexpr double kGuideHeight_m = 0.003;

/// The part of this seed: closed, genus 1, outward, metres; at least `min_faces` and at most 1.1
/// times as many (min_faces >= 2,000). The same bytes on every machine.
Surface make_part(uint64_t seed, uint32_t min_faces = 20000);

/// The guide that runs in the groove of the part of the same seed: once around, unevenly spaced
/// (the longest step is more than twice the shortest), the last point repeats the first. points >=
/// 16.
std::vector<math::Vec3> make_path(uint64_t seed, uint32_t points = 2000);

}  // namespace firmtouch::tools
