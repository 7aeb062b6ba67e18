#pragma once
#include "firmtouch/core/hash.hpp"
#include "firmtouch/hull/view.hpp"
#include "firmtouch/query/probe.hpp"

namespace firmtouch::hull {

/// Probe queries of a hull, one by one: the shell's closest point, and the first crossing of shell
/// and mesh on the way from the point before.
class ProbeRun {
 public:
  ProbeRun() = default;
  explicit ProbeRun(const query::Probes& probes) : probes_(probes) {}
  /// Asks the next one.
  void work(const View& hull);
  bool done() const { return next_ >= probes_.points.size(); }
  bool agrees() const { return hash_.value() == probes_.hash; }
  uint64_t hash() const { return hash_.value(); }

 private:
  query::Probes probes_;
  core::Hash hash_;
  uint32_t next_ = 0;
};

/// Hash of the bits of what is answered to `points`.
uint64_t probe_hash(const View& hull, core::Span<const query::ProbePoint> points);

}  // namespace firmtouch::hull
