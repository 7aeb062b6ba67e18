#include "host_sim/report/score.hpp"

#include <algorithm>
#include <cmath>

#include "firmtouch/servo/step.hpp"
#include "host_sim/report/buzz.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kDirection_N = 0.2;  // below it a count of the encoder turns a force by degrees
constexpr double kPressed_N = 0.3, kLetGo_N = 0.05;
constexpr double kAtLimit = 0.999;   // of the force limit
constexpr double kWindow_s = 2.048;  // 2,048 ticks at 1 kHz

// Of every window in contact; they overlap by half.
double worst_buzz_N(const std::vector<ScoredTick>& ticks, double rate_Hz) {
  const size_t size = static_cast<size_t>(std::max(kWindow_s * rate_Hz, 2.0));
  std::vector<Vec> pressed_N;
  double worst_N = 0;
  for (const ScoredTick& tick : ticks) {
    if (!tick.is_on || !(tick.depth_m > 0)) {
      pressed_N.clear();
      continue;
    }
    pressed_N.push_back(tick.force_N);
    if (pressed_N.size() >= size && (pressed_N.size() - size) % (size / 2) == 0)
      worst_N = std::max(worst_N, buzz_N(&pressed_N[pressed_N.size() - size], size, rate_Hz));
  }
  return worst_N;
}

}  // namespace

ScoredTick scored(const record::TickOutput& output, Vec device_m, const ScoreSettings& settings,
                  const Environment& environment, ContactTurn& turn) {
  const double spring_N_per_m = environment.spring_N_per_m(touched_material(output, &environment),
                                                           settings.stiffness_N_per_m);
  const Vec contact_N = contact_force_N(output, spring_N_per_m);
  const bool is_on = motors_are_on(output);
  const uint32_t mode = output.state & record::kStateServoMask;
  return {wide(output.force_N),
          contact_N,
          turn.add_rad(output, contact_N),
          device_m,
          static_cast<double>(output.penetration_m),
          spring_N_per_m,
          is_on,
          is_on && mode != static_cast<uint32_t>(servo::Mode::kOn),
          (output.state & record::kStateOnGuide) != 0,
          (output.state & record::kStateProxy) != 0};
}

double stored_J(double stiffness_N_per_m, double depth_m, double limit_N) {
  const double stretch_m = std::min(depth_m, limit_N / std::max(stiffness_N_per_m, 1e-9));
  const double force_N = stiffness_N_per_m * stretch_m;
  return force_N * stretch_m / 2 + force_N * (depth_m - stretch_m);
}

double stored_J(const ScoreSettings& settings, const ScoredTick& before, const ScoredTick& now) {
  const double speed_mps = norm(now.device_m - before.device_m) * settings.rate_Hz;
  const double rendered_N = norm(now.contact_N) + 2 * settings.damping_N_s_per_m * speed_mps;
  return stored_J(now.stiffness_N_per_m, now.depth_m, std::min(settings.force_limit_N, rendered_N));
}

double turn_rad(Vec a_N, Vec b_N) {
  if (norm(a_N) < kDirection_N || norm(b_N) < kDirection_N) return 0;
  return std::atan2(norm(cross(a_N, b_N)), dot(a_N, b_N));
}

double turn_rad(const ScoredTick& before, const ScoredTick& now) {
  return turn_rad(before.contact_N, now.contact_N) > 0 ? now.turn_rad : 0;
}

Score score_of(const std::vector<ScoredTick>& ticks, const ScoreSettings& settings) {
  Score score;
  score.ticks = ticks.size();
  score.buzz_N = worst_buzz_N(ticks, settings.rate_Hz);
  double work_J = 0, least_J = 0;
  for (size_t i = 0; i < ticks.size(); ++i) {
    const ScoredTick& tick = ticks[i];
    const ScoredTick& before = i > 0 ? ticks[i - 1] : tick;
    work_J += dot(before.force_N, tick.device_m - before.device_m);
    const double energy_J = work_J + stored_J(settings, before, tick);
    const bool is_begun_anew = i == 0 || tick.is_guided || !tick.is_on || tick.is_ramping;
    least_J = is_begun_anew ? energy_J : std::min(least_J, energy_J);
    score.given_J = std::max(score.given_J, energy_J - least_J);
    if (!tick.is_on) continue;
    const double size_N = norm(tick.force_N);
    if (size_N > kAtLimit * settings.force_limit_N) ++score.limit_ticks;
    if (settings.tool_radius_m > 0 && !tick.has_proxy)
      score.deepest_radii = std::max(score.deepest_radii, tick.depth_m / settings.tool_radius_m);
    if (i == 0 || !ticks[i - 1].is_on) continue;
    const Vec last_N = ticks[i - 1].contact_N, now_N = tick.contact_N;
    const double moved_m = norm(tick.device_m - ticks[i - 1].device_m);
    if (!(norm(now_N - last_N) > settings.stiffness_N_per_m * moved_m)) continue;
    score.turn_rad = std::max(score.turn_rad, turn_rad(ticks[i - 1], tick));
    if (norm(last_N) > kPressed_N && norm(now_N) < kLetGo_N) ++score.let_go;
  }
  return score;
}

}  // namespace firmtouch::host_sim
