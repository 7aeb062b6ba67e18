#pragma once
#include <memory>
#include <string>
#include <vector>

#include "bench/bench.hpp"
#include "firmtouch/scene/proxy.hpp"
#include "surface/point.hpp"

namespace firmtouch::bench {

/// What the bench touches: a mesh, with a base hull or without, or spline surfaces.
class TouchSubject {
 public:
  std::string name;
  math::Vec3 low_m, high_m;
  float size_m = 0;                   // as the shape gives it
  float min_radius_m = 0;             // that a tool's is raised to
  double least_radius_m = 0;          // crossings of smaller tools have no oracle
  uint32_t ticks_between_places = 1;  // that are measured: more where the oracle is slow

  virtual ~TouchSubject() = default;
  /// Of a 0.15 m model at 1 kHz.
  double scale() const { return static_cast<double>(size_m) / 0.15; }
  /// Another tool: it has no hint.
  virtual void begin() = 0;
  virtual scene::Near near(math::Vec3 x_m, query::Budget budget, float needed_m) = 0;
  virtual float free_part(scene::Way, query::Budget, uint32_t&) const { return 0; }
  /// Whether the surface is between two places, by another way than near().
  virtual bool is_crossed(math::Vec3 a_m, math::Vec3 b_m) const = 0;
  /// Without sign, in double, by another way than near().
  virtual double distance_m(tools::Point p) const = 0;
};

/// The models of the options: files of splines by their ending, all others are meshes; the demo
/// part without any. Throws a Problem.
std::vector<std::unique_ptr<TouchSubject>> load_touch_subjects(const Options& options);

/// `mesh` with a base hull of at most `faces` faces. Pre: `mesh` is one of the above and a mesh.
std::unique_ptr<TouchSubject> with_base_hull(const TouchSubject& mesh, uint32_t faces);
bool is_mesh(const TouchSubject& subject);

}  // namespace firmtouch::bench
