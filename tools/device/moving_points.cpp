#include "device/moving_points.hpp"

#include <cmath>

namespace firmtouch::tools {
namespace {

using device::Delta;
using device::FiveBar;
using device::SerialArm;

// The end of a link of `length_m` that joint `k` turns in the plane of `out` and `up`.
MovingPoint link_end(Point base_m, Point out, Point up, double length_m, uint32_t k,
                     const JointMotion& motion) {
  const double c = std::cos(motion.angle_rad[k]), s = std::sin(motion.angle_rad[k]);
  const double rate = motion.rate_rad_per_s[k];
  const Point along = (out * c + up * s) * length_m;
  MovingPoint end;
  end.first = k, end.end = k + 1;
  end.at_m = base_m + along;
  end.column_m[k] = (up * c - out * s) * length_m;
  end.velocity_mps = end.column_m[k] * rate;
  end.bias_mps2 = along * (-rate * rate);
  return end;
}

// Velocity and acceleration of a tip at fixed distances from the elbows: rod . (tip' - elbow') = 0
// and its derivative, by Cramer's rule. A planar linkage stays in its plane.
void close_motion(uint32_t joints, const JointMotion& motion, MovingPoints& points) {
  MovingPoint& tip = points.tip;
  tip.end = joints;
  Point rod[kJoints] = {{}, {}, {0, 0, 1}};
  double lengths2 = 1;
  for (uint32_t k = 0; k < joints; ++k) {
    rod[k] = tip.at_m - points.elbow[k].at_m;
    lengths2 *= dot(rod[k], rod[k]);
  }
  Point opposite[kJoints] = {cross(rod[1], rod[2]), cross(rod[2], rod[0]), cross(rod[0], rod[1])};
  const double volume = dot(rod[0], opposite[0]);
  points.span = std::fabs(volume) / std::sqrt(lengths2);
  for (Point& way : opposite) way = way * (1 / volume);
  for (uint32_t k = 0; k < joints; ++k) {
    tip.column_m[k] = opposite[k] * dot(rod[k], points.elbow[k].column_m[k]);
    tip.velocity_mps = tip.velocity_mps + tip.column_m[k] * motion.rate_rad_per_s[k];
  }
  for (uint32_t k = 0; k < joints; ++k) {
    const Point apart_mps = tip.velocity_mps - points.elbow[k].velocity_mps;
    tip.bias_mps2 = tip.bias_mps2 + opposite[k] * (dot(rod[k], points.elbow[k].bias_mps2) -
                                                   dot(apart_mps, apart_mps));
  }
}

MovingPoints points(const FiveBar& bar, const JointMotion& motion) {
  MovingPoints all;
  for (uint32_t k = 0; k < 2; ++k) {
    all.base[k].at_m = {(k == 0 ? -0.5 : 0.5) * wide(bar.base_m), 0, 0};
    all.elbow[k] =
        link_end(all.base[k].at_m, {1, 0, 0}, {0, 1, 0}, wide(bar.proximal_m[k]), k, motion);
  }
  const Point way = all.elbow[1].at_m - all.elbow[0].at_m;
  const double way2 = dot(way, way), first = wide(bar.distal_m[0]), second = wide(bar.distal_m[1]);
  const double along = 0.5 + 0.5 * (first * first - second * second) / way2;
  const double height2 = first * first / way2 - along * along;
  all.is_closed = height2 > 0;
  const double height = std::sqrt(std::fmax(height2, 0)) * (bar.is_tip_left ? 1 : -1);
  all.tip.at_m = all.elbow[0].at_m + way * along + Point{-way.y, way.x, 0} * height;
  if (all.is_closed) close_motion(2, motion, all);
  return all;
}

MovingPoints points(const Delta& delta, const JointMotion& motion) {
  constexpr double kSine = 0.86602540378443865;  // of 120 degrees
  constexpr Point kOut[] = {{1, 0, 0}, {-0.5, kSine, 0}, {-0.5, -kSine, 0}};
  MovingPoints all;
  const double out_m = wide(delta.base_radius_m) - wide(delta.platform_radius_m);
  for (uint32_t k = 0; k < 3; ++k) {
    const Point out = kOut[k], side{-out.y, out.x, 0};
    all.base[k].at_m = out * out_m + side * wide(delta.side_m);
    all.elbow[k] = link_end(all.base[k].at_m, out, {0, 0, 1}, wide(delta.upper_m[k]), k, motion);
  }
  const Point u = all.elbow[1].at_m - all.elbow[0].at_m, v = all.elbow[2].at_m - all.elbow[0].at_m;
  const Point normal = cross(u, v);
  const double normal2 = dot(normal, normal),
               first2 = wide(delta.lower_m[0]) * wide(delta.lower_m[0]);
  const double a = 0.5 * (first2 - wide(delta.lower_m[1]) * wide(delta.lower_m[1]) + dot(u, u));
  const double b = 0.5 * (first2 - wide(delta.lower_m[2]) * wide(delta.lower_m[2]) + dot(v, v));
  const Point flat = cross(v * a - u * b, normal) * (1 / normal2);
  const double lift2 = (first2 - dot(flat, flat)) / normal2;
  all.is_closed = lift2 > 0;
  all.tip.at_m = all.elbow[0].at_m + flat +
                 normal * (std::sqrt(std::fmax(lift2, 0)) * (delta.is_tip_above ? 1 : -1));
  if (all.is_closed) close_motion(3, motion, all);
  return all;
}

// A point of the arm's plane, `out` from the axis and `up`, moved by the joints of the plane; the
// turntable adds its own motion. `c`, `s`: of its angle.
MovingPoint turned(const MovingPoint& flat, double c, double s, double rate) {
  const auto turn = [&](Point a) { return Point{a.x * c, a.x * s, a.z}; };
  const Point across{-s, c, 0};
  MovingPoint point;
  point.end = flat.end > 0 ? flat.end : 1;
  point.at_m = turn(flat.at_m);
  for (uint32_t k = 1; k < kJoints; ++k) point.column_m[k] = turn(flat.column_m[k]);
  point.column_m[0] = across * flat.at_m.x;
  point.velocity_mps = turn(flat.velocity_mps) + point.column_m[0] * rate;
  // Centripetal and Coriolis terms of the turning plane.
  point.bias_mps2 = turn(flat.bias_mps2) + turn({-flat.at_m.x * rate * rate, 0, 0}) +
                    across * (2 * rate * flat.velocity_mps.x);
  return point;
}

MovingPoints points(const SerialArm& arm, const JointMotion& motion) {
  const bool is_planar = arm.joints == 2;
  const uint32_t shoulder = arm.joints - 2, elbow = shoulder + 1;
  const Point out{1, 0, 0}, up = is_planar ? Point{0, 1, 0} : Point{0, 0, 1};
  JointMotion of_links = motion;
  if (!arm.has_parallelogram) {  // the second link's own angle and rate
    of_links.angle_rad[elbow] += motion.angle_rad[shoulder];
    of_links.rate_rad_per_s[elbow] += motion.rate_rad_per_s[shoulder];
  }
  MovingPoint base;
  base.at_m = {wide(arm.offset_m), 0, wide(arm.height_m)};
  const MovingPoint first = link_end(base.at_m, out, up, wide(arm.link_m[0]), shoulder, motion);
  const MovingPoint second = link_end({}, out, up, wide(arm.link_m[1]), elbow, of_links);
  MovingPoint tip;
  tip.first = shoulder, tip.end = elbow + 1;
  tip.at_m = first.at_m + second.at_m;
  tip.velocity_mps = first.velocity_mps + second.velocity_mps;
  tip.bias_mps2 = first.bias_mps2 + second.bias_mps2;
  tip.column_m[shoulder] = first.column_m[shoulder];
  tip.column_m[elbow] = second.column_m[elbow];
  if (!arm.has_parallelogram)
    tip.column_m[shoulder] = tip.column_m[shoulder] + second.column_m[elbow];
  MovingPoints all;
  const double c = std::cos(motion.angle_rad[0]), s = std::sin(motion.angle_rad[0]);
  const double rate = motion.rate_rad_per_s[0];
  all.base[0] = is_planar ? base : turned(base, c, s, rate);
  all.elbow[0] = is_planar ? first : turned(first, c, s, rate);
  all.tip = is_planar ? tip : turned(tip, c, s, rate);
  return all;
}

}  // namespace

MovingPoints points_of(const LinkageDevice& device, const JointMotion& motion) {
  return std::visit([&](const auto& linkage) { return points(linkage, motion); }, device.linkage);
}

}  // namespace firmtouch::tools
