#pragma once
#include <string>

#include "bench/timing.hpp"

namespace firmtouch::bench {

/// Another program that answers the same queries: `COMMAND closest|segment|polyline|spline FILE
/// in.csv [--warm]` prints a line that holds `us_per_query X`. `--warm`, of `closest` alone: each
/// query may start where the one before ended.
class Peer {
 public:
  /// `command` is for the shell; empty: there is no peer.
  explicit Peer(std::string command) : command_(std::move(command)) {}
  bool is_present() const { return !command_.empty(); }

  /// One run of the peer; throws a Problem with command, status and remedy where it fails or says
  /// no time.
  double us_per_query(const std::string& kind, const std::string& file, const std::string& csv,
                      const std::string& option = "") const;
  /// The same program's `build_s X`: what building its tree took, in microseconds; NaN where it
  /// prints none.
  double build_us(const std::string& kind, const std::string& file, const std::string& csv) const;
  /// us_per_query() for medians_us(). `option`: the last argument of the peer; empty: none.
  Contender contender(const std::string& kind, const std::string& file, const std::string& csv,
                      const std::string& option = "") const;

 private:
  std::string output(const std::string& kind, const std::string& file, const std::string& csv,
                     const std::string& option) const;

  std::string command_;
};

/// Stands in a report where there is no peer.
constexpr const char* kPeerAbsent = "peer absent";

}  // namespace firmtouch::bench
