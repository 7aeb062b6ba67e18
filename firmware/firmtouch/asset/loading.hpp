#pragma once
#include <stdint.h>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"

// What the loaders of all geometries share. A loader (loader.hpp) has this shape:
//
//     using State = core::OneOf<...>;      // of its proof, in the workspace that all loaders share
//     static const char* find(const asset::Container&, const char* wanted);
//         `wanted` where the asset has it; the first of its kind where `wanted` is null; else null
//     void close();                        // forgets its view
//     void begin<Trust>(const asset::Container&, const char* name, State&);
//     asset::Progress work<Trust>(State&, uint32_t units);
//         checks elements of at most `units` together, or one probe query; the view is open at the
//         end. Trust: asset::Proven or asset::Trusted
namespace firmtouch {

/// Reasons to refuse a sound asset on this controller (tools/FORMAT.md, section 5).
enum Rule : uint16_t {
  // The asset has no mesh and no spline surface of the selected name.
  kRuleNoSuchSurface = 901,
  // The asset has no sampled curve and no spline curve of the selected name.
  kRuleNoSuchGuide = 902,
  // The asset has neither a surface nor a curve.
  kRuleEmptyScene = 903,
  // This machine rounds, flushes denormals or contracts otherwise than the baker's.
  kRuleArithmetic = 904,
  // This machine answers the mesh's probes with other bits, or there are none or more than 256.
  kRuleMeshProbes = 905,
  // This machine answers the curve's probes with other bits, or there are none or more than 256.
  kRuleCurveProbes = 906,
  // This machine answers a spline model's probes with other bits, or there are none or more than
  // 256.
  kRuleSplineProbes = 907,
  // This machine answers the hull's probes with other bits, or there are none or more than 256.
  kRuleHullProbes = 908,
  // The asset needs part `mesh`, which is not linked into this program.
  kRuleNeedsMesh = 909,
  // The asset needs part `field`, which is not linked into this program.
  kRuleNeedsField = 910,
  // The asset needs part `hull`, which is not linked into this program.
  kRuleNeedsHull = 911,
  // The asset needs part `guide`, which is not linked into this program.
  kRuleNeedsGuide = 912,
  // The asset needs part `spline`, which is not linked into this program.
  kRuleNeedsSpline = 913,
  // The asset needs part `spline_guide`, which is not linked into this program.
  kRuleNeedsSplineGuide = 914,
  // The asset needs part `linkage`, which is not linked into this program.
  kRuleNeedsLinkage = 915,
  // The asset needs part `objects`, which is not linked into this program.
  kRuleNeedsObjects = 916,
  // The asset needs part `materials`, which is not linked into this program.
  kRuleNeedsMaterials = 917,
  // The asset needs part `tool`, which is not linked into this program.
  kRuleNeedsTool = 918,
};

namespace asset {

struct Progress {
  bool is_done = false;
  core::Verdict verdict;  // passed until done
};

/// Name of a section of this type: `wanted` where there is one, the first where `wanted` is null.
/// Result: null where there is none.
const char* find_name(const Container& asset, uint32_t type, const char* wanted);

}  // namespace asset
}  // namespace firmtouch
