#include "bake/asset/probes.hpp"
#include "firmtouch/spline/closest_point.hpp"

namespace firmtouch::tools {

Section spline_probes(const spline::View& model, const std::string& name) {
  std::vector<math::Vec3> anchors_m;  // the middles of the pieces, which lie on the model
  for (const spline::Piece& piece : model.pieces())
    anchors_m.push_back({piece.origin_m[0], piece.origin_m[1], piece.origin_m[2]});
  const auto points =
      probe_points(model.head().low_m, model.head().high_m, anchors_m, kProbesAGeometry);
  return answered_probes(spline::kProbesSection, name, model, points);
}

}  // namespace firmtouch::tools
