#include "bake/asset/probes.hpp"
#include "firmtouch/curve/closest_point.hpp"

namespace firmtouch::tools {

Section curve_probes(const curve::View& curve, const std::string& name) {
  return probes_about(curve::kProbesSection, name, curve, curve.samples());
}

}  // namespace firmtouch::tools
