#include "host_sim/commands/progress.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace firmtouch::host_sim {

std::function<void(double)> progress_bar(const std::string& what) {
  if (isatty(STDERR_FILENO) == 0) return {};
  return [what, shown = -1](double share) mutable {
    const int percent = static_cast<int>(std::lround(share * 100));
    if (percent == shown) return;
    shown = percent;
    const std::string bar(static_cast<size_t>(percent / 4), '#');
    std::fprintf(stderr, "\r%s [%-25s] %3d %%%s", what.c_str(), bar.c_str(), percent,
                 percent == 100 ? "\r\033[K" : "");
    std::fflush(stderr);
  };
}

}  // namespace firmtouch::host_sim
