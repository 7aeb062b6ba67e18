#pragma once
#include <functional>
#include <string>

#include "hull/collapse_queue.hpp"
#include "hull/placement.hpp"
#include "hull/progressive_hull.hpp"

namespace firmtouch::tools {

/// What the next collapse is chosen by. The first two are the paper's; the third has the first
/// one's key, but an edge whose surroundings have changed is looked at again only when its turn
/// comes.
enum class HullStrategy { kVolume, kCentre, kLazyVolume };

struct HullOptions {
  uint32_t target_faces = 2000;
  HullStrategy strategy = HullStrategy::kLazyVolume;
  HullLimits limits;
  uint32_t grid_bits = 22;
  QueueKind queue = QueueKind::kTree;
  std::function<void(uint32_t faces)> on_progress;  // every thousand collapses
};

struct HullReport {
  HullCounts counts;
  std::string stalled;  // empty: the target was reached; else at how many faces, where and why
};

/// Collapses edges until the target or until none may. Deterministic.
/// Pre: `surface` passed check_and_mend() as closed. Separate pieces coarsen each by itself.
/// Result: every hull of the sequence encloses the one before: each collapse adds tetrahedra whose
///         orientation is proven not negative, so no point's winding number falls.
/// Source: Platis & Theoharis 2003, "Progressive hulls for intersection applications", section 3.1.
ProgressiveHull build_hull(const Surface& surface, const HullOptions& options, HullReport& report);

}  // namespace firmtouch::tools
