#include "host_sim/plant/sampled_wall.hpp"

#include <algorithm>
#include <cmath>

#include "firmtouch/device/cartesian.hpp"
#include "host_sim/plant/device.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kHighest_N_per_m = 1e7;

// The axis over one period under a constant force: x' = a[0] x + a[1] v + b[0] F, and so v' with
// the second row.
struct Period {
  double a[2][2], b[2];
};

// The exponential of [[0, 1, 0], [-k/m, -b/m, 1/m], [0, 0, 0]] T, by its series for a small share
// of T and by squaring.
Period exact_period(const SampledWall& wall) {
  constexpr int kSquarings = 20, kTerms = 8;
  const double m = wall.mass_kg + wall.hand_mass_kg;
  const double t = std::ldexp(wall.period_s, -kSquarings);
  const double rate[3][3] = {
      {0, t, 0},
      {-wall.hand_stiffness_N_per_m / m * t,
       -(wall.viscous_N_s_per_m + wall.hand_damping_N_s_per_m) / m * t, t / m},
      {0, 0, 0}};
  // Kept as the difference to the unit matrix: exp(2 x) - 1 = d d + 2 d.
  double d[3][3] = {}, term[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto times = [](const double(&p)[3][3], const double(&q)[3][3], double(&r)[3][3]) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        r[i][j] = p[i][0] * q[0][j] + p[i][1] * q[1][j] + p[i][2] * q[2][j];
  };
  for (int n = 1; n <= kTerms; ++n) {
    double next[3][3];
    times(term, rate, next);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) d[i][j] += term[i][j] = next[i][j] / n;
  }
  for (int n = 0; n < kSquarings; ++n) {
    double square[3][3];
    times(d, d, square);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) d[i][j] = square[i][j] + 2 * d[i][j];
  }
  return {{{1 + d[0][0], d[0][1]}, {d[1][0], 1 + d[1][1]}}, {d[0][2], d[1][2]}};
}

template <class Holds>
double bisect(double low, double high, double ratio, const Holds& holds) {
  while (high / low > ratio) {
    const double middle = std::sqrt(low * high);
    (holds(middle) ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

DeviceModel model_of(const SampledWall& wall, double quantum_m) {
  DeviceModel model;
  model.mass_kg = wall.mass_kg + wall.hand_mass_kg;
  model.viscous_N_s_per_m = wall.viscous_N_s_per_m;
  model.coulomb_N = 0;
  model.encoder_quantum_m = quantum_m;
  model.force_limit_N = 1e300;
  model.output_delay_samples = wall.delay_samples;
  return model;
}

// As trace/run.cpp does it: the hand's force is constant during a substep.
void advance(Device& device, const SampledWall& wall, double push_N, double time_s) {
  const bool is_held = wall.hand_stiffness_N_per_m > 0 || wall.hand_damping_N_s_per_m > 0;
  const int substeps = is_held ? 16 : 1;
  for (int i = 0; i < substeps; ++i) {
    const double hand_N = -wall.hand_stiffness_N_per_m * device.position_m().x -
                          wall.hand_damping_N_s_per_m * device.velocity_mps().x;
    device.advance({push_N + hand_N, 0, 0}, time_s / substeps);
  }
}

// Whether the largest excursion falls from the second quarter of the run to the fourth.
bool decays(const SampledWall& wall, double stiffness) {
  const int ticks = 40000;
  Device device(model_of(wall, 1e-6), {1e-3, 0, 0});
  double before = 1e-3, first = 1e-300, second = 1e-300;
  for (int i = 0; i < ticks; ++i) {
    const double x = device.position_m().x;
    if (!(std::fabs(x) < 1e100)) return false;
    if (i >= ticks / 4 && i < ticks / 2) first = std::fmax(first, std::fabs(x));
    if (i >= 3 * (ticks / 4)) second = std::fmax(second, std::fabs(x));
    device.command({-stiffness * x - wall.damping_N_s_per_m * (x - before) / wall.period_s, 0, 0});
    before = x;
    advance(device, wall, 0, wall.period_s);
  }
  return second <= first;
}

// The tick's motion once more, in parts, for the edges that it passes.
void pass_edges(Device plant, const SampledWall& wall, double push_N,
                bench::StampedEncoder& encoder) {
  constexpr int kParts = 4;
  for (int i = 0; i < kParts; ++i) {
    advance(plant, wall, push_N, wall.period_s / kParts);
    encoder.move(plant.position_m().x, wall.period_s / kParts);
  }
}

bool comes_to_rest(const SampledWall& wall, double quantum_m, const bench::NamedEstimate& of,
                   double stiffness) {
  Device plant(model_of(wall, quantum_m), {});
  const float per_m = static_cast<float>(1 / quantum_m);
  const device::Settings settings = {
      {per_m, per_m, per_m}, {}, {1, 1, 1}, 100, {device::Estimator::kDifference, 0}};
  device::State state;
  bench::VelocityEstimate velocity = of.estimate;
  bench::StampedEncoder encoder(quantum_m, wall.period_s, 0);
  const int ticks = static_cast<int>(3 / wall.period_s);
  double low = 1, high = -1;
  for (int i = 0; i < ticks; ++i) {
    const device::Reading reading = device::read(
        state, settings, {{plant.count(0), 0, 0}, true, static_cast<float>(wall.period_s)});
    const double x = static_cast<double>(reading.position_m.x);
    bench::EncoderSample sample = encoder.take();
    sample.count = plant.count(0);
    const double v = velocity(sample);
    plant.command({x > 0 ? -stiffness * x - wall.damping_N_s_per_m * v : 0, 0, 0});
    if (of.uses_edges) pass_edges(plant, wall, 1, encoder);
    advance(plant, wall, 1, wall.period_s);
    if (!(std::fabs(plant.position_m().x) < 0.5)) return false;
    if (i < 3 * (ticks / 4)) continue;
    low = std::fmin(low, plant.position_m().x);
    high = std::fmax(high, plant.position_m().x);
  }
  return high - low < 3 * quantum_m;
}

}  // namespace

double passive_limit_N_per_m(const SampledWall& wall) {
  const double b = wall.viscous_N_s_per_m - std::fabs(wall.damping_N_s_per_m);
  return std::fmax(0, 2 * b / wall.period_s);
}

double delayed_limit_N_per_m(const SampledWall& wall) {
  return (wall.viscous_N_s_per_m + wall.damping_N_s_per_m) /
         (wall.period_s * (0.5 + wall.delay_samples));
}

bool is_schur_stable(const double* coefficient, uint32_t degree) {
  double a[16];
  std::copy(coefficient, coefficient + degree + 1, a);
  for (uint32_t n = degree; n > 0; --n) {
    if (!(std::fabs(a[n]) < std::fabs(a[0]))) return false;
    double next[16];
    for (uint32_t i = 0; i < n; ++i) next[i] = a[0] * a[i] - a[n] * a[n - i];
    const double scale = 1 / std::fabs(next[0]);  // not 0, since |a[n]| < |a[0]|
    for (uint32_t i = 0; i < n; ++i) a[i] = next[i] * scale;
  }
  return true;
}

// The axis is N(z) / D(z) from force to position, the wall -(K z + B / T (z - 1)) / z^(delay + 1):
// D z^(delay + 1) + N (K z + B / T (z - 1)) = 0.
double exact_limit_N_per_m(const SampledWall& wall) {
  const Period p = exact_period(wall);
  const double numerator[2] = {p.b[0], p.a[0][1] * p.b[1] - p.a[1][1] * p.b[0]};
  const double damper = wall.damping_N_s_per_m / wall.period_s;
  const uint32_t degree = 3 + wall.delay_samples;
  return bisect(1e-3, kHighest_N_per_m, 1 + 1e-9, [&](double stiffness) {
    double c[16] = {1, -(p.a[0][0] + p.a[1][1]), p.a[0][0] * p.a[1][1] - p.a[0][1] * p.a[1][0]};
    const double controller[2] = {stiffness + damper, -damper};
    for (uint32_t i = 0; i < 2; ++i)
      for (uint32_t j = 0; j < 2; ++j) c[degree - 2 + i + j] += numerator[i] * controller[j];
    return is_schur_stable(c, degree);
  });
}

double simulated_limit_N_per_m(const SampledWall& wall) {
  return bisect(1, kHighest_N_per_m, 1.0005, [&](double k) { return decays(wall, k); });
}

double rest_limit_N_per_m(const SampledWall& wall, double quantum_m,
                          const bench::NamedEstimate& of) {
  double last = 0;
  for (double k = 500; k < kHighest_N_per_m; k *= 1.01) {
    if (!comes_to_rest(wall, quantum_m, of, k)) break;
    last = k;
  }
  return last;
}

}  // namespace firmtouch::host_sim
