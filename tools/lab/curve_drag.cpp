#include <algorithm>
#include <cmath>

#include "bench/curve_cases.hpp"
#include "firmtouch/scene/curve_guide.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "lab/trials.hpp"

namespace firmtouch::lab {
namespace {

constexpr double kLeg_m = 0.06, kSpacing_m = 0.0005, kAside_m = 0.003, kStep_m = 0.0001;
constexpr float kStiffness_N_per_m = 400.0f;
constexpr float kRelease_m = 0.03f;

struct Bend {
  const char* name;
  double cosine, sine;  // of the way back out
};

math::Vec3 at(double x, double y) { return {static_cast<float>(x), static_cast<float>(y), 0.0f}; }

// Along the x axis to the origin and out again.
std::vector<math::Vec3> samples_of(const Bend& bend) {
  std::vector<math::Vec3> samples;
  const int count = static_cast<int>(std::lround(kLeg_m / kSpacing_m));
  for (int i = -count; i <= count; ++i) {
    const double s = kSpacing_m * i;
    samples.push_back(i < 0 ? at(s, 0) : at(s * bend.cosine, s * bend.sine));
  }
  return samples;
}

// A hand that goes from one leg to the other, at the same distance from both, inside the corner.
std::vector<math::Vec3> inside(const Bend& bend) {
  // Where the two lines beside the legs meet: as far from the tip along either.
  const double from_tip_m = kAside_m * (1 - bend.cosine) / bend.sine;
  const double begin_m = from_tip_m + 0.02;
  std::vector<math::Vec3> points;
  for (double s = begin_m; s > from_tip_m; s -= kStep_m) points.push_back(at(-s, kAside_m));
  for (double s = from_tip_m; s < begin_m; s += kStep_m)
    points.push_back(
        at(s * bend.cosine - kAside_m * bend.sine, s * bend.sine + kAside_m * bend.cosine));
  return points;
}

struct Drag {
  double mean_N = 0, max_N = 0, max_jump_N = 0;
};

// The work that the hand does, over its way: it begins and ends at the same distance, so that a
// spring without friction takes none.
template <class Force>
Drag drag_of(const std::vector<math::Vec3>& points, Force force_N) {
  Drag drag;
  double work_J = 0, way_m = 0;
  math::Vec3 before = force_N(points[0]);
  for (size_t i = 1; i < points.size(); ++i) {
    const math::Vec3 now = force_N(points[i]);
    const double step[2] = {double{points[i].x} - double{points[i - 1].x},
                            double{points[i].y} - double{points[i - 1].y}};
    const double length_m = std::hypot(step[0], step[1]);
    if (!(length_m > 0)) continue;
    const double against_J = -(double{before.x} * step[0] + double{before.y} * step[1]);
    work_J += -(double{before.x} + double{now.x}) / 2 * step[0] -
              (double{before.y} + double{now.y}) / 2 * step[1];
    way_m += length_m;
    drag.max_N = std::max(drag.max_N, against_J / length_m);
    drag.max_jump_N = std::max(drag.max_jump_N, std::hypot(double{now.x} - double{before.x},
                                                           double{now.y} - double{before.y}));
    before = now;
  }
  drag.mean_N = work_J / way_m;
  return drag;
}

Drag guide_drag(const CurveCase& curve, const std::vector<math::Vec3>& points, float share) {
  scene::CurveGuide guide;
  guide.curve = &curve.view;
  guide.material = {kStiffness_N_per_m, 0.0f};
  guide.snap_m = guide.release_m = kRelease_m;
  guide.arc_penalty = share;
  scene::CurveGuideTouch touch;
  servo::LocalModel model;
  return drag_of(points, [&](math::Vec3 p_m) {
    scene::begin_model(model, p_m, 0, 1);
    follow_curve(guide, p_m, query::kUnlimited, touch, model);
    return servo::evaluate(model, p_m, {});
  });
}

// The published cost, here of all segments, not of those at the N nearest samples.
Drag published_drag(const CurveCase& curve, const std::vector<math::Vec3>& points, float weight_m) {
  curve::Hint hint;
  curve::ArcPenalty penalty{weight_m, 0.0f, false};
  return drag_of(points, [&](math::Vec3 p_m) {
    const curve::Constraint found = guided_point(curve.view, p_m, penalty, query::kUnlimited, hint);
    penalty.previous_arc = found.closest.arc;
    penalty.has_previous = true;
    const math::Vec3 c = found.closest.point_m;
    return math::Vec3{(c.x - p_m.x) * kStiffness_N_per_m, (c.y - p_m.y) * kStiffness_N_per_m, 0};
  });
}

std::string newtons(double value) { return number_text(std::abs(value) < 5e-4 ? 0 : value); }

}  // namespace

// The drag that a penalty on arc length makes at corners: published and ours.
void run_curve_drag(const Options&, Report& report) {
  const Bend corners[] = {{"corner of 90 degrees", 0.0, 1.0},
                          {"corner of 30 degrees", -0.8660254, 0.5},
                          {"turn of 10 degrees", 0.9848078, 0.1736482}};
  for (const Bend& bend : corners) {
    report.heading(std::string("drag at corners: ") + bend.name +
                   ", a hand 3 mm inside it, 400 N/m");
    const CurveCase curve = bake_case(samples_of(bend), bend.name);
    const std::vector<math::Vec3> points = inside(bend);
    std::vector<std::vector<std::string>> rows;
    for (const double share : {0.0, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0}) {
      const float weight_m = static_cast<float>(share) * curve.view.head().length_m;
      const Drag ours = guide_drag(curve, points, static_cast<float>(share));
      const Drag published = published_drag(curve, points, weight_m);
      rows.push_back({number_text(share), newtons(published.mean_N), newtons(published.max_N),
                      newtons(published.max_jump_N), newtons(ours.mean_N), newtons(ours.max_N),
                      newtons(ours.max_jump_N)});
    }
    report.table({"weight / length", "published: mean N", "most N", "most jump N", "ours: mean N",
                  "most N", "most jump N"},
                 rows);
  }
}

}  // namespace firmtouch::lab
