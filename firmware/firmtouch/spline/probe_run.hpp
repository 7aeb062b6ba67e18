#pragma once
#include "firmtouch/core/hash.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/query/probe.hpp"
#include "firmtouch/spline/closest.hpp"
#include "firmtouch/spline/hint.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

using ProbeQuery = Closest(const View&, math::Vec3, query::Budget, CurveHint&);

/// Runs probe queries one after the other with one hint, one in each call of work(). The hash is of
/// the answers' bits.
template <ProbeQuery* kQuery>
class ProbeRunOf {
 public:
  ProbeRunOf() = default;
  explicit ProbeRunOf(const query::Probes& probes) : probes_(probes) {}

  /// Runs the next query.
  void work(const View& model) {
    if (done()) return;
    const query::ProbePoint& p = probes_.points[next_++];
    const Closest c = kQuery(model, {p.x_m, p.y_m, p.z_m}, query::kUnlimited, hint_);
    const float values[] = {c.distance_m,  c.point_m.x,          c.point_m.y,   c.point_m.z,
                            c.direction.x, c.direction.y,        c.direction.z, c.u,
                            c.v,           c.certificate.lower_m};
    for (const float value : values) hash_.add(math::bits_of(value));
    hash_.add(c.piece);
    hash_.add(c.certificate.steps);
  }
  bool done() const { return next_ >= probes_.points.size(); }
  uint64_t hash() const { return hash_.value(); }
  bool agrees() const { return hash() == probes_.hash; }

 private:
  query::Probes probes_;
  core::Hash hash_;
  CurveHint hint_;
  uint32_t next_ = 0;
};

}  // namespace firmtouch::spline
