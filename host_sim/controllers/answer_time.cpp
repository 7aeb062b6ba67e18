#include "host_sim/controllers/answer_time.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace firmtouch::host_sim {
namespace {

constexpr double kAgain_s = 10;  // from line to line

}  // namespace

AnswerTime::AnswerTime(std::string what, double limit_s)
    : what_(std::move(what)), limit_s_(limit_s) {}

double AnswerTime::passed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

bool AnswerTime::is_over() {
  const double passed = passed_s();
  if (passed >= limit_s_) return true;
  if (passed >= next_s_) {
    std::fprintf(stderr, "%s for %.0f s; waiting until %.3g s are over (--wait S)\n", what_.c_str(),
                 passed, limit_s_);
    next_s_ += kAgain_s;
  }
  return false;
}

int AnswerTime::wait_ms(int most_ms) const {
  const double left_s = std::min(limit_s_, next_s_) - passed_s();
  return std::clamp(static_cast<int>(std::ceil(left_s * 1e3)), 0, most_ms);
}

std::string AnswerTime::text() const {
  char text[40];
  std::snprintf(text, sizeof text, " in %.3g s (--wait S)", limit_s_);
  return what_ + text;
}

}  // namespace firmtouch::host_sim
