#include "firmtouch/device/compensation.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/device/rules.hpp"

namespace firmtouch::device {
namespace {

using core::reject;

constexpr float kMaxSpring_Nm_per_rad = 1000.0f;
constexpr float kMaxAngle_rad = 100.0f;

}  // namespace

core::Bytes before_compensation(core::Bytes section) {
  if (section.size() < sizeof(LinkageLayout) + sizeof(CompensationLayout)) return section;
  const uint32_t before = section.size() - uint32_t{sizeof(CompensationLayout)};
  uint32_t tag;
  __builtin_memcpy(&tag, section.data() + before, sizeof tag);
  return tag == kCompensationTag ? core::Bytes{section.data(), before} : section;
}

core::Verdict open(core::Bytes section, const StoredLinkage& linkage, Compensation& to) {
  to.layout_ = nullptr;
  const uint32_t before = before_compensation(section).size();
  if (before == section.size()) return core::kPassed;
  const CompensationLayout& compensation = core::as_array<CompensationLayout>(
      {section.data() + before, sizeof(CompensationLayout)}, 1)[0];
  bool has_one = false;
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    const float spring = compensation.spring_Nm_per_rad[k], relaxed = compensation.relaxed_rad[k];
    if (is_zero(spring) && is_zero(relaxed)) continue;
    if (!(spring > 0.0f && spring <= kMaxSpring_Nm_per_rad && k < linkage.layout().joints))
      return reject(kRuleCompensation, k);
    if (!(relaxed >= -kMaxAngle_rad && relaxed <= kMaxAngle_rad))
      return reject(kRuleCompensation, kMaxJoints + k);
    has_one = true;
  }
  if (!has_one) return reject(kRuleCompensation, 2 * kMaxJoints);
  to.layout_ = &compensation;
  return core::kPassed;
}

math::Vec3 spring_torques_Nm(const Compensation& compensation,
                             const float (&angle_rad)[kMaxJoints]) {
  const CompensationLayout& l = compensation.layout();
  const auto of = [&](uint32_t k) {
    return l.spring_Nm_per_rad[k] * (l.relaxed_rad[k] - angle_rad[k]);
  };
  return {of(0), of(1), of(2)};
}

}  // namespace firmtouch::device
