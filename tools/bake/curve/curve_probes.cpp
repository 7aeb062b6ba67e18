#include "bake/asset/probes.hpp"
#include "firmtouch/curve/closest_point.hpp"

namespace firmtouch::tools {

Section curve_probes(const curve::View& curve, const std::string& name) {
  const auto points = probe_points(curve.head().low_m, curve.head().high_m,
                                   anchors_of(curve.samples()), kProbesAGeometry);
  return answered_probes(curve::kProbesSection, name, curve, points);
}

}  // namespace firmtouch::tools
