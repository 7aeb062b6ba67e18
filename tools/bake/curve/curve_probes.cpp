#include "bake/asset/probes.hpp"
#include "firmtouch/curve/closest_point.hpp"

namespace firmtouch::tools {

Section curve_probes(const curve::View& curve, const std::string& name) {
  const auto points = probe_points(curve.head().low_m, curve.head().high_m,
                                   anchors_of(curve.samples()), kProbesAGeometry);
  const core::Span<const query::ProbePoint> span(points.data(),
                                                 static_cast<uint32_t>(points.size()));
  return probe_section(curve::kProbesSection, name, points, curve::probe_hash(curve, span));
}

bool curve_probes_agree(const curve::View& curve, core::Bytes bytes) {
  const query::Probes probes = query::read_probes(bytes);
  return !probes.points.empty() && curve::probe_hash(curve, probes.points) == probes.hash;
}

}  // namespace firmtouch::tools
