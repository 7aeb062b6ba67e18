#pragma once
#include <stdint.h>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/core/status.hpp"

// The parts of a controller that an asset needs, by the geometries and the linkage that are in it.
namespace firmtouch {

struct Selection;

enum Part : uint32_t {
  kPartMesh = 1u << 0,
  kPartField = 1u << 1,
  kPartHull = 1u << 2,
  kPartGuide = 1u << 3,
  kPartSpline = 1u << 4,
  kPartSplineGuide = 1u << 5,
  kPartLinkage = 1u << 6,
  kPartObjects = 1u << 7,
  kPartMaterials = 1u << 8,
  kPartTool = 1u << 9,
};
constexpr uint32_t kPartCount = 10;

/// Name of part `number` (its bit), as in FIRMTOUCH_APP and in the texts of rules R909 to R918.
constexpr const char* part_name(uint32_t number) {
  constexpr const char* kName[kPartCount] = {"mesh",      "field",        "hull",    "guide",
                                             "spline",    "spline_guide", "linkage", "objects",
                                             "materials", "tool"};
  return number < kPartCount ? kName[number] : "unknown";
}

/// Parts that section `i` of the asset needs: 0 or one bit.
/// Pre: i < asset.section_count().
uint32_t part_of_section(const asset::Container& asset, uint32_t i);

/// All parts that an asset needs.
uint32_t needed_parts(const asset::Container& asset);

/// The verdict on an asset in a program with the parts `linked`: one of R909 to R918, at the
/// section that needs the missing part, or passed. Where a name is selected, others of its kind do
/// not count.
core::Verdict missing_part(const asset::Container& asset, const Selection& selection,
                           uint32_t linked);

}  // namespace firmtouch
