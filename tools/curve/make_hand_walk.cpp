#include "curve/make_hand_walk.hpp"

#include "surface/point.hpp"
#include "surface/random.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kWander = 0.0002;  // of the diagonal, a step
constexpr double kAside = 0.01;     // of the diagonal, at most

}  // namespace

std::vector<math::Vec3> make_hand_walk(const std::vector<math::Vec3>& samples_m, uint64_t seed,
                                       uint32_t points) {
  std::vector<math::Vec3> walk;
  if (samples_m.empty()) return walk;
  Random random(seed ^ 0x68616E64ull);
  const double diagonal = diagonal_m(samples_m);
  double total = 0;
  for (size_t i = 1; i < samples_m.size(); ++i)
    total += length(to_point(samples_m[i]) - to_point(samples_m[i - 1]));
  size_t segment = 0;
  double passed = 0;  // length before the segment
  Point aside{0, 0, 0};
  for (uint32_t k = 0; k < points; ++k) {
    const double wanted = total * k / points;
    Point at = to_point(samples_m[segment]);
    while (segment + 1 < samples_m.size()) {
      const Point from = to_point(samples_m[segment]),
                  along = to_point(samples_m[segment + 1]) - from;
      const double size = length(along);
      if (wanted <= passed + size && size > 0) {
        at = from + along * ((wanted - passed) / size);
        break;
      }
      if (segment + 2 >= samples_m.size()) break;
      passed += size;
      ++segment;
    }
    aside =
        aside + Point{random.bell(), random.bell(), random.bell()} * (kWander * diagonal / 1.73);
    const double size = length(aside);
    if (size > kAside * diagonal) aside = aside * (kAside * diagonal / size);
    walk.push_back(to_vec3(at + aside));
  }
  return walk;
}

}  // namespace firmtouch::tools
