#include "curve/thin_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace firmtouch::tools {
namespace {

// What the judgement below may round, many times over.
constexpr double kRounding = 1e-12;

math::Vec3 stored(const Place& p) {
  return {static_cast<float>(p.x_m), static_cast<float>(p.y_m), static_cast<float>(p.z_m)};
}
Place place_of(math::Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
Place minus(const Place& a, const Place& b) {
  return {a.x_m - b.x_m, a.y_m - b.y_m, a.z_m - b.z_m};
}
double dot(const Place& a, const Place& b) { return a.x_m * b.x_m + a.y_m * b.y_m + a.z_m * b.z_m; }

double distance2_to_piece(const Place& p, const Place& from, const Place& along) {
  const Place v = minus(p, from);
  const double length2 = dot(along, along), progress = dot(v, along);
  const double t = progress > 0 ? (progress < length2 ? progress / length2 : 1) : 0;
  const Place rest{v.x_m - along.x_m * t, v.y_m - along.y_m * t, v.z_m - along.z_m * t};
  return dot(rest, rest);
}

class Thinning {
 public:
  Thinning(const std::vector<Place>& run, double max_m)
      : run_(run), max2_m2_(max_m * max_m * (1 - kRounding)) {}

  // Whether one piece stands for the places `from` to `to`; their greatest distance from it.
  bool fits(size_t from, size_t to, double& worst2_m2) const {
    const Place a = place_of(stored(run_[from])), b = place_of(stored(run_[to]));
    const Place along = minus(b, a);
    worst2_m2 = 0;
    for (size_t i = from; i <= to; ++i) {
      const double distance2_m2 = distance2_to_piece(run_[i], a, along);
      if (!(distance2_m2 <= max2_m2_)) return false;  // NaN too
      worst2_m2 = std::max(worst2_m2, distance2_m2);
    }
    return true;
  }

  // The last place of a long piece from `from` on: twice as far while that fits, then halved in on.
  size_t reach(size_t from, double& worst2_m2) const {
    const size_t last = run_.size() - 1;
    size_t good = from + 1, step = 1;
    double tried2_m2 = 0;
    if (!fits(from, good, worst2_m2)) return from;
    size_t bad = last + 1;
    while (good < last) {
      const size_t next = std::min(good + step, last);
      if (!fits(from, next, tried2_m2)) {
        bad = next;
        break;
      }
      good = next;
      worst2_m2 = tried2_m2;
      step *= 2;
    }
    while (bad - good > 1) {
      const size_t middle = good + (bad - good) / 2;
      if (fits(from, middle, tried2_m2)) {
        good = middle;
        worst2_m2 = tried2_m2;
      } else {
        bad = middle;
      }
    }
    return good;
  }

 private:
  const std::vector<Place>& run_;
  double max2_m2_;
};

}  // namespace

ThinnedRun thin_run(const std::vector<Place>& run, double max_m, const std::string& name) {
  ThinnedRun thinned;
  if (run.size() < 2) {
    thinned.points.problem = name + ": " + std::to_string(run.size()) +
                             " recorded places are no path; record a run of two at least";
    return thinned;
  }
  const Thinning thinning(run, max_m);
  double worst2_m2 = 0;
  size_t at = 0;
  thinned.points.samples_m.push_back(stored(run[0]));
  thinned.points.rows.push_back(0);
  while (at + 1 < run.size()) {
    double piece2_m2 = 0;
    const size_t next = thinning.reach(at, piece2_m2);
    if (next == at) {
      char text[200];
      std::snprintf(text, sizeof text,
                    ": a deviation of %g m is finer than float32 holds at record %zu; allow more",
                    max_m, at);
      thinned.points.problem = name + text;
      return thinned;
    }
    worst2_m2 = std::max(worst2_m2, piece2_m2);
    at = next;
    thinned.points.samples_m.push_back(stored(run[at]));
    thinned.points.rows.push_back(static_cast<uint32_t>(at));
  }
  thinned.max_deviation_m = std::sqrt(worst2_m2);
  mend_curve(thinned.points, name);
  return thinned;
}

}  // namespace firmtouch::tools
