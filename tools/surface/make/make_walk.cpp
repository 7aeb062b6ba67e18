#include "surface/make/make_walk.hpp"

#include "surface/point.hpp"
#include "surface/random.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kStep = 0.0005;     // of the diagonal
constexpr uint32_t kQueryEvery = 2;  // steps, in which the distance grows by 0.001 at most
// Of the diagonal: beyond it the surface draws the walk back, as a hand that touches a part of 0.1
// m keeps within tenths of a millimetre of its surface. Seen: mean 0.001 from the surface.
constexpr double kPullFrom = 0.0005;
constexpr double kTurnAt =
    0.0165;  // beyond it the walk goes straight back; 0.0165 + 0.0025 leaves 5 % to spare

}  // namespace

std::vector<math::Vec3> make_walk(const Surface& surface, uint64_t seed, uint32_t points,
                                  const std::function<math::Vec3(math::Vec3)>& closest) {
  std::vector<math::Vec3> walk;
  if (surface.faces.empty() || points == 0) return walk;
  Random random(seed ^ 0x77616C6Bull);
  const double diagonal = diagonal_m(surface.vertices);
  const Face& face = surface.faces[random.below(static_cast<uint32_t>(surface.faces.size()))];
  Point p = to_point(surface.vertices[face[0]]), heading, back;
  double distance = 0;
  for (uint32_t k = 0; k < points; ++k) {
    walk.push_back(to_vec3(p));
    if (k % kQueryEvery == 0) {
      back = to_point(closest(walk.back())) - p;
      distance = length(back);
    }
    heading = heading * 0.95 + Point{random.bell(), random.bell(), random.bell()} * 0.3;
    if (distance > kPullFrom * diagonal) heading = heading + back * (2 / distance);
    if (distance > kTurnAt * diagonal) heading = back;
    const double size = length(heading);
    if (size > 0) p = p + heading * (kStep * diagonal / size);
  }
  return walk;
}

}  // namespace firmtouch::tools
