#include <algorithm>
#include <cstdio>

#include "bake/asset/probes.hpp"
#include "bake/asset/provenance.hpp"
#include "bake/asset/step_figures.hpp"
#include "bake/curve/bake_curve.hpp"
#include "cli/baked_input.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "curve/read_curve_csv.hpp"
#include "firmtouch/asset/layout.hpp"
#include "firmtouch/curve/closest_point.hpp"

namespace firmtouch::cli {
namespace {

tools::StepFigures steps_of(const curve::View& view, const std::vector<math::Vec3>& samples_m) {
  curve::Hint hint;
  return tools::measure_steps(
      view.head().low_m, view.head().high_m, tools::path_along(samples_m, view.head().diagonal_m),
      [&](math::Vec3 p_m, bool cold) {
        if (cold) hint = curve::Hint{};
        return curve::closest_point(view, p_m, query::kUnlimited, hint).certificate.steps;
      });
}

tools::Facts facts_of(const curve::View& view, const tools::CurveReport& report,
                      const tools::StepFigures& steps) {
  tools::Facts facts = {
      {"kind", view.is_closed() ? "closed curve" : "open curve"},
      {"pieces", view.is_smooth() ? "cubic" : "straight"},
      {"samples", std::to_string(report.samples)},
      {"levels", std::to_string(report.levels)},
      {"length_m", tools::number_text(static_cast<double>(view.head().length_m))}};
  add_steps(steps, facts);
  return facts;
}

// What the parameters workspace_half_x_m, _y_m and _z_m are where nobody sets them.
constexpr double kUsualWorkspace_m = 0.5;
constexpr double kMaxTurned = 1e-5;  // of the diagonal, at worst; usually a tenth of it

double reach_of(const curve::View& view, const tools::Point& origin_m) {
  const double origin[3] = {origin_m.x, origin_m.y, origin_m.z};
  double reach_m = 0;
  for (int k = 0; k < 3; ++k)
    reach_m = std::max({reach_m, -static_cast<double>(view.head().low_m[k]) - origin[k],
                        static_cast<double>(view.head().high_m[k]) + origin[k]});
  return reach_m;
}

}  // namespace

std::string sentence(const char* format, double a, double b) {
  char text[300];
  std::snprintf(text, sizeof(text), format, a, b);
  return text;
}

BakedInput bake_curve_input(const std::string& path, const BakeOptions& options,
                            Progress& progress) {
  progress.stage("reading and checking " + file_name_of(path), 0.25);
  const std::vector<uint8_t> source = read_model(path);
  const tools::CurvePoints points = tools::read_curve_csv_bytes(
      {reinterpret_cast<const char*>(source.data()), source.size()}, path,
      options.model.frame_for(path), {options.model.has_decimal_commas});
  if (!points.problem.empty()) fail_input(points.problem);
  return bake_points(points, path, stem_of(path), source, options, progress);
}

BakedInput bake_points(const tools::CurvePoints& given, const std::string& path,
                       const std::string& name, const std::vector<uint8_t>& source,
                       const BakeOptions& options, Progress& progress) {
  BakedInput baked;
  tools::CurvePoints points = given;
  points.is_smooth = options.smooth;
  points.with_tree = options.curve_tree;
  progress.stage("building the tree of " + name, 0.25);
  tools::CurveReport report;
  baked.sections = tools::bake_curve(points, name, report);
  if (!report.problem.empty()) fail_input(path + ": " + report.problem);
  curve::View view;
  const core::Verdict verdict = tools::open_baked(baked.sections, name, view);
  if (!verdict.ok()) fail_input(path + ": its curve breaks rule R" + std::to_string(verdict.rule));

  progress.stage("counting steps on " + name, 0.25);
  const tools::StepFigures steps = steps_of(view, points.samples_m);
  progress.stage("running the probes of " + name, 0.25);
  baked.sections.push_back(tools::curve_probes(view, name));
  baked.sections.push_back(
      tools::text_section(asset::kBoundsSection, name, facts_of(view, report, steps)));
  baked.sections.push_back(provenance_of(path, name, source, options.text));

  const uint64_t bytes = bytes_of(baked.sections);
  baked.report = {
      std::string(view.is_closed() ? "closed" : "open") +
          (view.is_smooth() ? " smooth curve, " : " curve, ") + std::to_string(report.samples) +
          sentence(" samples, %.4g m long, segments up to %.3g m", report.length_m,
                   report.longest_segment_m),
      std::to_string(bytes) + sentence(" bytes, %.1f a sample; tree of %.0f levels",
                                       static_cast<double>(bytes) / report.samples,
                                       static_cast<double>(report.levels)),
      "RAM " + std::to_string(sizeof(curve::Hint)) +
          " bytes a tool that it guides (curve::Hint), " + std::to_string(sizeof(curve::View)) +
          " for the view here; the asset stays in flash",
      sentence("steps at 2000 random points, each on its own: mean %.1f, worst seen %.0f",
               steps.random_mean, steps.random_worst),
      sentence("steps on a path of 2000 points beside it: mean %.1f, worst seen %.0f",
               steps.path_mean, steps.path_worst)};
  const double diagonal_m = static_cast<double>(view.head().diagonal_m);
  if (report.turned_m > kMaxTurned * diagonal_m)
    baked.report.push_back(
        "row " + std::to_string(report.turned_row + 1) +
        sentence(" is %.2g m from the next one, beside a piece of %.3g m: as float32 so short a "
                 "step turns, ",
                 report.turned_step_m, report.turned_piece_m) +
        sentence("and the smooth curve may lie up to %.2g m from that of the file, %.1g of its "
                 "diagonal; "
                 "leave one of them out",
                 report.turned_m, report.turned_m / diagonal_m));
  const double reach_m = reach_of(view, options.model.origin_m);
  if (reach_m > kUsualWorkspace_m)
    baked.report.push_back(
        sentence("reaches %.4g m from the origin, beyond the usual workspace of %.4g m along each "
                 "axis: where that is not meant, check --unit; else set workspace_half_x_m, _y_m, "
                 "_z_m and the guide's pose",
                 reach_m, kUsualWorkspace_m));
  for (const std::string& note : points.notes) baked.report.push_back("mended: " + note);
  return baked;
}

}  // namespace firmtouch::cli
