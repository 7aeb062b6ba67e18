#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "spline/spline.hpp"

namespace firmtouch::tools {

/// What is wrong with a spline: the text, and which knot, weight or point (from 0) it is about.
struct SplineDefect {
  std::string what;  // empty: nothing
  size_t index = 0;
};

constexpr int kMaxDegree = 5;

/// Whether `knots` suit a B-spline of `degree` with `points` control points. `which`: "knot", "u
/// knot", "v knot", for messages.
SplineDefect check_knots(const std::vector<double>& knots, int degree, size_t points,
                         const char* which);
/// Whether every weight is positive and every coordinate (metres) fits float32.
SplineDefect check_weights(const std::vector<ControlPoint>& points);
SplineDefect check_coordinates(const std::vector<ControlPoint>& points);

/// Takes what a reader finds, keeps the first problem and counts its like, so that the message says
/// how often.
class SplineSink {
 public:
  explicit SplineSink(const std::string& path) : path_(path) {}

  /// Reading cannot go on. Result: false.
  bool fail(const std::string& what);
  bool fail(uint64_t line, const std::string& what);
  /// The file is refused, but reading goes on, to count. `kind`: what its like have in common.
  /// Result: false.
  bool defect(uint64_t line, const std::string& kind, const std::string& what);
  void note(const std::string& what) { model_.notes.push_back(what); }
  bool failed() const { return !problem_.empty(); }

  /// Checked knots, weights and coordinates. Notes pieces without length and planar curves;
  /// rejects what has no length or no area at all.
  void add(SplineCurve curve, uint64_t line);
  void add(SplineSurface surface, uint64_t line);
  /// The model, or the problem with its count.
  SplineModel finish();

 private:
  void report_dropped(const std::string& where, size_t dropped, const char* what);

  std::string path_;
  SplineModel model_;
  int pieces_ = 0;
  std::string problem_, kind_;
  uint64_t times_ = 0, last_line_ = 0, others_ = 0;
};

// One a format: each takes the whole file and fills the sink, whose problem says what is wrong.
void read_iges(std::string_view bytes, double unit_m, SplineSink& sink);
void read_bpt(std::string_view text, double unit_m, SplineSink& sink);

}  // namespace firmtouch::tools
