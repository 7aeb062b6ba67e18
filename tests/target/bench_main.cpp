// Instructions of closest-point queries: `bench POINTS.csv` on the emulator's command line. Queries
// the mesh of the board's asset (without a mesh: the curve, or the spline) at every row,
// warm-started by the row before. A row a query:
//     BUDGET INSTRUCTIONS STEPS SIGN EVALUATIONS     (BUDGET 0: unlimited; EVALUATIONS: points
//     evaluated of a spline)
// tools/bench/cortex-m7 runs it and adds up.
#include <stdint.h>

#include "emulator/semihosting.hpp"
#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "target/count.hpp"
#include "target/csv_points.hpp"
#include "target/scene_views.hpp"

using namespace firmtouch;  // NOLINT: a program of the tests

namespace {

constexpr uint32_t kBudgets[] = {1, 2, 4, 8, 16, 32, 64, 128};
constexpr uint32_t kBudgetedRows = 1000;  // per budget; they give the cost of a visit

template <class Closest>
uint32_t evaluations_of(const Closest&) {
  return 0;
}
uint32_t evaluations_of(const spline::Closest& closest) { return closest.evaluations; }

template <class Closest>
void print_row(uint32_t budget, uint32_t taken, const Closest& closest) {
  const query::Certificate& certificate = closest.certificate;
  target::print(budget, " ");
  target::print(taken, " ");
  target::print(certificate.steps, certificate.sign == 0  ? " 0 "
                                   : certificate.sign > 0 ? " 1 "
                                                          : " -1 ");
  target::print(evaluations_of(closest), "\n");
}

template <class View>
struct HintOf {
  using Hint = mesh::Hint;
};
template <>
struct HintOf<curve::View> {
  using Hint = curve::Hint;
};
template <>
struct HintOf<spline::View> {
  using Hint = spline::Hint;
};

template <class View>
bool run(const View& view, const char* path, query::Budget budget, uint32_t rows, bool warm) {
  target::CsvPoints points(path);
  typename HintOf<View>::Hint hint;
  const uint32_t empty = target::empty_work();
  math::Vec3 p_m;
  uint32_t row = 0;
  for (; row < rows && points.next(p_m); ++row) {
    if (!warm) hint = {};
    const uint32_t before = hal::clock_work();
    const auto closest = closest_point(view, p_m, budget, hint);
    const uint32_t work = hal::clock_work() - before - empty;
    print_row(budget.work == UINT32_MAX ? 0 : budget.work, target::instructions(work), closest);
  }
  return row > 0;
}

template <class View>
int run_all(const View& view, const char* path) {
  if (!run(view, path, query::kUnlimited, UINT32_MAX, true)) {
    hal::board_print("no rows x,y,z in the walk\n");
    return 1;
  }
  for (const uint32_t steps : kBudgets) run(view, path, {steps}, kBudgetedRows, false);
  return 0;
}

}  // namespace

int main() {
  hal::board_begin();
  const target::Views views = target::open_views(hal::board_asset());
  char line[512];
  if (!views.verdict.ok() ||
      !(views.mesh.is_open() || views.curve.is_open() || views.spline.is_open())) {
    hal::board_print("no mesh, curve or spline in the asset, or a rule rejects it\n");
    return 1;
  }
  constexpr uint32_t kWord = 6;  // "bench "
  if (!hal::semihosting_command_line(line, sizeof line)) return 2;
  if (views.mesh.is_open()) return run_all(views.mesh, line + kWord);
  return views.curve.is_open() ? run_all(views.curve, line + kWord)
                               : run_all(views.spline, line + kWord);
}
