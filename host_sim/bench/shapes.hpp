#pragma once
#include <string>
#include <vector>

#include "device/device_file.hpp"
#include "host_sim/plant/vec.hpp"
#include "surface/surface.hpp"

namespace firmtouch::host_sim {

/// A turn about an axis through the origin.
class Rotation {
 public:
  Rotation() = default;
  Rotation(Vec axis, double angle_rad);
  Vec turn(Vec a) const { return {dot(row_[0], a), dot(row_[1], a), dot(row_[2], a)}; }
  /// This turn, after `first`.
  Rotation after(const Rotation& first) const;
  Vec turn_back(Vec a) const { return row_[0] * a.x + row_[1] * a.y + row_[2] * a.z; }

 private:
  Vec row_[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
};

/// Closed solids whose contact has a closed form. Metres; z is up, and the tool comes from above.
struct Solid {
  std::vector<Vec> vertices;
  std::vector<tools::Face> faces;
};

/// A plate of 80 mm with its upper face at z = 0.
Solid plate(double thickness_m);
/// Floor z = 0 for x < 0, wall x = 0 above it.
Solid two_walls();
/// Floor z = 0, with an edge across it at x = 0, and a wall x = 40 mm at its end.
Solid floor_and_wall();
/// A cube without its octant of positive x, y, z: three walls at 0.
Solid three_walls();
/// A groove along y, 10 mm deep; the angle is between a flank and the vertical.
Solid groove(double half_angle_rad);
/// A ball of 320 flat faces, with its corners 20 mm from the origin.
Solid coarse_ball();
/// Two boxes, level at z = 0, with a slot along y between them.
Solid slot(double width_m);

tools::Surface surface_of(const Solid& solid, const Rotation& rotation);
/// Turned, and baked into an asset, with a linkage where one is given. Throws Refused where that
/// fails.
std::string asset_of(const Solid& solid, const Rotation& rotation,
                     const tools::LinkageDevice* linkage = nullptr);

/// The same of a guide through these points, and of a solid where one is given.
std::string guide_of(const std::vector<Vec>& points_m, const Rotation& rotation,
                     const tools::LinkageDevice* linkage = nullptr, const Solid* solid = nullptr);

}  // namespace firmtouch::host_sim
