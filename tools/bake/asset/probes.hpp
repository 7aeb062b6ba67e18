#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bake/asset/section.hpp"
#include "firmtouch/curve/view.hpp"
#include "firmtouch/hull/view.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/query/probe.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::tools {

constexpr uint32_t kProbesAGeometry = 64;

/// Points that between them take every way through a query: vertices themselves, near the surface,
/// inside the box, about the box and far from it. Deterministic.
std::vector<query::ProbePoint> probe_points(const float (&low_m)[3], const float (&high_m)[3],
                                            const std::vector<math::Vec3>& anchors_m,
                                            uint32_t count);

/// Up to about a thousand of a geometry's points, evenly spread over their order.
template <class Point>
std::vector<math::Vec3> anchors_of(core::Span<const Point> points) {
  std::vector<math::Vec3> anchors;
  const uint32_t step = points.size() / 1024 + 1;
  for (uint32_t i = 0; i < points.size(); i += step) {
    anchors.push_back({points[i].x_m, points[i].y_m, points[i].z_m});
  }
  return anchors;
}

Section probe_section(uint32_t type, const std::string& name,
                      const std::vector<query::ProbePoint>& points, uint64_t hash);

/// The section of `points` with the answers of this machine.
template <class View>
Section answered_probes(uint32_t type, const std::string& name, const View& view,
                        const std::vector<query::ProbePoint>& points) {
  const core::Span<const query::ProbePoint> span(points.data(),
                                                 static_cast<uint32_t>(points.size()));
  return probe_section(type, name, points, probe_hash(view, span));
}

/// The same of points that probe_points() chooses about a geometry's own.
template <class View, class Point>
Section probes_about(uint32_t type, const std::string& name, const View& view,
                     core::Span<const Point> points) {
  return answered_probes(
      type, name, view,
      probe_points(view.head().low_m, view.head().high_m, anchors_of(points), kProbesAGeometry));
}

/// What this machine answers to probe_points() of a proven mesh, hull or curve, as the section that
/// a controller's begin() compares with its own answers.
Section mesh_probes(const mesh::View& mesh, const std::string& name);
Section curve_probes(const curve::View& curve, const std::string& name);
Section hull_probes(const hull::View& hull, const std::string& name);
Section spline_probes(const spline::View& model, const std::string& name);

/// Whether this machine answers a probe section of `view`, of whatever geometry, as stated.
/// Result: false where `bytes` is no such section.
template <class View>
bool probes_agree(const View& view, core::Bytes bytes) {
  const query::Probes probes = query::read_probes(bytes);
  return !probes.points.empty() && probe_hash(view, probes.points) == probes.hash;
}

}  // namespace firmtouch::tools
