#pragma once
#include <stdexcept>

namespace firmtouch::bench {

/// Why a bench cannot run: names the file or command, what is wrong and how to mend it.
struct Problem : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace firmtouch::bench
