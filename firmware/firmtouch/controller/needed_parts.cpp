#include "firmtouch/controller/needed_parts.hpp"

#include "firmtouch/asset/loading.hpp"
#include "firmtouch/controller/asset_loading.hpp"
#include "firmtouch/core/bytes.hpp"
#include "firmtouch/curve/layout.hpp"
#include "firmtouch/device/layout.hpp"
#include "firmtouch/field/layout.hpp"
#include "firmtouch/hull/layout.hpp"
#include "firmtouch/mesh/layout.hpp"
#include "firmtouch/scene/materials_layout.hpp"
#include "firmtouch/scene/objects_layout.hpp"
#include "firmtouch/scene/tool_layout.hpp"
#include "firmtouch/spline/guide/view.hpp"
#include "firmtouch/spline/layout.hpp"

namespace firmtouch {
namespace {

static_assert(kRuleNeedsMesh + kPartCount - 1 == kRuleNeedsTool, "a rule a part, in order");

// What each section needs, except splines.
constexpr struct {
  uint16_t type, part;
} kNeeded[] = {{mesh::kHeadSection, kPartMesh},
               {field::kHeadSection, kPartField},
               {hull::kHeadSection, kPartHull},
               {curve::kHeadSection, kPartGuide},
               {device::kLinkageSection, kPartLinkage},
               {scene::kObjectsSection, kPartObjects},
               {scene::kMaterialsSection, kPartMaterials},
               {scene::kToolSection, kPartTool}};

bool same(const char* a, const char* b) {
  while (*a != 0 && *a == *b) ++a, ++b;
  return *a == *b;
}

// Curves without lengths make no guide, and need nothing.
uint32_t spline_part(const asset::Container& asset, uint32_t i) {
  const core::Span<const spline::Head> head = core::as_whole_array<spline::Head>(asset.section(i));
  if (head.size() != 1) return 0;
  if (head[0].is_surface != 0) return kPartSpline;
  return asset.find(spline::kArcsSection, asset.name(i)).empty() ? 0u : uint32_t{kPartSplineGuide};
}

}  // namespace

uint32_t part_of_section(const asset::Container& asset, uint32_t i) {
  const uint32_t type = asset.type(i);
  if (type == spline::kHeadSection) return spline_part(asset, i);
  for (const auto& needed : kNeeded)
    if (needed.type == type) return needed.part;
  return 0;
}

uint32_t needed_parts(const asset::Container& asset) {
  uint32_t parts = 0;
  for (uint32_t i = 0; i < asset.section_count(); ++i) parts |= part_of_section(asset, i);
  return parts;
}

core::Verdict missing_part(const asset::Container& asset, const Selection& selection,
                           uint32_t linked) {
  for (uint32_t i = 0; i < asset.section_count(); ++i) {
    const uint32_t part = part_of_section(asset, i);
    if ((part & ~linked) == 0) continue;
    const bool is_guide = (part & (kPartGuide | kPartSplineGuide)) != 0;
    const char* wanted = is_guide ? selection.guide : selection.surface;
    const bool is_of_device = (part & (kPartLinkage | kPartTool)) != 0;
    if (!is_of_device && wanted != nullptr && !same(wanted, asset.name(i))) continue;
    uint32_t number = 0;
    while (part >> number != 1) ++number;
    return core::reject(static_cast<uint16_t>(kRuleNeedsMesh + number), i);
  }
  return core::kPassed;
}

}  // namespace firmtouch
