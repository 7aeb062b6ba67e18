#include "bake/asset/probes.hpp"

#include <cstring>

#include "surface/random.hpp"

namespace firmtouch::tools {
namespace {

constexpr uint64_t kSeed = 20240607;

float between(Random& random, float low, float high) {
  return static_cast<float>(random.between(static_cast<double>(low), static_cast<double>(high)));
}

}  // namespace

std::vector<query::ProbePoint> probe_points(const float (&low_m)[3], const float (&high_m)[3],
                                            const std::vector<math::Vec3>& anchors_m,
                                            uint32_t count) {
  Random random(kSeed);
  float extent_m = 0;
  for (int k = 0; k < 3; ++k)
    extent_m = high_m[k] - low_m[k] > extent_m ? high_m[k] - low_m[k] : extent_m;
  std::vector<query::ProbePoint> points;
  for (uint32_t i = 0; i < count; ++i) {
    float at[3];
    const math::Vec3 anchor = anchors_m[random.below(static_cast<uint32_t>(anchors_m.size()))];
    const float anchor_m[3] = {anchor.x, anchor.y, anchor.z};
    // Of eight: one on a vertex, four within 2 % of the extent of one, one in the box, one about
    // it, one far away.
    const uint32_t kind = i % 8;
    const float wide_m = kind == 0 ? 0 : 0.02f * extent_m;
    const float margin_m = kind == 5 ? 0 : (kind == 6 ? 0.5f * extent_m : 20.0f * extent_m);
    for (int k = 0; k < 3; ++k) {
      at[k] = kind < 5 ? anchor_m[k] + between(random, -wide_m, wide_m)
                       : between(random, low_m[k] - margin_m, high_m[k] + margin_m);
    }
    points.push_back({at[0], at[1], at[2]});
  }
  return points;
}

Section probe_section(uint32_t type, const std::string& name,
                      const std::vector<query::ProbePoint>& points, uint64_t hash) {
  query::ProbeHead head{};
  head.count = static_cast<uint32_t>(points.size());
  head.hash_low = static_cast<uint32_t>(hash);
  head.hash_high = static_cast<uint32_t>(hash >> 32);
  Section section{type, name,
                  std::vector<uint8_t>(sizeof(head) + points.size() * sizeof(points[0]))};
  std::memcpy(section.bytes.data(), &head, sizeof(head));
  std::memcpy(section.bytes.data() + sizeof(head), points.data(),
              points.size() * sizeof(points[0]));
  return section;
}

}  // namespace firmtouch::tools
