#include "bench/all_benches.hpp"
#include "bench/brute_truth.hpp"
#include "bench/problem.hpp"

namespace firmtouch::bench {
namespace {

constexpr size_t kQuick = 2000, kWhole = 100000;
constexpr double kErrorGoal = 4e-7;

void report_truth(const Model& model, const TruthReport& truth, Report& report) {
  const std::string& name = model.name;
  report.bar("worst error over max(diagonal, distance)", name, truth.worst_error, "", kErrorGoal);
  const auto none = [&](const char* what, size_t count, const std::string& remark) {
    report.bar(what, name, static_cast<double>(count), "", 0, remark);
  };
  none("lower bounds above the truth", truth.bounds_above_truth, "");
  none("answers not exact", truth.not_exact, "");
  if (!model.view.is_signed()) return;
  none("wrong signs", truth.wrong_sides,
       truth.wrong_places.empty() ? "" : "first " + truth.wrong_places[0]);
  none("unknown signs", truth.unknown_sides, "");
  report.figure("either side, at a crossing", name, static_cast<double>(truth.either_side), "",
                truth.either_places.empty() ? "" : "first " + truth.either_places[0]);
}

// Solids with their sides; what is none, distances only; what is no mesh is said to be.
void run_model(const std::string& path, size_t count, Report& report) {
  const auto measure = [&](const Model& model) {
    report_truth(model,
                 measure_truth(model, count, [&](const std::string& at) { report.stage(at); }),
                 report);
  };
  std::string why;
  try {
    return measure(load_model(path, Sides::kSigned));
  } catch (const Problem& problem) {
    why = problem.what();
  }
  try {
    const Model model = load_model(path, Sides::kUnsigned);
    report.absent("wrong signs", model.name, "no solid: " + why);
    measure(model);
  } catch (const Problem& problem) {
    report.absent("worst error over max(diagonal, distance)", path, problem.what());
  }
}

}  // namespace

// Distances and sides of 100,000 points a model (2,000 without --long) against brute force in
// double: every triangle, and the generalized winding number.
void run_truth(const Options& options, Report& report) {
  const size_t count = options.is_long ? kWhole : kQuick;
  report.heading(std::to_string(count) + " points a model against brute force in double");
  for (const std::string& path : options.models) run_model(path, count, report);
  if (!options.models.empty()) return;
  const Model part = demo_part();
  report_truth(part, measure_truth(part, count, [&](const std::string& at) { report.stage(at); }),
               report);
}

}  // namespace firmtouch::bench
