#include "firmtouch/mesh/triangle.hpp"

namespace firmtouch::mesh {

bool find_foot_apart(math::Vec3 p, const OfCorners& shape, Nearer wanted, Foot& foot) {
  return find_foot(p, shape, wanted, foot);
}

}  // namespace firmtouch::mesh
