// The bar of `firmtouch bake`: even, for the times that a mesh of 300,000 triangles took.
#include "cli/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <thread>

#include "harness/test.hpp"

namespace {

struct Stage {
  double share, seconds;
};

// The worst difference between bar and time, as shares of all; -1 if the bar falls or passes its
// end.
double unevenness(std::initializer_list<Stage> stages) {
  double all = 0, all_s = 0, done = 0, before_s = 0, last = 0, worst = 0;
  for (const Stage& stage : stages) all += stage.share, all_s += stage.seconds;
  for (const Stage& stage : stages) {
    for (double t = 0; t < stage.seconds; t += 0.1) {
      const double at = firmtouch::cli::bar_position(done, before_s, stage.share, t);
      if (at < last || at > done + stage.share) return -1;
      worst = std::max(worst, std::fabs(at / all - (before_s + t) / all_s));
      last = at;
    }
    done += stage.share;
    before_s += stage.seconds;
  }
  return worst;
}

// What standard error gets from a stage of 100 ms with a line every millisecond.
std::string lines_in_a_file(bool is_shown) {
  std::FILE* file = std::tmpfile();
  if (file == nullptr) return "no file";
  std::fflush(stderr);
  const int terminal = dup(STDERR_FILENO);
  dup2(fileno(file), STDERR_FILENO);
  {
    firmtouch::cli::Progress progress(1, is_shown, std::chrono::milliseconds(1));
    progress.stage("reading part.obj");
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  dup2(terminal, STDERR_FILENO);
  close(terminal);
  std::rewind(file);
  char text[4000];
  const size_t count = std::fread(text, 1, sizeof text, file);
  std::fclose(file);
  return {text, count};
}

}  // namespace

TEST(ProgressInAFile_HasLines) {
  const std::string text = lines_in_a_file(true);
  CHECK(text.find("s  reading part.obj\n") != text.npos);
  CHECK_EQ(text.find_first_of("\r\033"), text.npos);
  CHECK(lines_in_a_file(false).empty());
}

TEST(BarOfALargeMesh_MovesEvenly) {
  const double worst = unevenness({{0.3, 5.8}, {0.65, 12.6}, {0.03, 0.4}, {0.02, 0.2}});
  CHECK(worst >= 0);
  CHECK_LT(worst, 0.1);
}

TEST(BarWhoseSharesAreWrong_StaysInItsStages) {
  CHECK(unevenness({{0.9, 1}, {0.1, 30}}) >= 0);
  CHECK(unevenness({{0.1, 30}, {0.9, 1}}) >= 0);
  CHECK(unevenness({{0.5, 0}, {0.5, 3}}) >= 0);
}
