#pragma once
#include <stdexcept>

namespace firmtouch::tools {

/// Bad input. The message names file and place, what is wrong, and how to mend it.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace firmtouch::tools
