#pragma once

namespace firmtouch::cli {

/// Raised with every release.
constexpr const char* kRelease = "0.1.0";
/// Part of an asset's provenance.
constexpr const char* kToolVersion = "firmtouch 0.1.0";

}  // namespace firmtouch::cli
