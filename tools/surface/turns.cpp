#include "surface/turns.hpp"

#include <cmath>

namespace firmtouch::tools {
namespace {

constexpr double kTwoPi = 6.283185307179586;

// Taylor series on [-pi/4, pi/4]: the first term left out is below 1e-17.
double sine_series(double x) {
  const double y = x * x;
  double sum = 1;
  for (int k = 17; k >= 3; k -= 2) sum = 1 - y / (k * (k - 1)) * sum;
  return x * sum;
}

double cosine_series(double x) {
  const double y = x * x;
  double sum = 1;
  for (int k = 18; k >= 2; k -= 2) sum = 1 - y / (k * (k - 1)) * sum;
  return sum;
}

}  // namespace

double sine_of_turns(double turns) {
  const double part = turns - std::floor(turns);
  const double quarter = std::floor(part * 4 + 0.5);
  const double x = (part - quarter * 0.25) * kTwoPi;
  switch (static_cast<int>(quarter) & 3) {
    case 0:
      return sine_series(x);
    case 1:
      return cosine_series(x);
    case 2:
      return -sine_series(x);
    default:
      return -cosine_series(x);
  }
}

double cosine_of_turns(double turns) { return sine_of_turns(turns - std::floor(turns) + 0.25); }

}  // namespace firmtouch::tools
