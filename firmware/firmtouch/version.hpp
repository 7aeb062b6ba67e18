#pragma once
#include <stdint.h>

// The release. CMake reads it here. What is stable, and for how long: CHANGELOG.md.
#define FIRMTOUCH_VERSION_MAJOR 0
#define FIRMTOUCH_VERSION_MINOR 1
#define FIRMTOUCH_VERSION_PATCH 0

namespace firmtouch {

/// Greater for a later release: 10,000 majors + 100 minors + patches.
constexpr uint32_t kVersion =
    FIRMTOUCH_VERSION_MAJOR * 10000 + FIRMTOUCH_VERSION_MINOR * 100 + FIRMTOUCH_VERSION_PATCH;

}  // namespace firmtouch
