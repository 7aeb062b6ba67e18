// Height maps against the closed form of a sampled sine, and their stated bounds.
#include "firmtouch/scene/relief.hpp"

#include <cmath>
#include <vector>

#include "firmtouch/math/vec3_ops.hpp"
#include "harness/test.hpp"
#include "surface/random.hpp"

using namespace firmtouch;  // NOLINT: a test file

namespace {

constexpr double kPi = 3.14159265358979;
constexpr double kTile_m = 4e-3, kHigh_m = 1e-4;

double wide(float a) { return static_cast<double>(a); }

// Tiles of 4 mm along x and along (0, 0.6, 0.8).
scene::ReliefLayout relief_of(uint32_t side) {
  return {{250, 0, 0}, {0, 150, 200}, static_cast<float>(kHigh_m), 0, 0, 3, side};
}

// A cosine of one period a tile as the spline has it, at t samples: by Poisson's sum, with the
// Fourier transform of the spline, sinc^3. And what it grows a sample.
struct Wave {
  double value = 0, rise = 0;
};
Wave wave_at(double t, uint32_t side) {
  Wave wave;
  for (int m = -300; m <= 300; ++m) {
    const double f = 1.0 / side + m, sinc = std::sin(kPi * f) / (kPi * f);
    wave.value += std::pow(sinc, 3) * std::cos(2 * kPi * f * t);
    wave.rise -= std::pow(sinc, 3) * 2 * kPi * f * std::sin(2 * kPi * f * t);
  }
  return wave;
}

std::vector<uint8_t> random_samples(tools::Random& random, uint32_t side) {
  std::vector<uint8_t> samples(3 + side * side);
  for (uint8_t& sample : samples) sample = static_cast<uint8_t>(random.between(0, 256));
  return samples;
}

scene::Cut cut_of(const scene::ReliefLayout& relief, const std::vector<uint8_t>& samples,
                  math::Vec3 x_m) {
  scene::Cut cut;
  scene::add_relief(relief, samples.data(), x_m, cut);
  return cut;
}

}  // namespace

// A hump in u and one half as high in v. A sample is rounded by half a count, of 255.
TEST(Relief_OfASampledSine_IsTheClosedForm) {
  tools::Random random(7);
  for (const uint32_t side : {4u, 8u, 16u, 64u}) {
    const scene::ReliefLayout relief = relief_of(side);
    std::vector<uint8_t> samples(3);
    for (uint32_t v = 0; v < side; ++v)
      for (uint32_t u = 0; u < side; ++u)
        samples.push_back(static_cast<uint8_t>(std::lround(
            127.5 + 80 * std::cos(2 * kPi * u / side) + 40 * std::cos(2 * kPi * v / side))));
    const double count_m = kHigh_m / 255, within_m = 0.51 * count_m;
    for (int i = 0; i < 3000; ++i) {
      const math::Vec3 x_m{static_cast<float>(random.between(-0.02, 0.02)),
                           static_cast<float>(random.between(-0.02, 0.02)),
                           static_cast<float>(random.between(-0.02, 0.02))};
      const double per_m = side / kTile_m;
      const Wave u = wave_at(wide(x_m.x) * per_m, side);
      const Wave v = wave_at((0.6 * wide(x_m.y) + 0.8 * wide(x_m.z)) * per_m, side);
      const scene::Cut cut = cut_of(relief, samples, x_m);
      CHECK_LE(std::fabs(wide(cut.depth_m) - count_m * (127.5 + 80 * u.value + 40 * v.value)),
               within_m);
      // A rise is the difference of two means.
      CHECK_LE(std::fabs(wide(cut.slope.x) - count_m * per_m * 80 * u.rise), 2 * within_m * per_m);
      const double along_v = 0.6 * wide(cut.slope.y) + 0.8 * wide(cut.slope.z);
      CHECK_LE(std::fabs(along_v - count_m * per_m * 40 * v.rise), 2 * within_m * per_m);
    }
  }
}

// Any samples: depth, slope and the change of the slope keep to the bounds, across the joints of
// samples and tiles, too; and a bound is not far above what is found.
TEST(Relief_AnySamples_KeepToTheirBounds) {
  tools::Random random(9);
  for (const uint32_t side : {4u, 16u, 64u}) {
    const scene::ReliefLayout relief = relief_of(side);
    const std::vector<uint8_t> samples = random_samples(random, side);
    const scene::ReliefBounds bounds = scene::bounds_of(relief, samples.data());
    double steepest = 0, most_per_m = 0;
    for (int i = 0; i < 100000; ++i) {
      math::Vec3 at_m{static_cast<float>(random.between(-0.01, 0.01)),
                      static_cast<float>(random.between(-0.01, 0.01)),
                      static_cast<float>(random.between(-0.01, 0.01))};
      if (i % 2 == 0) at_m.x = static_cast<float>((i % 64 + 0.5) * kTile_m / side);  // at a joint
      const math::Vec3 way_m{static_cast<float>(random.between(-2e-5, 2e-5)),
                             static_cast<float>(random.between(-2e-5, 2e-5)), 0};
      const scene::Cut cut = cut_of(relief, samples, at_m);
      const scene::Cut next = cut_of(relief, samples, at_m + way_m);
      CHECK(cut.depth_m >= 0 && wide(cut.depth_m) <= kHigh_m * 1.000001);
      const double slope = wide(math::length(cut.slope));
      const double per_m =
          wide(math::length(next.slope - cut.slope)) / wide(math::length(way_m) + 1e-8f);
      CHECK_LE(slope, wide(bounds.slope) * 1.00001);
      CHECK_LE(per_m, wide(bounds.per_m) * 1.001);
      steepest = std::max(steepest, slope), most_per_m = std::max(most_per_m, per_m);
    }
    CHECK_GE(steepest, 0.3 * wide(bounds.slope));
    CHECK_GE(most_per_m, 0.2 * wide(bounds.per_m));
  }
}

TEST(Relief_AnyPlace_IsFinite) {
  tools::Random random(11);
  const std::vector<uint8_t> samples = random_samples(random, 16);
  for (const float x_m : {0.0f, NAN, INFINITY, -INFINITY, 1e30f, -3e38f, 1e-40f, 1e6f, 33554.5f}) {
    const scene::Cut cut = cut_of(relief_of(16), samples, {x_m, 1, x_m});
    CHECK(math::is_finite(cut.slope) && cut.depth_m >= 0 && wide(cut.depth_m) <= kHigh_m * 1.001);
  }
}
