#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/link/protocol.hpp"

namespace firmtouch::link {

/// Compares two identities.
/// Result: kRefused... bits of HelloReply, one per difference. If the protocol differs, only
/// kRefusedProtocol: the other fields may have another meaning.
uint32_t compare(const Identity& host, const Identity& controller);

/// Text of a rejected handshake: one line per reason, with both sides' values and the remedy; of
/// a rejected asset its rule, whose remedy tools/FORMAT.md has.
/// Pre: to.size() >= 1.
/// Bounds: O(to.size()); re-entrant.
/// Result: bytes written, without the terminating zero; truncated if `to` is too small; 0 for
/// refused == 0.
uint32_t explain(const Identity& host, const HelloReply& reply, core::Span<char> to);

}  // namespace firmtouch::link
