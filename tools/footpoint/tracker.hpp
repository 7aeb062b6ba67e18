#pragma once
#include <cstdint>
#include <vector>

#include "footpoint/critical_grid.hpp"
#include "footpoint/footpoints.hpp"

namespace firmtouch::tools {

/// How a foot-point is moved along before Newton takes over.
enum class Predictor {
  kFixedPoint,  // the solution's change for the point's whole motion
  kProjected    // as printed: the motion projected to the tangent plane of the solution space
};

struct TrackerOptions {
  Predictor predictor = Predictor::kFixedPoint;
  bool watches_ends = true;  // foot-points that leave or enter at ends and borders
  bool uses_grid = true;     // else every move is tested against every curve piece
};

struct TrackerCounts {
  uint64_t moves = 0, pruned = 0;        // pruned: no critical cell on the way
  uint64_t marches = 0, iterations = 0;  // of foot-points; Newton's steps among them
  uint64_t solves = 0, anomalies = 0;    // pieces solved anew; moves where a march failed
};

/// Foot-points of a moving point, carried along: predictor and Newton for each, pieces solved anew
/// where the way crosses a critical cell or an end's normal. It has state, and what it loses beside
/// a critical cell may stay lost: the published method for comparison, never what motors feel.
/// Source: Seong, Johnson, Cohen, sections 3.3, 3.4, 4.2 and 4.3.
class Tracker {
 public:
  Tracker(const Footpoints& feet, const CriticalGrid& grid, TrackerOptions options);

  /// From scratch.
  void start(Point p_m);
  /// Pre: start().
  void move(Point p_m);

  /// Foot-points that are carried: inner ones; ends, corners and borders apart.
  size_t count() const { return tracks_.size(); }
  /// The nearest of those, and of ends, corners and borders.
  double distance_m() const { return distance_m_; }
  Point nearest_m() const { return nearest_m_; }
  const TrackerCounts& counts() const { return counts_; }

 private:
  struct Track {
    uint32_t piece;  // curves first, patches after them
    double u, v;     // local
  };
  struct Gate {  // an end of a curve piece
    size_t piece;
    bool at_end;
    int sign;  // of equation (1) there
  };
  struct BorderState {
    int inward = 0, outward = 0;  // foot-points on it, by the side that the nearer surface lies on
    double u = 0, v = 0;          // of the last
  };
  Point place_of(const Track& track) const;
  int sign_at(const Gate& gate, Point p_m) const;
  bool march_curve(Track& track, Point p_m, bool& has_left);
  bool march_patch(Track& track, Point p_m, bool& has_left);
  bool cross_patch(Track& track, bool& has_left) const;
  void find_gate_events(Point p_m, std::vector<uint32_t>& pieces);
  void find_border_events(Point p_m, std::vector<uint32_t>& pieces);
  void find_critical(Point p_m, std::vector<uint32_t>& pieces);
  bool may_be_critical(size_t piece, Point p_m) const;
  bool joint_may_be_critical(size_t from, size_t to, Point p_m) const;
  void solve(std::vector<uint32_t>& pieces, Point p_m);
  void solve_all(Point p_m);
  bool has_doubles() const;
  void find_nearest(Point p_m);

  const Footpoints& feet_;
  const CriticalGrid& grid_;
  TrackerOptions options_;
  TrackerCounts counts_;
  Point at_;
  std::vector<Track> tracks_;
  std::vector<Gate> gates_;
  std::vector<BorderState> borders_;
  std::vector<size_t> cells_;
  double distance_m_ = 0, border_distance_m_ = 0;
  Point nearest_m_, border_nearest_m_;
};

}  // namespace firmtouch::tools
