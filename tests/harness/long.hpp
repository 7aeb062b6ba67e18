#pragma once
#include <cstdlib>

namespace firmtouch::test {

/// Whether the full sizes are wanted (`tools/test --long`).
inline bool is_long() {
  const char* wanted = std::getenv("FIRMTOUCH_LONG");
  return wanted != nullptr && wanted[0] != 0;
}

}  // namespace firmtouch::test
