#include "curve/smooth_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kShare = 1e-3;        // of the deviation: what remains undecided counts as beyond
constexpr double kMaxStraight = 4096;  // straight pieces that stand for a cubic one
constexpr double kUnknown_m = -1;
constexpr double kMinApart_m = 0x1p-39;  // between samples, with room (curve::kMinSpacing_m)

using Line = std::vector<Point>;  // at least two points, joined one to the next

Point point_of(const Place& p) { return {p.x_m, p.y_m, p.z_m}; }

double to_segment_m(const Point& p, const Line& line, size_t i) {
  const Point along = line[i + 1] - line[i], v = p - line[i];
  const double length2 = dot(along, along);
  const double t = length2 > 0 ? std::clamp(dot(v, along) / length2, 0.0, 1.0) : 0.0;
  return length(v - along * t);
}

// Whether all of one line lies within a distance of another.
class Nearness {
 public:
  Nearness(const Line& to, double max_m) : to_(to), max_m_(max_m) {}

  bool holds(const Line& line) {
    near_ = 0;
    for (size_t i = 0; i + 1 < line.size(); ++i)
      if (!holds(line[i], line[i + 1])) return false;
    return true;
  }

  // The greatest distance of its points.
  double greatest_m(const Line& line) const {
    double greatest_m = 0;
    for (const Point& p : line) {
      double min_m = to_segment_m(p, to_, 0);
      for (size_t i = 1; i + 1 < to_.size(); ++i) min_m = std::min(min_m, to_segment_m(p, to_, i));
      greatest_m = std::max(greatest_m, min_m);
    }
    return greatest_m;
  }

 private:
  // The distance to one segment is convex, and that to the line changes by no more than the way.
  bool holds(const Point& a, const Point& b) {
    const Point middle = (a + b) * 0.5;
    const double half_m = length(b - a) / 2, off_m = distance_m(middle);
    if (!(off_m <= max_m_)) return false;
    if (off_m + half_m <= max_m_) return true;
    if (to_segment_m(a, to_, near_) <= max_m_ && to_segment_m(b, to_, near_) <= max_m_) return true;
    if (half_m < kShare * max_m_) return false;
    return holds(a, middle) && holds(middle, b);
  }

  // An upper bound, from the last segment on downhill; the distance itself where that is too far.
  double distance_m(const Point& p) {
    double min_m = to_segment_m(p, to_, near_);
    const auto is_nearer = [&](size_t next) {
      const double next_m = to_segment_m(p, to_, next);
      if (!(next_m < min_m)) return false;
      min_m = next_m;
      near_ = next;
      return true;
    };
    while (near_ + 2 < to_.size() && is_nearer(near_ + 1)) {
    }
    while (near_ > 0 && is_nearer(near_ - 1)) {
    }
    for (size_t i = 0; i + 1 < to_.size() && !(min_m <= max_m_); ++i) is_nearer(i);
    return min_m;
  }

  const Line& to_;
  double max_m_;
  size_t near_ = 0;
};

class Refinement {
 public:
  Refinement(const std::vector<Place>& run, double max_m, CurvePoints& points)
      : run_(run), max_m_(max_m), samples_(points.samples_m), rows_(points.rows) {
    off_m_.assign(samples_.size() - 1, kUnknown_m);
    const math::Vec3 &first = samples_.front(), &last = samples_.back();
    is_closed_ = samples_.size() > 2 && length(to_point(first) - to_point(last)) <= 0;
  }

  double worst_m() const { return *std::max_element(off_m_.begin(), off_m_.end()); }

  // Result: the number of pieces, or that of one that cannot be helped.
  size_t refine() {
    for (;;) {
      std::set<size_t> split;
      for (size_t k = 0; k < off_m_.size(); ++k) {
        if (off_m_[k] < 0) off_m_[k] = off_by_m(k);
        if (off_m_[k] >= 0) continue;
        // Of two places that follow each other the piece is straighter beside shorter ones.
        std::vector<size_t> parts = {k};
        if (place_in(k) == 0) parts = {before(k), after(k)};
        bool is_split = false;
        for (const size_t part : parts) {
          if (part >= off_m_.size() || place_in(part) == 0) continue;
          split.insert(part);
          is_split = true;
        }
        if (!is_split) return k;
      }
      if (split.empty()) return off_m_.size();
      for (auto k = split.rbegin(); k != split.rend(); ++k) add(*k);
    }
  }

 private:
  size_t before(size_t k) const {
    return k > 0 ? k - 1 : is_closed_ ? off_m_.size() - 1 : SIZE_MAX;
  }
  size_t after(size_t k) const { return k + 1 < off_m_.size() ? k + 1 : is_closed_ ? 0 : SIZE_MAX; }

  Point step_m(size_t k) const { return to_point(samples_[k + 1]) - to_point(samples_[k]); }

  // As curve::slope_at(), of the sample where piece `from` ends and piece `to` begins.
  Point slope(size_t from, size_t to) const {
    if (from == SIZE_MAX || to == SIZE_MAX) {
      const Point only = step_m(from == SIZE_MAX ? to : from);
      return only * (1 / length(only));
    }
    const Point a = step_m(from), b = step_m(to);
    const double before_m = length(a), after_m = length(b), whole_m = before_m + after_m;
    return a * (after_m / (before_m * whole_m)) + b * (before_m / (after_m * whole_m));
  }

  // The cubic piece as straight ones, which it leaves by no more than `off_m`.
  Line straightened(size_t k, double& off_m) const {
    const Point along = step_m(k), c0 = to_point(samples_[k]), c3 = to_point(samples_[k + 1]);
    const Point c1 = c0 + slope(before(k), k) * (length(along) / 3);
    const Point c2 = c3 - slope(k, after(k)) * (length(along) / 3);
    // The second derivative is at most 6 bend, and a chord of 1/n is left by 1/8 of it over n^2.
    const double bend = std::max(length(c0 - c1 * 2 + c2), length(c1 - c2 * 2 + c3));
    const double wanted = std::ceil(std::sqrt(0.75 * bend / (kShare * max_m_)));
    const double count = std::clamp(wanted, 1.0, kMaxStraight);
    off_m = 0.75 * bend / (count * count);
    Line line;
    for (double i = 0; i <= count; ++i) {
      const double t = i / count, u = 1 - t;
      line.push_back(c0 * (u * u * u) + c1 * (3 * u * u * t) + c2 * (3 * u * t * t) +
                     c3 * (t * t * t));
    }
    return line;
  }

  // How far its places are from piece `k`; negative: it or the run leaves the other.
  double off_by_m(size_t k) const {
    const size_t last = k + 1 < off_m_.size() ? rows_[k + 1] : run_.size() - 1;
    Line places;
    for (size_t i = rows_[k]; i <= last; ++i) places.push_back(point_of(run_[i]));
    double straightened_m = 0;
    const Line cubic = straightened(k, straightened_m);
    const double max_m = max_m_ - straightened_m;
    Nearness to_cubic(cubic, max_m);
    if (!Nearness(places, max_m).holds(cubic) || !to_cubic.holds(places)) return kUnknown_m;
    return to_cubic.greatest_m(places) + straightened_m;
  }

  // The place of piece `k` that is next to its middle and is neither of its ends; 0: none.
  size_t place_in(size_t k) const {
    const size_t low = rows_[k], high = rows_[k + 1], middle = low + (high - low) / 2;
    for (size_t i = 0; i <= (high - low) / 2 + 1; ++i)
      for (const size_t at : {middle + i, middle - i})
        if (at > low && at < high && is_apart(at, k) && is_apart(at, k + 1)) return at;
    return 0;
  }
  bool is_apart(size_t row, size_t sample) const {
    return length(to_point(to_vec3(point_of(run_[row]))) - to_point(samples_[sample])) >
           kMinApart_m;
  }

  void add(size_t k) {
    const size_t row = place_in(k);
    for (const size_t changed : {before(k), k, after(k)})
      if (changed < off_m_.size()) off_m_[changed] = kUnknown_m;
    const auto at = static_cast<std::ptrdiff_t>(k + 1);
    samples_.insert(samples_.begin() + at, to_vec3(point_of(run_[row])));
    rows_.insert(rows_.begin() + at, static_cast<uint32_t>(row));
    off_m_.insert(off_m_.begin() + at, kUnknown_m);
  }

  const std::vector<Place>& run_;
  double max_m_;
  std::vector<math::Vec3>& samples_;
  std::vector<uint32_t>& rows_;
  std::vector<double> off_m_;  // of each piece, as off_by_m() has it
  bool is_closed_;
};

}  // namespace

void refine_smooth_run(const std::vector<Place>& run, double max_m, const std::string& name,
                       ThinnedRun& thinned) {
  if (!thinned.points.problem.empty()) return;
  CurvePoints& points = thinned.points;
  Refinement refinement(run, max_m, points);
  const size_t bad = refinement.refine();
  thinned.max_deviation_m = refinement.worst_m();
  if (bad + 1 >= points.samples_m.size()) return;
  const math::Vec3 &a = points.samples_m[bad], &b = points.samples_m[bad + 1];
  char text[300];
  std::snprintf(text, sizeof text,
                ": at (%.6g, %.6g, %.6g m) the run steps by %.3g m beside a turn, and no smooth "
                "guide through its places keeps within %g m of it there; allow more, or leave out "
                "--smooth",
                static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z),
                length(to_point(b) - to_point(a)), max_m);
  points.problem = name + text;
}

}  // namespace firmtouch::tools
