#pragma once
#include <chrono>
#include <string>

namespace firmtouch::host_sim {

/// Default of --wait: an emulated board starts, and proves an asset of megabytes.
constexpr double kAnswer_s = 60;

/// The time in which a controller is to answer. While it does not, a line on stderr says so after
/// 2 s, and then every 10 s.
class AnswerTime {
 public:
  /// `what`: "unix:/tmp/link: no answer to the handshake".
  AnswerTime(std::string what, double limit_s);
  /// Prints a line where one is due.
  bool is_over();
  /// At most `most_ms`, and no longer than until the next line or the end.
  int wait_ms(int most_ms) const;
  /// "unix:/tmp/link: no answer to the handshake in 60 s (--wait S)".
  std::string text() const;

 private:
  double passed_s() const;

  std::string what_;
  double limit_s_, next_s_ = 2;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace firmtouch::host_sim
