#pragma once
#include "firmtouch/version.hpp"

#define FIRMTOUCH_TEXT_OF(number) #number
#define FIRMTOUCH_TEXT(number) FIRMTOUCH_TEXT_OF(number)
#define FIRMTOUCH_RELEASE                 \
  FIRMTOUCH_TEXT(FIRMTOUCH_VERSION_MAJOR) \
  "." FIRMTOUCH_TEXT(FIRMTOUCH_VERSION_MINOR) "." FIRMTOUCH_TEXT(FIRMTOUCH_VERSION_PATCH)

namespace firmtouch::cli {

constexpr const char* kRelease = FIRMTOUCH_RELEASE;
/// Part of an asset's provenance.
constexpr const char* kToolVersion = "firmtouch " FIRMTOUCH_RELEASE;

}  // namespace firmtouch::cli
