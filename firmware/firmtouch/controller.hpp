#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/record/tick.hpp"

// DRAFT CONTRACT, to be filled in by whoever builds this room (see DESIGN.md): one composition among possible ones,
// under 200 lines. Its sizeof is the RAM report.
namespace firmtouch {

class Controller {
 public:
  /// Resolves names in the asset, opens views, checks the floating-point mode and runs the asset's probe queries.
  /// Motors stay off unless it passes.
  core::Verdict begin(core::Bytes asset);

  /// A function of the controller's state and `input` alone: calls no HAL, reads no clock.
  void tick(const record::TickInput& input, record::TickOutput& output);
};

}  // namespace firmtouch
