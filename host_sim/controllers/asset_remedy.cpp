#include "host_sim/controllers/asset_remedy.hpp"

#include "firmtouch/asset/loading.hpp"
#include "firmtouch/controller/needed_parts.hpp"
#include "firmtouch/device/rules.hpp"
#include "firmtouch/link/handshake.hpp"

namespace firmtouch::host_sim {

std::string asset_remedy(uint32_t rule) {
  const uint32_t part = rule - kRuleNeedsMesh;
  if (part < kPartCount)
    return std::string("it needs part `") + part_name(part) +
           "`, which the controller's program lacks; build the program with it (FIRMTOUCH_APP), "
           "and flash it";
  switch (rule) {
    case kRuleNoSuchSurface:
    case kRuleNoSuchGuide:
      return "it has nothing of the selected name; select one that `firmtouch info` lists";
    case kRuleEmptyScene:
      return "it has neither a surface nor a guide; bake one into it";
    case kRuleArithmetic:
      return "the processor's floating-point mode differs from what the library needs: round to "
             "nearest, keep denormals, no contraction; mend the program's start-up or its flags";
    case kRuleMeshProbes:
    case kRuleCurveProbes:
    case kRuleSplineProbes:
    case kRuleHullProbes:
      return "the program answers the asset's probe queries with other bits; build the program "
             "and `firmtouch` from the same release, and bake it again";
    case device::kRuleLinkageSize:
      return "its linkage has homing, index pulses or second encoders, and the program lacks their "
             "part (`firmtouch bake` prints the parts); build the program with it "
             "(FIRMTOUCH_APP), and flash it";
    default:
      return "it is damaged or of another release; bake it again";
  }
}

std::string refusal_text(const link::Identity& host, const link::HelloReply& reply) {
  char text[1200];
  const uint32_t count = link::explain(host, reply, core::Span<char>(text, sizeof text));
  std::string all(text, count);
  // With the same build id: a program without some parts lacks their parameters.
  if ((reply.refused & (link::kRefusedParameterTable | link::kRefusedBuild)) ==
      link::kRefusedParameterTable)
    all +=
        "parameters: the program lacks parts, and so parameters, that this simulator has; for "
        "lock-step build it with FIRMTOUCH_APP=all, or with `all` and further parts\n";
  if ((reply.refused & link::kRefusedAssetRejected) != 0)
    all += "asset: " + asset_remedy(reply.asset_rule) + "\n";
  return all;
}

}  // namespace firmtouch::host_sim
