#pragma once
// Curves that an inexact search gets wrong, and an oracle in double that tries every segment.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "bake/curve/bake_curve.hpp"
#include "firmtouch/curve/view.hpp"

namespace firmtouch::curve_test {

using Points = std::vector<math::Vec3>;

struct NamedCurve {
  std::string name;
  Points points;
};

/// A baked curve; the view reads the sections, so it does not move.
struct Baked {
  explicit Baked(const Points& points, bool is_smooth = false, uint32_t run_levels = 0) {
    tools::CurvePoints given;
    given.samples_m = points;
    given.is_smooth = is_smooth;
    given.run_levels = run_levels;
    given.with_tree = true;
    sections = tools::bake_curve(given, "curve", report);
    if (report.problem.empty() && !tools::open_baked(sections, "curve", view).ok())
      report.problem = "refused";
    for (uint32_t i = 0; view.is_open() && i < view.samples().size(); ++i)
      samples.push_back(view.sample(i));
  }
  Baked(const Baked&) = delete;

  std::vector<tools::Section> sections;
  tools::CurveReport report;
  curve::View view;
  Points samples;
};

struct NearestOnSegment {
  double distance, t;
};
inline NearestOnSegment nearest_on_segment(math::Vec3 p, math::Vec3 a, math::Vec3 b) {
  const double e[3] = {double{b.x} - double{a.x}, double{b.y} - double{a.y},
                       double{b.z} - double{a.z}};
  const double v[3] = {double{p.x} - double{a.x}, double{p.y} - double{a.y},
                       double{p.z} - double{a.z}};
  const double along = v[0] * e[0] + v[1] * e[1] + v[2] * e[2];
  const double t = std::clamp(along / (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]), 0.0, 1.0);
  return {std::hypot(v[0] - t * e[0], v[1] - t * e[1], v[2] - t * e[2]), t};
}

inline double brute_distance(const Points& samples, math::Vec3 p) {
  double least = HUGE_VAL;
  for (size_t i = 0; i + 1 < samples.size(); ++i)
    least = std::min(least, nearest_on_segment(p, samples[i], samples[i + 1]).distance);
  return least;
}

inline math::Vec3 point(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

inline double uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

// A knot that passes near itself, sampled with spacing that varies by `power` decades or so.
inline Points knot(uint32_t count, double power, uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<double> at;
  double sum = 0;
  for (uint32_t i = 0; i < count; ++i) {
    at.push_back(sum);
    sum += std::pow(uniform(random), power) + 1e-6;
  }
  Points points;
  for (const double s : at) {
    const double k = s / sum * 2 * 3.14159265358979, r = 0.1 * (1 + 0.4 * std::cos(7 * k));
    points.push_back(point(r * std::cos(3 * k), r * std::sin(2 * k), 0.03 * std::sin(7 * k)));
  }
  return points;
}

inline Points coil(uint32_t turns, uint32_t a_turn, double pitch_m) {
  Points points;
  for (uint32_t i = 0; i < turns * a_turn; ++i) {
    const double k = 2 * 3.14159265358979 * i / a_turn;
    points.push_back(point(0.05 * std::cos(k), 0.05 * std::sin(k), pitch_m * i / a_turn));
  }
  return points;
}

inline Points spread(uint32_t count, double size_m, double offset_m, uint32_t seed) {
  std::mt19937 random(seed);
  const auto next = [&] { return offset_m + size_m * uniform(random); };
  Points points;
  for (uint32_t i = 0; i < count; ++i) {
    const double x = next(), y = next(), z = next();
    points.push_back(point(x, y, z));
  }
  return points;
}

// Strands a millionth of their length apart, sampled ever more coarsely.
inline Points strands() {
  Points points;
  for (uint32_t strand = 0; strand < 12; ++strand) {
    const uint32_t steps = 400u >> strand;
    for (uint32_t i = 0; i <= steps; ++i) {
      const double along = steps == 0 ? 0 : double{1} * i / steps;
      points.push_back(point(strand % 2 == 0 ? along : 1 - along, 1e-6 * strand, 0));
    }
  }
  return points;
}

inline std::vector<NamedCurve> hard_curves() {
  std::vector<NamedCurve> curves;
  curves.push_back({"knot", knot(1000, 6, 1)});
  curves.push_back({"spacing by a million", knot(800, 12, 2)});
  curves.push_back({"coil", coil(40, 30, 0.0004)});
  curves.push_back({"strands", strands()});
  curves.push_back({"two samples", {{0.1f, 0.2f, 0.3f}, {-0.4f, 0.35f, 0.7f}}});
  curves.push_back({"anywhere", spread(300, 1.0, 0, 3)});
  curves.push_back({"far from the origin", spread(200, 0.01, 100.0, 4)});
  curves.push_back({"micrometres", spread(100, 4e-6, 0, 5)});
  Points closed = coil(1, 500, 0.0);
  closed.push_back(closed.front());
  curves.push_back({"closed", closed});
  Points line;
  for (uint32_t i = 0; i < 300; ++i) line.push_back(point(std::pow(1.05, i) * 1e-6, 0, 0));
  curves.push_back({"collinear", line});
  Points repeated = coil(2, 40, 0.01);
  repeated.insert(repeated.begin() + 7, 5, repeated[7]);
  repeated.push_back(repeated.back());
  curves.push_back({"repeated samples", repeated});
  Points big = spread(150, 1e8, -5e8, 6);
  curves.push_back({"a planet", big});
  return curves;
}

/// Queries about a curve: anywhere in twice its box, near it, on samples and middles, far.
inline Points queries(const Points& samples, uint32_t count, uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const math::Vec3& s : samples) {
    const double at[3] = {double{s.x}, double{s.y}, double{s.z}};
    for (int k = 0; k < 3; ++k)
      low[k] = std::min(low[k], at[k]), high[k] = std::max(high[k], at[k]);
  }
  const double size = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  Points found;
  for (uint32_t i = 0; i < count; ++i) {
    const math::Vec3 s = samples[random() % samples.size()];
    const double near = size * std::pow(10, -6 * uniform(random));
    if (i % 8 < 3) {
      double at[3];
      for (int k = 0; k < 3; ++k)
        at[k] = (low[k] + high[k]) / 2 + size * 2 * (uniform(random) - 0.5);
      found.push_back(point(at[0], at[1], at[2]));
    } else if (i % 8 < 6) {
      const double x = normal(random), y = normal(random), z = normal(random);
      found.push_back(
          point(double{s.x} + near * x, double{s.y} + near * y, double{s.z} + near * z));
    } else if (i % 8 == 6) {
      const math::Vec3 t = samples[random() % samples.size()];
      const double f = i % 16 == 6 ? 0 : 0.5;
      found.push_back(point(double{s.x} + f * (double{t.x} - double{s.x}),
                            double{s.y} + f * (double{t.y} - double{s.y}),
                            double{s.z} + f * (double{t.z} - double{s.z})));
    } else {
      const double far = size * std::pow(10, 6 * uniform(random));
      found.push_back(point(far * normal(random), far * normal(random), far * normal(random)));
    }
  }
  return found;
}

}  // namespace firmtouch::curve_test
