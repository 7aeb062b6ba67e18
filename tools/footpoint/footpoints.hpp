#pragma once
#include <vector>

#include "footpoint/border.hpp"
#include "footpoint/curve_system.hpp"
#include "footpoint/surface_system.hpp"
#include "spline/spline.hpp"

namespace firmtouch::tools {

enum class FootKind { kMin, kMax, kSaddle, kEnd };

/// "min", "max", "saddle" or "end"
const char* name_of(FootKind kind);

/// A point of a curve or surface where the direction to the query is normal to it, or an end: an
/// end or corner of a curve, a corner of a surface, or a point of a surface's border where the
/// direction is normal to the border.
struct Footpoint {
  FootKind kind = FootKind::kMin;
  double distance_m = 0;
  Point point_m;
  int piece = 0;
  double u = 0, v = 0;  // of the entity's own parameters; v = 0 on curves
};

/// All foot-points of a point, from scratch: no state, no budget. For listings, benches and
/// oracles; nothing of it runs on a controller.
/// Source: Seong, Johnson, Cohen, "A higher dimensional formulation for robust and interactive
/// distance queries", equations (1), (3) and (4), by subdivision of their Bernstein coefficients.
/// The ends, corners and borders that it leaves out are reported too.
class Footpoints {
 public:
  /// Pieces of a curve stand in the order of its parameter. `gap`: what rounding has left open
  /// between pieces that meet, of the extent.
  Footpoints(const std::vector<BezierCurve>& curves, const std::vector<BezierPatch>& patches,
             double gap = 1e-12);

  /// Sorted by distance. `is_complete` is cleared where whole lines are foot-points (about the
  /// centre of a circle or on the axis of a surface of revolution): then only some of them are
  /// reported.
  std::vector<Footpoint> all(Point p_m, bool& is_complete) const;

  const std::vector<CurveSystem>& curves() const { return curves_; }
  const std::vector<SurfaceSystem>& patches() const { return patches_; }
  /// The curve piece that goes on smoothly from piece `k`, or that it goes on from; kNone: an end.
  static constexpr size_t kNone = static_cast<size_t>(-1);
  size_t next_of(size_t k) const { return next_[k]; }
  size_t previous_of(size_t k) const { return follows_[k].piece; }
  /// The foot-points in one curve piece alone, joints with its neighbours apart.
  void roots_in(size_t k, Point p_m, std::vector<Root>& roots) const;
  const std::vector<Border>& borders() const { return borders_; }
  const std::vector<CurveSystem>& border_curves() const { return border_curves_; }
  const Neighbour& over(size_t patch, int side) const {
    return neighbours_[patch][static_cast<size_t>(side)];
  }
  const std::vector<Corner>& corners() const { return corners_; }
  double extent_m() const { return extent_m_; }
  /// Of the control points.
  Point low_m() const { return low_m_; }
  Point high_m() const { return high_m_; }

 private:
  // The piece that goes on smoothly from another, and by what that one's equation is to be
  // multiplied where they meet to have its value.
  struct Follows {
    bool is_smooth;
    size_t piece;
    double ratio;
  };
  void find_joints();
  void add_curves(Point p_m, std::vector<Footpoint>& found, bool& is_complete) const;
  // Where patches or borders meet smoothly, rounding parts them: near a centre of curvature
  // each may have a foot-point beyond its own end. There the joined shape has it.
  struct Vertex {
    Corner corner;
    struct PatchCorner {
      size_t patch;
      double u, v;  // local: 0 or 1
    };
    struct BorderEnd {
      size_t border;
      bool at_end;
    };
    std::vector<PatchCorner> patches;
    std::vector<BorderEnd> borders;
  };
  void find_vertices();
  void add_patches(Point p_m, std::vector<Footpoint>& found, bool& is_complete) const;
  void add_joints(Point p_m, std::vector<Footpoint>& found) const;
  void add_vertices(Point p_m, std::vector<Footpoint>& found) const;
  double rise_into(size_t patch, int side, double t, Point p_m) const;
  void add_unknown(const Footpoint& foot, std::vector<Footpoint>& found) const;
  void add_borders(Point p_m, std::vector<Footpoint>& found, bool& is_complete) const;

  std::vector<CurveSystem> curves_;
  std::vector<Follows> follows_;  // one a curve piece
  std::vector<size_t> next_;
  std::vector<SurfaceSystem> patches_;
  std::vector<std::array<Neighbour, 4>> neighbours_;
  std::vector<Border> borders_;
  std::vector<CurveSystem> border_curves_;
  std::vector<Joint> joints_;
  std::vector<CurveSystem> joint_curves_;
  std::vector<Vertex> vertices_;
  std::vector<Corner> corners_;
  double gap_ = 0, extent_m_ = 0;
  Point low_m_, high_m_;
};

}  // namespace firmtouch::tools
