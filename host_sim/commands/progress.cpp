#include "host_sim/commands/progress.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "host_sim/controllers/answer_time.hpp"

namespace firmtouch::host_sim {

cli::Option wait_option() {
  return {"--wait", "S", "how long the controller may take to answer (default: 60)"};
}

double wait_s(const cli::Arguments& options) { return options.number("--wait", kAnswer_s, 0.1); }

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
