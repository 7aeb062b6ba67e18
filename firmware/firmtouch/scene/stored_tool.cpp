#include "firmtouch/scene/stored_tool.hpp"

#include "firmtouch/core/bytes.hpp"

namespace firmtouch::scene {

core::Verdict open(core::Bytes section, StoredTool& to) {
  to = {};
  const StoredTool spheres = core::as_whole_array<SphereLayout>(section);
  if (spheres.size() == 0 || spheres.size() > kMaxSpheres) return core::reject(kRuleSphereCount);
  for (uint32_t i = 0; i < spheres.size(); ++i) {
    for (const float at_m : spheres[i].at_m)
      if (!(at_m >= -kMaxArm_m && at_m <= kMaxArm_m)) return core::reject(kRuleSpherePlace, i);
    const float radius_m = spheres[i].radius_m;
    if (!(radius_m >= 0.0f && radius_m <= kMaxSphereRadius_m))
      return core::reject(kRuleSphereRadius, i);
  }
  to = spheres;
  return core::kPassed;
}

}  // namespace firmtouch::scene
