#pragma once
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/scene/tool_layout.hpp"

namespace firmtouch::scene {

using StoredTool = core::Span<const SphereLayout>;

/// Proves a section of type kToolSection; `to` refers to its bytes if the verdict is passed, and is
/// empty if not. The element of a verdict is the sphere.
/// Bounds: about 400 instructions.
core::Verdict open(core::Bytes section, StoredTool& to);

}  // namespace firmtouch::scene
