#pragma once
#include "firmtouch/core/hash.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/probe.hpp"

namespace firmtouch::query {

/// Runs the probe queries of one section, each in a slice of its own, and hashes the answers' bits.
///
/// `Prober` keeps what one query passes to the next (a hint) and has
///     void answer(const View& view, math::Vec3 p_m, const Budget& budget, core::Hash& hash);
template <class Prober>
class ProbeRun {
 public:
  ProbeRun() = default;
  explicit ProbeRun(const Probes& probes) : probes_(probes) {}

  /// The next query.
  template <class View>
  void work(const View& view, const Budget& budget = kProbeBudget) {
    if (done()) return;
    const ProbePoint& p = probes_.points[next_++];
    prober_.answer(view, {p.x_m, p.y_m, p.z_m}, budget, hash_);
  }
  bool done() const { return next_ >= probes_.points.size(); }
  bool agrees() const { return hash_.value() == probes_.hash; }
  uint64_t hash() const { return hash_.value(); }

 private:
  Probes probes_;
  core::Hash hash_;
  Prober prober_;
  uint32_t next_ = 0;
};

/// Hash of the answers to all points.
template <class Run, class View>
uint64_t hash_of_run(const View& view, core::Span<const ProbePoint> points,
                     const Budget& budget = kProbeBudget) {
  Run run({points, 0});
  while (!run.done()) run.work(view, budget);
  return run.hash();
}

}  // namespace firmtouch::query
