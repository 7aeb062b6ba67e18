#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "firmtouch/device/velocity.hpp"

// Estimators of velocity from an encoder's counts that a bench compares: those of the firmware, and
// others that it does not have.
namespace firmtouch::bench {

/// What a board reads from one encoder in a tick.
struct EncoderSample {
  int32_t count = 0;
  // The last edge since the tick before, if its timer latched one.
  bool has_edge = false, edge_is_up = false;
  double edge_age_s = 0;
};

/// Metres per second from a tick's sample.
using VelocityEstimate = std::function<double(const EncoderSample&)>;

VelocityEstimate firmware_estimate(const device::VelocitySettings& settings, double quantum_m,
                                   double period_s);
/// Difference over so many samples. Adaptive: over the most of them that a straight line within a
/// count fits (Janabi-Sharifi, Hayward & Chen 2000, end fit).
VelocityEstimate window_estimate(size_t samples, bool is_adaptive, double quantum_m,
                                 double period_s);
/// The line of device::Estimator::kTracking, corrected by what it misses at edges, whose place is
/// known, over the time from edge to edge.
VelocityEstimate edge_estimate(double quantum_m, double period_s);

struct NamedEstimate {
  const char* name;  // with the number of velocity_estimator, if it is the firmware's
  VelocityEstimate estimate;
  bool uses_edges = false;
};
/// All of the above; those of the firmware first, in the order of device::Estimator.
std::vector<NamedEstimate> all_estimates(double quantum_m, double period_s);

/// An incremental encoder whose timer latches the time of each edge, to a 127th of a period: what
/// seven bits hold.
class StampedEncoder {
 public:
  StampedEncoder(double quantum_m, double period_s, double start_m);
  /// The axis has moved on to `position_m`, evenly. Within a period edges are in order.
  void move(double position_m, double time_s);
  /// Of a tick.
  EncoderSample take();

 private:
  int32_t count_at(double position_m) const;

  double quantum_m_, period_s_, position_m_;
  double since_edge_s_ = 0;
  EncoderSample sample_;
};

}  // namespace firmtouch::bench
