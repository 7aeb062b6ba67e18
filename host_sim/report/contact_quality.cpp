#include "host_sim/report/contact_quality.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::host_sim {
namespace {

constexpr double kCutOff_Hz = 50;
constexpr double kMean_s = 0.1;
constexpr double kMinShare = 0.05;  // of the force limit
constexpr double kPi = 3.14159265358979323846;
constexpr int kShares = 16;  // of a texture

double angle_rad(Vec a, Vec b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

// The unit normal n of a contact along f = (n + g) / |n + g|: n = |n + g| f - g. Slopes are below
// 1, so that one solution is positive.
Vec normal_of(Vec contact_N, Vec slope) {
  const Vec along = unit(contact_N);
  const double part = dot(along, slope);
  return along * (part + std::sqrt(part * part + 1 - dot(slope, slope))) - slope;
}

}  // namespace

uint32_t touched_material(const record::TickOutput& out, const Environment* environment) {
  const bool has_material = environment != nullptr && !environment->materials().empty() &&
                            (out.state & record::kStateContact) != 0;
  return has_material ? out.state >> record::kStateMaterialShift & 255u : 0;
}

double ContactTurn::add_rad(const record::TickOutput& out, Vec contact_N) {
  double turn_rad = angle_rad(last_N_, contact_N);
  const Vec at_m = wide(out.position_m);
  const uint32_t material = touched_material(out, environment_);
  if (material != material_) {
    before_ = material == 0 ? 0 : material_;
    material_ = material;
  }
  for (const uint32_t of : {material_, before_}) {
    if (of == 0 || !(norm(last_N_) > 0 && norm(contact_N) > 0)) continue;
    const Vec last = environment_->texture_slope(of, last_m_);
    const Vec now = environment_->texture_slope(of, at_m);
    for (int k = 1; k <= kShares && norm(now - last) > 0; ++k) {
      const double share = static_cast<double>(k) / kShares;
      turn_rad = std::min(
          turn_rad, angle_rad(normal_of(last_N_, last * share), normal_of(contact_N, now * share)));
    }
  }
  last_N_ = contact_N;
  last_m_ = at_m;
  return turn_rad;
}

Vec contact_force_N(const record::TickOutput& out, double stiffness_N_per_m) {
  if ((out.state & record::kStateContact) == 0) return {};
  constexpr uint32_t kApart = record::kStateProxy | record::kStateOnGuide;
  if ((out.state & kApart) != kApart) return wide(out.force_N);
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

void ContactQuality::add(Vec force_N, Vec contact_N, double turn_rad, bool motors_are_on) {
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
  if (was_on_ && norm(contact_N) > min_N_ && norm(last_contact_N_) > min_N_)
    turn_rad_ = std::max(turn_rad_, turn_rad);
  if (was_on_) {
    const Vec step_N = force_N - last_N_, contact_step_N = contact_N - last_contact_N_;
    guide_step_N_ = std::max(guide_step_N_, std::min(norm(step_N), norm(step_N - contact_step_N)));
  }
  last_N_ = force_N;
  last_contact_N_ = contact_N;
  was_on_ = true;
}

}  // namespace firmtouch::host_sim
