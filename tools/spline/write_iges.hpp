#pragma once
#include <string>

#include "spline/spline.hpp"

namespace firmtouch::tools {

/// The curves (entity 126), then the surfaces (128), as an IGES 5.3 file in metres; every number in
/// as many digits as read it back to the bit.
std::string to_iges(const SplineModel& model);

}  // namespace firmtouch::tools
