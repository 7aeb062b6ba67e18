#include "host_sim/report/contact_quality.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::host_sim {
namespace {

constexpr double kCutOff_Hz = 50;
constexpr double kMean_s = 0.1;
constexpr double kMinShare = 0.05;  // of the force limit
constexpr double kPi = 3.14159265358979323846;

}  // namespace

Vec contact_force_N(const record::TickOutput& out, double stiffness_N_per_m) {
  if ((out.state & record::kStateOnGuide) == 0 || (out.state & record::kStateProxy) == 0)
    return wide(out.force_N);
  if ((out.state & record::kStateContact) == 0) return {};
  return (wide(out.proxy_m) - wide(out.position_m)) * stiffness_N_per_m;
}

// Butterworth high-pass of second order by the bilinear transform.
ContactQuality::ContactQuality(double rate_Hz, double force_limit_N)
    : rate_Hz_(rate_Hz), min_N_(kMinShare * force_limit_N), limit_N_(force_limit_N) {
  const double k = std::tan(kPi * std::min(kCutOff_Hz / rate_Hz, 0.49));
  const double scale = 1 / (1 + std::sqrt(2.0) * k + k * k);
  b0_ = scale;
  a1_ = 2 * (k * k - 1) * scale;
  a2_ = (1 - std::sqrt(2.0) * k + k * k) * scale;
}

double ContactQuality::high_pass(Section& s, double x) const {
  const double y = b0_ * (x - 2 * s.x1 + s.x2) - a1_ * s.y1 - a2_ * s.y2;
  s = {x, s.x1, y, s.y1};
  return y;
}

void ContactQuality::add(Vec force_N, Vec contact_N, bool motors_are_on) {
  const double component[3] = {force_N.x, force_N.y, force_N.z};
  if (!motors_are_on) {
    was_on_ = false;
    return;
  }
  if (!was_on_) {
    for (int k = 0; k < 3; ++k) sections_[k] = {component[k], component[k], 0, 0};
    mean_square_ = 0;
  }
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const double fast = high_pass(sections_[k], component[k]);
    square += fast * fast;
  }
  mean_square_ += (square - mean_square_) * std::min(1.0, 1 / (kMean_s * rate_Hz_));
  const double chatter_N = std::sqrt(mean_square_);
  chatter_N_ = std::max(chatter_N_, chatter_N);
  if (chatter_N > kChatterShare * limit_N_) chatter_s_ += 1 / rate_Hz_;
  const Vec guide_N = force_N - contact_N;
  if (was_on_ && norm(contact_N) > min_N_ && norm(last_contact_N_) > min_N_)
    turn_rad_ = std::max(turn_rad_, std::atan2(norm(cross(last_contact_N_, contact_N)),
                                               dot(last_contact_N_, contact_N)));
  if (was_on_) guide_step_N_ = std::max(guide_step_N_, norm(guide_N - last_guide_N_));
  last_contact_N_ = contact_N;
  last_guide_N_ = guide_N;
  was_on_ = true;
}

}  // namespace firmtouch::host_sim
