#include "bake/asset/probes.hpp"
#include "firmtouch/spline/closest_point.hpp"

namespace firmtouch::tools {

Section spline_probes(const spline::View& model, const std::string& name) {
  std::vector<math::Vec3> anchors_m;  // the middles of the pieces, which lie on the model
  for (const spline::Piece& piece : model.pieces())
    anchors_m.push_back({piece.origin_m[0], piece.origin_m[1], piece.origin_m[2]});
  const auto points =
      probe_points(model.head().low_m, model.head().high_m, anchors_m, kProbesAGeometry);
  const core::Span<const query::ProbePoint> span(points.data(),
                                                 static_cast<uint32_t>(points.size()));
  return probe_section(spline::kProbesSection, name, points, spline::probe_hash(model, span));
}

bool spline_probes_agree(const spline::View& model, core::Bytes bytes) {
  const query::Probes probes = query::read_probes(bytes);
  return !probes.points.empty() && spline::probe_hash(model, probes.points) == probes.hash;
}

}  // namespace firmtouch::tools
