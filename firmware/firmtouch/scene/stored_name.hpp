#pragma once
#include <stdint.h>

// Names in the tables of an asset that scene reads: 1 to 31 bytes without control characters, then
// zeros.
namespace firmtouch::scene {

constexpr uint32_t kNameBytes = 32;  // as of the asset's own names

bool is_name(const char (&name)[kNameBytes]);
bool is_same_name(const char (&a)[kNameBytes], const char (&b)[kNameBytes]);

}  // namespace firmtouch::scene
