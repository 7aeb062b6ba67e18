#pragma once

// For .cpp files of this module alone.
namespace firmtouch::device {

// Outward directions of a delta's arms.
constexpr float kCosine[3] = {1.0f, -0.5f, -0.5f};
constexpr float kSine[3] = {0.0f, 0.866025404f, -0.866025404f};

}  // namespace firmtouch::device
