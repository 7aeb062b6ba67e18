#include "host_sim/report/buzz.hpp"

#include <cmath>
#include <complex>
#include <vector>

namespace firmtouch::host_sim {
namespace {

using Complex = std::complex<double>;

constexpr double kPi = 3.14159265358979323846;
constexpr double kLow_Hz = 50, kHigh_Hz = 500;

// In place; the size is a power of two.
void transform(std::vector<Complex>& x) {
  const size_t n = x.size();
  for (size_t i = 1, j = 0; i < n; ++i) {  // bits reversed
    size_t bit = n >> 1;
    for (; (j & bit) != 0; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
  for (size_t half = 1; half < n; half *= 2)
    for (size_t k = 0; k < half; ++k) {
      const Complex turn =
          std::polar(1.0, -kPi * static_cast<double>(k) / static_cast<double>(half));
      for (size_t i = k; i < n; i += 2 * half) {
        const Complex odd = turn * x[i + half];
        x[i + half] = x[i] - odd;
        x[i] += odd;
      }
    }
}

}  // namespace

double buzz_N(const Vec* force_N, size_t count, double rate_Hz) {
  size_t n = 1;
  while (2 * n <= count) n *= 2;
  const Vec* last_N = force_N + (count - n);
  const double size = static_cast<double>(n);
  double total = 0;
  for (double Vec::*axis : {&Vec::x, &Vec::y, &Vec::z}) {
    double mean = 0, weight = 0;
    for (size_t i = 0; i < n; ++i) mean += last_N[i].*axis / size;
    std::vector<Complex> x(n);
    for (size_t i = 0; i < n; ++i) {
      const double window = 0.5 - 0.5 * std::cos(2 * kPi * (static_cast<double>(i) + 0.5) / size);
      x[i] = (last_N[i].*axis - mean) * window;
      weight += window * window;
    }
    transform(x);
    for (size_t bin = 1; bin <= n / 2; ++bin) {
      const double frequency_Hz = static_cast<double>(bin) * rate_Hz / size;
      if (frequency_Hz < kLow_Hz || frequency_Hz > kHigh_Hz) continue;
      total += std::norm(x[bin]) * (2 * bin == n ? 1 : 2) / (weight * size);
    }
  }
  return std::sqrt(total);
}

}  // namespace firmtouch::host_sim
