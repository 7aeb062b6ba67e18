#pragma once

namespace firmtouch::cli {

/// Part of an asset's provenance. Raised with every release.
constexpr const char* kToolVersion = "firmtouch 0.1.0";

}  // namespace firmtouch::cli
