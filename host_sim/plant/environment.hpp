#pragma once
#include <vector>

#include "firmtouch/mesh/view.hpp"
#include "firmtouch/spline/view.hpp"
#include "host_sim/plant/spline_shape.hpp"
#include "host_sim/plant/vec.hpp"

namespace firmtouch {
class Controller;
}

namespace firmtouch::host_sim {

/// What lies around the hand, in the device's frame: it sees the surface and the guide as a person
/// would.
class World {
 public:
  World() = default;
  /// A mesh or spline surfaces that are open, or neither, and the corners of a guide, all about
  /// `origin_m`.
  World(const mesh::View& mesh, const spline::View& surface, std::vector<Vec> guide_m,
        Vec origin_m);

  struct Surface {
    Vec point_m, normal;
    double distance_m = 0;  // signed
  };
  bool has_surface() const { return mesh_.is_open() || surface_.is_open(); }
  bool has_mesh() const { return mesh_.is_open(); }
  Surface nearest(Vec from_m) const;

  bool has_guide() const { return guide_m_.size() > 1; }
  double guide_length_m() const { return arc_m_.empty() ? 0 : arc_m_.back(); }
  bool guide_is_closed() const { return closed_; }
  /// Point of the guide at `arc_m` from its start: past its end a closed guide goes round, an open
  /// one turns back.
  Vec guide_at(double arc_m) const;
  const std::vector<Vec>& guide_m() const { return guide_m_; }
  const mesh::View& mesh() const { return mesh_; }
  const spline::View& surface() const { return surface_; }
  /// Triangles over the spline surfaces, about the origin of their own; none of a mesh.
  const Shell& shell() const { return shell_; }
  /// The free side of spline surfaces is the one away from their normals (surface_turned).
  void turn(bool is_turned) { is_turned_ = is_turned; }
  Vec origin_m() const { return origin_m_; }

 private:
  mesh::View mesh_;
  spline::View surface_;
  Shell shell_;
  bool is_turned_ = false;
  Vec origin_m_;
  std::vector<Vec> guide_m_;
  std::vector<double> arc_m_;
  bool closed_ = false;
};

/// The surface and curve that a controller feels, moved to `origin_m`.
World world_of(const Controller& controller, Vec origin_m);

}  // namespace firmtouch::host_sim
