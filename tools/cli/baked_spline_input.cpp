#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bake/asset/probes.hpp"
#include "bake/asset/provenance.hpp"
#include "bake/asset/step_figures.hpp"
#include "bake/spline/spline_choice.hpp"
#include "bake/spline/spline_guide.hpp"
#include "bake/spline/spline_pole.hpp"
#include "bake/spline/spline_worst.hpp"
#include "cli/baked_input.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "firmtouch/asset/layout.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "spline/orientation.hpp"
#include "spline/read_spline.hpp"

namespace firmtouch::cli {
namespace {

// Along the entities in turn; of a surface along a line that winds across each.
std::vector<math::Vec3> polyline_of(const tools::SplineModel& model) {
  std::vector<math::Vec3> line;
  const auto part = [](double low, double high, double at) { return low + (high - low) * at; };
  for (const tools::SplineCurve& curve : model.curves)
    for (int i = 0; i <= 64; ++i)
      line.push_back(tools::to_vec3(tools::point_at(curve, part(curve.t0, curve.t1, i / 64.0))));
  for (const tools::SplineSurface& s : model.surfaces)
    for (int i = 0; i <= 64; ++i) {
      const double across = i % 16 < 8 ? i % 8 / 8.0 : 1 - i % 8 / 8.0;
      line.push_back(
          tools::to_vec3(tools::point_at(s, part(s.u0, s.u1, across), part(s.v0, s.v1, i / 64.0))));
    }
  return line;
}

tools::StepFigures steps_of(const spline::View& view, const tools::SplineModel& model,
                            tools::CountedQueries& counted) {
  spline::Hint hint;
  return tools::measure_steps(
      view.head().low_m, view.head().high_m,
      tools::path_along(polyline_of(model), view.head().extent_m), [&](math::Vec3 p_m, bool cold) {
        if (cold) hint = spline::Hint{};
        const spline::Closest c = spline::closest_point(view, p_m, counted.budget(), hint);
        counted.take(c, p_m);
        return c.certificate.steps;
      });
}

void place(tools::SplineModel& model, const tools::FileFrame& frame) {
  const auto place_all = [&](std::vector<tools::ControlPoint>& points) {
    for (tools::ControlPoint& p : points) {
      const tools::Point at = frame.placed({p.x, p.y, p.z});
      p = {at.x, at.y, at.z, p.w};
    }
  };
  for (tools::SplineCurve& curve : model.curves) place_all(curve.points);
  for (tools::SplineSurface& surface : model.surfaces) place_all(surface.points);
}

std::string kind_of(const tools::SplineReport& report) {
  const std::string rational = report.is_rational ? "rational " : "";
  if (report.is_surface) return rational + "spline surface";
  return rational + (report.is_planar ? "planar" : "space") + " spline curve";
}

tools::Facts facts_of(const tools::SplineReport& report, const tools::StepFigures& steps,
                      const tools::WorstQuery& worst, const tools::SplineGuideReport& guide) {
  tools::Facts facts = {{"kind", kind_of(report)},
                        {"entities", std::to_string(report.entities)},
                        {"pieces", std::to_string(report.pieces)},
                        {"leaves", std::to_string(report.leaves)},
                        {"levels", std::to_string(report.levels)},
                        {"extent_m", tools::number_text(report.extent_m)},
                        {"loss_m", tools::number_text(report.loss_m)},
                        {"deviation_m", tools::number_text(report.deviation_m)}};
  add_steps(steps, facts);
  facts.push_back({"steps_worst_found", std::to_string(worst.steps)});
  facts.push_back({"evaluations_worst_found", std::to_string(worst.evaluations)});
  if (guide.is_guide) {
    facts.push_back({"length_m", tools::number_text(guide.length_m)});
    facts.push_back({"chains", std::to_string(guide.chains)});
    facts.push_back({"arc_error", tools::number_text(guide.arc_error)});
  }
  return facts;
}

std::string text_of(const tools::SplineGuideReport& guide) {
  if (!guide.is_guide) return "no guide: its lengths could not be proven";
  char text[200];
  std::snprintf(text, sizeof(text),
                "as a guide: %.4g m long, %u %s (%u closed), arc positions within %.1g of the "
                "length, %llu bytes more",
                guide.length_m, guide.chains, guide.chains == 1 ? "chain" : "chains",
                guide.closed_chains, guide.arc_error, static_cast<unsigned long long>(guide.bytes));
  return text;
}

// Fewer may lie on a set of equally near points by chance.
constexpr uint32_t kFewUnended = 3;

// By their names in the file, the entities beside which most queries were stopped.
std::string text_of_unended(const tools::CountedQueries& counted, const tools::SplineModel& model) {
  std::vector<std::pair<uint32_t, std::string>> worst;  // queries, and whose
  for (const tools::SplineSurface& surface : model.surfaces) {
    const auto found = counted.unended_of().find(static_cast<uint32_t>(surface.piece));
    if (found != counted.unended_of().end()) worst.emplace_back(found->second, surface.where);
  }
  for (const tools::SplineCurve& curve : model.curves) {
    const auto found = counted.unended_of().find(static_cast<uint32_t>(curve.piece));
    if (found != counted.unended_of().end()) worst.emplace_back(found->second, curve.where);
  }
  std::stable_sort(worst.begin(), worst.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  constexpr size_t kNamed = 3;
  std::string text = std::to_string(counted.unended()) + " of " +
                     std::to_string(2 * tools::kFigureQueries) + " queries were not exact after " +
                     std::to_string(tools::CountedQueries::kMaxWork) +
                     " units of work, nearest to ";
  for (size_t i = 0; i < std::min(worst.size(), kNamed); ++i)
    text += (i == 0 ? "" : ", ") + worst[i].second;
  if (worst.size() > kNamed) text += " and " + std::to_string(worst.size() - kNamed) + " more";
  return text + ": it is folded on itself, or has hardly any area; rebuild or remove it";
}

// The first poles; empty: there is none.
std::string text_of_poles(const spline::View& view) {
  constexpr size_t kShown = 3;
  const std::vector<tools::Point> poles = tools::poles_of(view);
  if (poles.empty()) return "";
  const double least_m = 1e-6 * static_cast<double>(view.head().extent_m);
  const auto rounded = [&](double x_m) { return std::abs(x_m) < least_m ? 0.0 : x_m; };
  std::string text = poles.size() == 1 ? "a pole at" : std::to_string(poles.size()) + " poles, at";
  for (size_t i = 0; i < std::min(poles.size(), kShown); ++i) {
    char at[100];
    std::snprintf(at, sizeof(at), "%s %.4g %.4g %.4g m", i == 0 ? "" : ",", rounded(poles[i].x),
                  rounded(poles[i].y), rounded(poles[i].z));
    text += at;
  }
  return text + (poles.size() > kShown ? ", ..." : "") +
         ": contact right above may need mesh_work " + std::to_string(tools::kPoleWork) +
         ", more than a controller does in 1 ms; `firmtouch-sim scenario` writes it";
}

std::string ram_of(bool is_surface) {
  return is_surface
             ? std::to_string(sizeof(spline::Hint)) + " bytes a tool that touches it (spline::Hint)"
             : std::to_string(sizeof(spline::CurveHint)) +
                   " bytes a tool that it guides (spline::CurveHint)";
}

}  // namespace

BakedInput bake_spline_input(const std::string& path, const BakeOptions& options,
                             Progress& progress) {
  const std::string name = stem_of(path);
  BakedInput baked;
  progress.stage("reading and checking " + file_name_of(path), 0.25);
  const std::vector<uint8_t> source = read_model(path);
  const tools::FileFrame frame = options.model.frame_for(path);
  tools::SplineModel model =
      tools::read_spline_bytes({reinterpret_cast<const char*>(source.data()), source.size()}, path,
                               frame.has_unit ? frame.unit_m : 0);
  if (!model.problem.empty()) fail_input(model.problem);
  place(model, frame);
  tools::orient(model);

  progress.stage("building the tree of " + name, 0.25);
  tools::SplineReport report;
  baked.sections = tools::bake_fast_spline(model, name, options.purpose == Purpose::kSmall, report);
  if (!report.problem.empty()) fail_input(path + ": " + report.problem);
  spline::View view;
  const core::Verdict verdict = tools::open_baked(baked.sections, name, view);
  if (!verdict.ok()) fail_input(path + ": its spline breaks rule R" + std::to_string(verdict.rule));

  tools::SplineGuideReport guide;
  for (tools::Section& section : tools::bake_spline_guide(view, name, guide))
    baked.sections.push_back(std::move(section));

  progress.stage("counting steps on " + name, 0.25);
  tools::CountedQueries counted;
  const tools::StepFigures steps = steps_of(view, model, counted);
  const tools::WorstQuery worst = tools::find_worst(view, counted.worst());
  tools::set_worst_steps(baked.sections, name, worst.steps);
  const double instructions =
      tools::cortex_m7_instructions(report.is_surface, worst.steps, worst.evaluations);
  progress.stage("running the probes of " + name, 0.25);
  baked.sections.push_back(tools::spline_probes(view, name));
  baked.sections.push_back(
      tools::text_section(asset::kBoundsSection, name, facts_of(report, steps, worst, guide)));
  baked.sections.push_back(provenance_of(path, name, source, options.text));

  // Of queries that were stopped the steps are those until then.
  const std::string stopped = counted.unended() == 0 ? "" : " or more";
  baked.report = {
      kind_of(report) + ", " + std::to_string(report.entities) +
          (report.entities == 1 ? " entity" : " entities") +
          sentence(", extent %.4g m; %.0f pieces", report.extent_m, report.pieces) +
          sentence(" in %.0f parts, a tree of %.0f levels", report.leaves, report.levels),
      std::to_string(report.bytes) + " bytes that a tick reads, " +
          std::to_string(bytes_of(baked.sections)) + " in all",
      sentence("distances good to %.2g m, the stored shape to %.2g m", report.loss_m,
               report.deviation_m),
      "RAM " + ram_of(report.is_surface) + ", " + std::to_string(sizeof(spline::View)) +
          " for the view here; the asset stays in flash",
      sentence("steps at 2000 random points, each on its own: mean %.1f, worst seen %.0f",
               steps.random_mean, steps.random_worst) +
          stopped,
      sentence("steps on a path of 2000 points beside it: mean %.1f, worst seen %.0f",
               steps.path_mean, steps.path_worst) +
          stopped,
      std::string("worst query seen: ") + (worst.has_ended ? "" : "at least ") +
          sentence("%.0f steps, %.0f of them evaluations", worst.steps, worst.evaluations) +
          sentence(", about %.0f instructions on a Cortex-M7, %.0f a step", instructions,
                   instructions / worst.steps)};
  if (!report.is_surface) baked.report.push_back(text_of(guide));
  const std::string poles = text_of_poles(view);
  if (!poles.empty()) baked.report.push_back(poles);
  for (const std::string& note : model.notes) baked.report.push_back(note);
  if (counted.unended() >= kFewUnended)
    baked.report.push_back("warning: " + text_of_unended(counted, model));
  return baked;
}

}  // namespace firmtouch::cli
