#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/link/protocol.hpp"

namespace firmtouch::link {

/// Which of the values that must be the same differ, as kRefused... bits of HelloReply. Where the
/// protocol differs only that is told: the other fields may not mean the same.
uint32_t compare(const Identity& host, const Identity& controller);

/// The refusal in words, one line a reason, each with both sides' values and the remedy.
/// Pre: to.size() >= 1.
/// Bounds: O(to.size()); re-entrant.
/// Result: bytes written, the terminating zero not counted; cut off where it does not fit. Nothing
/// for refused == 0.
uint32_t explain(const Identity& host, const HelloReply& reply, core::Span<char> to);

}  // namespace firmtouch::link
