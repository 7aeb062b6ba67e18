#include <vector>

#include "bake/asset/origin.hpp"
#include "bake/curve/curve_tree.hpp"
#include "cli/failure.hpp"
#include "cli/queries.hpp"
#include "cli/timing.hpp"
#include "firmtouch/curve/guided_point.hpp"
#include "firmtouch/curve/nearest_constraint.hpp"

namespace firmtouch::cli {
namespace {

constexpr uint32_t kUsualNearest =
    10;  // samples, the smaller of the two counts that were published

// Rows in order, each warm-started by the one before unless `cold`: by its place in the exact mode,
// and where changes of arc are penalised by its arc position.
class Answers {
 public:
  Answers(const curve::View& view, const Arguments& arguments)
      : view_(view),
        budget_(budget_of(arguments)),
        cold_(arguments.has("--cold")),
        options_(curve_options_of(arguments)),
        nearest_(options_.nearest) {
    penalty_.weight_m = options_.arc_penalty_m;
  }

  curve::Closest next(const float* row) {
    const math::Vec3 p_m{row[0], row[1], row[2]};
    if (cold_) {
      hint_ = curve::Hint{};
      penalty_.has_previous = false;
    }
    if (options_.is_exact)
      return kept(curve::guided_point(view_, p_m, penalty_, budget_, hint_).closest);
    const core::Span<curve::Neighbour> memory(nearest_.data(),
                                              static_cast<uint32_t>(nearest_.size()));
    return kept(curve::nearest_constraint(view_, p_m, penalty_, memory, budget_).closest);
  }

 private:
  curve::Closest kept(const curve::Closest& closest) {
    penalty_.previous_arc = closest.arc;
    penalty_.has_previous = true;
    return closest;
  }

  const curve::View& view_;
  query::Budget budget_;
  bool cold_;
  CurveOptions options_;
  std::vector<curve::Neighbour> nearest_;
  curve::ArcPenalty penalty_;
  curve::Hint hint_;
};

}  // namespace

CurveOptions curve_options_of(const Arguments& arguments) {
  CurveOptions options;
  options.is_exact = arguments.choice("--mode", "exact", {"exact", "nearest"}) == "exact";
  options.nearest = arguments.count("--n", kUsualNearest, 1, curve::kMaxNearest);
  options.arc_penalty_m = static_cast<float>(arguments.number("--arc-penalty", 0, 0));
  return options;
}

void query_curve(const LoadedCurve& given, tools::Point origin_m, CsvTable table,
                 const Arguments& arguments) {
  LoadedCurve curve = given;
  std::vector<uint32_t> tree;
  if (!curve_options_of(arguments).is_exact && curve.view.tree().empty()) {
    const core::Span<const curve::Sample> samples = curve.view.samples();
    tree = tools::build_curve_tree({samples.begin(), samples.end()});
    curve.sections.tree = {reinterpret_cast<const uint8_t*>(tree.data()),
                           static_cast<uint32_t>(tree.size() * sizeof(tree[0]))};
    if (!curve::open(curve.sections, curve.view).ok()) fail_input("the curve has no k-d tree");
  }
  const auto row_of = [&](const curve::Closest& a) {
    const tools::Point c_m = tools::in_file(tools::to_point(a.point_m), origin_m);
    return std::make_tuple(a.distance_m, c_m.x, c_m.y, c_m.z, curve.row_of(a.segment), a.arc,
                           a.certificate.lower_m, a.certificate.steps, a.certificate.exact);
  };
  answer_rows(
      table, arguments, {"distance", "cx", "cy", "cz", "segment", "arc", "lower", "steps", "exact"},
      [&] { return Answers(curve.view, arguments); }, row_of);
}

}  // namespace firmtouch::cli
