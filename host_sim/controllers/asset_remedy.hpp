#pragma once
#include <cstdint>
#include <string>

#include "firmtouch/link/protocol.hpp"

namespace firmtouch::host_sim {

/// What is wrong with an asset that rule `rule` (tools/FORMAT.md) rejects, and how to mend it:
/// "it needs part `field`, ...". Rule 0: of a file that is damaged.
std::string asset_remedy(uint32_t rule);

/// Why a controller rejected a session, with remedies: a line a reason.
std::string refusal_text(const link::Identity& host, const link::HelloReply& reply);

}  // namespace firmtouch::host_sim
