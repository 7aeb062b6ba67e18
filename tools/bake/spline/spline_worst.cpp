#include "bake/spline/spline_worst.hpp"

#include <algorithm>
#include <vector>

#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/proof/leaf_shape.hpp"
#include "surface/point.hpp"
#include "surface/random.hpp"

namespace firmtouch::tools {
namespace {

constexpr uint32_t kAnywhere = 1500, kBetween = 1000, kMaxCentres = 1500;
constexpr uint32_t kLongWork = 300 * CountedQueries::kMaxWork;
constexpr size_t kLong = 32;  // queries that may take that
constexpr size_t kClimbers = 12;
constexpr int kHillClimbs = 120;

class Finder {
 public:
  explicit Finder(const spline::View& model) : model_(model) {}

  void query(const Point& p) {
    const math::Vec3 at_m = to_vec3(p);
    spline::Hint hint;
    const spline::Closest c = spline::closest_point(model_, at_m, counted_.budget(), hint);
    counted_.take(c, at_m);
    seen_.push_back({c.certificate.steps, c.evaluations, at_m, c.certificate.exact});
    if (!c.certificate.exact && stopped_.size() < kLong) stopped_.push_back(at_m);
  }

  void query_middle() {
    const spline::Head& head = model_.head();
    query((to_point({head.low_m[0], head.low_m[1], head.low_m[2]}) +
           to_point({head.high_m[0], head.high_m[1], head.high_m[2]})) *
          0.5);
  }

  void query_anywhere() {
    const spline::Head& head = model_.head();
    for (uint32_t i = 0; i < kAnywhere; ++i) {
      double at[3];
      for (size_t k = 0; k < 3; ++k) {
        const auto low = static_cast<double>(head.low_m[k]),
                   high = static_cast<double>(head.high_m[k]);
        // A flat model is queried in its plane: there its parts are nearest to one another.
        const double room = high - low > 1e-3 * extent_m() ? 0.25 * extent_m() : 0;
        at[k] = random_.between(low - room, high + room);
      }
      query({at[0], at[1], at[2]});
    }
  }

  void query_between() {
    const auto pieces = model_.pieces();
    for (uint32_t i = 0; i < kBetween; ++i)
      query((origin(random_.below(pieces.size())) + origin(random_.below(pieces.size()))) * 0.5);
  }

  // About the middles of leaves, along each of the two ways: x + n (x' . x') / (n . x'').
  void query_centres() {
    const uint32_t step = model_.leaf_count() / kMaxCentres + 1;
    for (uint32_t i = 0; i < model_.leaf_count(); i += step) {
      if (!model_.is_leaf(i)) continue;
      const spline::View::LeafIndex leaf = model_.index_of(i);
      const spline::Piece& piece = model_.pieces()[leaf.piece];
      spline::LeafShape shape;
      spline::derive(piece, model_.coefficients().data() + piece.coefficients,
                     spline::region_of(piece, leaf.index_u, leaf.index_v), shape);
      const Point u = to_point(shape.c[1]), uu = to_point(shape.c[2]) * 2;
      if (piece.degree_u < 2) continue;
      if (piece.degree_v < 2) {
        const double speed2 = dot(u, u);
        if (speed2 > 0) query_centre(shape, uu - u * (dot(uu, u) / speed2), speed2);
        continue;
      }
      const uint32_t row = shape.degree_u + 1;
      const Point v = to_point(shape.c[row]), vv = to_point(shape.c[2 * row]) * 2;
      const Point n = cross(u, v);
      const double size2 = dot(n, n);
      if (!(size2 > 0)) continue;
      query_centre(shape, n * (dot(uu, n) / size2), dot(u, u));
      query_centre(shape, n * (dot(vv, n) / size2), dot(v, v));
    }
  }

  void hill_climb() {
    sort();
    const std::vector<WorstQuery> starts(
        seen_.begin(),
        seen_.begin() + static_cast<std::ptrdiff_t>(std::min(kClimbers, seen_.size())));
    for (const WorstQuery& start : starts) {
      WorstQuery best = start;
      double size_m = 0.05 * extent_m();
      for (int i = 0; i < kHillClimbs; ++i) {
        seen_.clear();
        const Point at = to_point(best.at_m);
        query({at.x + size_m * random_.bell(), at.y + size_m * random_.bell(),
               at.z + (is_flat() ? 0 : size_m * random_.bell())});
        if (seen_[0].steps > best.steps)
          best = seen_[0];
        else
          size_m *= 0.93;
      }
    }
  }

  /// The most expensive of all, or `seen`, after those that were stopped have gone on.
  WorstQuery worst(const WorstQuery& seen) const {
    WorstQuery worst = counted_.worst().steps > seen.steps ? counted_.worst() : seen;
    for (const math::Vec3& at_m : stopped_) {
      spline::Hint hint;
      const spline::Closest c = spline::closest_point(model_, at_m, {kLongWork}, hint);
      if (c.certificate.steps > worst.steps)
        worst = {c.certificate.steps, c.evaluations, at_m, c.certificate.exact};
      if (!c.certificate.exact) break;  // others would say no more
    }
    return worst;
  }

 private:
  double extent_m() const { return static_cast<double>(model_.head().extent_m); }
  bool is_flat() const {
    const double thick_m =
        static_cast<double>(model_.head().high_m[2]) - static_cast<double>(model_.head().low_m[2]);
    return !(thick_m > 1e-3 * extent_m());
  }
  Point origin(uint32_t piece) const {
    const float(&o)[3] = model_.pieces()[piece].origin_m;
    return to_point({o[0], o[1], o[2]});
  }
  void query_centre(const spline::LeafShape& shape, const Point& bend, double speed2) {
    const double bend2 = dot(bend, bend);
    if (!(bend2 > 0)) return;
    const Point off = bend * (speed2 / bend2);
    if (length(off) < 2 * extent_m()) query(to_point(shape.middle_m) + off);
  }
  void sort() {
    std::stable_sort(seen_.begin(), seen_.end(),
                     [](const WorstQuery& a, const WorstQuery& b) { return a.steps > b.steps; });
  }

  const spline::View& model_;
  Random random_{7};
  std::vector<WorstQuery> seen_;
  CountedQueries counted_;
  std::vector<math::Vec3> stopped_;
};

}  // namespace

void CountedQueries::take(const spline::Closest& answer, math::Vec3 at_m) {
  const query::Certificate& certificate = answer.certificate;
  if (!certificate.exact) {
    ++unended_;
    ++unended_of_[answer.piece];
  }
  if (certificate.steps > worst_.steps)
    worst_ = {certificate.steps, answer.evaluations, at_m, certificate.exact};
}

WorstQuery find_worst(const spline::View& model, const WorstQuery& seen) {
  Finder finder(model);
  finder.query_middle();
  finder.query_anywhere();
  finder.query_between();
  finder.query_centres();
  finder.hill_climb();
  return finder.worst(seen);
}

double cortex_m7_instructions(bool is_surface, double steps, double evaluations) {
  const double nodes = steps - evaluations;
  return is_surface ? 400 + 2300 * evaluations + 350 * nodes : 650 + 350 * evaluations + 70 * nodes;
}

}  // namespace firmtouch::tools
