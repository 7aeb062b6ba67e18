// A smooth guide of a recorded run: guide and run lie within the deviation of each other, both
// ways, against the pieces as they are baked.
#include "curve/smooth_run.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "curve/hard_curves.hpp"
#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/curve/cubic.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;
using tools::Place;

using Path = std::function<Place(double)>;  // for 0 to 1

// A hand along it that rests now and then and trembles; encoders of 10 um.
std::vector<Place> taught(const Path& path, uint32_t count) {
  std::mt19937 random(11);
  std::vector<Place> run;
  double k = 0, shake[3] = {};
  for (uint32_t i = 0; i < count; ++i) {
    if (i % 1000 < 900) k += 1.0 / count;
    const Place p = path(k);
    double at[3] = {p.x_m, p.y_m, p.z_m};
    for (int axis = 0; axis < 3; ++axis) {
      shake[axis] = 0.9 * shake[axis] + 2e-5 * (curve_test::uniform(random) - 0.5);
      at[axis] = std::round((at[axis] + shake[axis]) * 1e5) * 1e-5;
    }
    run.push_back({at[0], at[1], at[2]});
  }
  return run;
}

const Path kKnot = [](double k) {
  return Place{0.1 * std::cos(19 * k), 0.1 * std::sin(13 * k), 0.03 * std::sin(44 * k)};
};
// Straight on, with spikes that are a thirtieth of the way between them wide.
const Path kSpikes = [](double k) {
  const double way = 4 * k, part = way - std::floor(way);
  const double height = std::max(0.0, 1 - std::fabs(part - 0.5) * 30);
  return Place{0.3 * k, 0.01 * height, 0};
};
const Path kSquare = [](double k) {
  const double way = 4 * k, part = way - std::floor(way), edge = 0.1 * part;
  const Place corners[] = {{edge, 0, 0}, {0.1, edge, 0}, {0.1 - edge, 0.1, 0}, {0, 0.1 - edge, 0}};
  return corners[std::min(3, static_cast<int>(way))];
};

// From the stored pieces to the run, joined place to place.
double guide_to_run_m(const curve_test::Points& samples, bool is_closed,
                      const std::vector<Place>& run) {
  curve_test::Points places;
  for (const Place& p : run) places.push_back(curve_test::point(p.x_m, p.y_m, p.z_m));
  const curve_test::Baked joined(places);
  std::vector<curve::Sample> stored;
  for (const math::Vec3& s : samples) stored.push_back({s.x, s.y, s.z});
  const curve::Track track{stored.data(), static_cast<uint32_t>(stored.size()), is_closed};
  curve::Hint hint;
  double worst_m = 0;
  for (uint32_t piece = 0; piece + 1 < samples.size(); ++piece)
    for (int share = 0; share <= 60; ++share) {
      const math::Vec3 off = point_at(cubic_of(track, piece), static_cast<float>(share) / 60);
      const curve::Closest closest =
          curve::closest_point(joined.view, samples[piece] + off, query::kUnlimited, hint);
      worst_m = std::max(worst_m, double{closest.distance_m});
    }
  return worst_m;
}

// From the run, between its places too, to the guide as the firmware answers.
double run_to_guide_m(const std::vector<Place>& run, const curve_test::Baked& guide) {
  curve::Hint hint;
  double worst_m = 0;
  for (size_t i = 0; i + 1 < run.size(); ++i)
    for (const double share : {0.0, 0.5, 1.0}) {
      const Place &a = run[i], &b = run[i + 1];
      const math::Vec3 p =
          curve_test::point(a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m),
                            a.z_m + share * (b.z_m - a.z_m));
      worst_m = std::max(
          worst_m, double{curve::closest_point(guide.view, p, query::kUnlimited, hint).distance_m});
    }
  return worst_m;
}

}  // namespace

TEST(SmoothGuide_KeepsToItsRun) {
  for (const Path& path : {kKnot, kSpikes, kSquare})
    for (const double max_m : {2e-3, 1e-3, 1e-4, 3e-5}) {
      test::note("max_um", static_cast<int64_t>(max_m * 1e6));
      const std::vector<Place> run = taught(path, 32000);
      tools::ThinnedRun thinned = tools::thin_run(run, max_m, "run");
      const size_t before = thinned.points.samples_m.size();
      tools::refine_smooth_run(run, max_m, "run", thinned);
      CHECK(thinned.points.problem.empty());
      CHECK_EQ(thinned.points.rows.size(), thinned.points.samples_m.size());
      const curve_test::Baked guide(thinned.points.samples_m, true);
      CHECK(guide.report.problem.empty());
      CHECK_LE(guide_to_run_m(guide.samples, guide.view.is_closed(), run), max_m + 1e-7);
      CHECK_LE(run_to_guide_m(run, guide), max_m + 1e-7);
      CHECK_LE(thinned.max_deviation_m, max_m);
      CHECK_GE(guide.samples.size(), before);
      CHECK_LE(guide.samples.size(), run.size() / 10);  // thinned still
    }
}

// The cubic piece across a long step begins as the short one before it ends.
TEST(SmoothGuide_AcrossAStepBesideATurn_IsRefusedWithItsPlace) {
  const std::vector<Place> run = {{0, 0, 0}, {1e-4, 0, 0}, {2e-4, 0, 0}, {2e-4, 0.05, 0}};
  tools::ThinnedRun thinned = tools::thin_run(run, 1e-4, "run.ftl");
  tools::refine_smooth_run(run, 1e-4, "run.ftl", thinned);
  const std::string& problem = thinned.points.problem;
  CHECK(problem.find("run.ftl: at (0.0002, 0, 0 m) the run steps by 0.05 m") == 0);
  CHECK(problem.find("allow more, or leave out --smooth") != std::string::npos);
}
