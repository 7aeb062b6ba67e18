#pragma once
#include "firmtouch/asset/container.hpp"

namespace firmtouch::spline {

/// The first model of surfaces, or of curves with lengths, or `wanted` if it is one; null: there is
/// none. What the head says is not yet proven.
const char* find_kind(const asset::Container& asset, const char* wanted, bool is_surface);

}  // namespace firmtouch::spline
