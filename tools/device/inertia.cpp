#include "device/inertia.hpp"

#include "device/symmetric.hpp"

namespace firmtouch::tools {
namespace {

bool has_one_column(const MovingPoint& p) { return p.end == p.first + 1; }

// Moments of mass at two points of a linkage, both halves of the symmetric sum: on the diagonal and
// below it. Columns that are 0 change no bit: a base or an elbow of a loop has none or one. Over
// all others, because loops of a known length unroll.
void add_masses(double mass_kg, const MovingPoint& p, const MovingPoint& q,
                double (&to)[kJoints][kJoints]) {
  if (p.end == 0) return;
  if (has_one_column(p)) {
    const uint32_t k = p.first;
    for (uint32_t j = 0; j <= k; ++j) to[k][j] += mass_kg * dot(p.column_m[k], q.column_m[j]);
    for (uint32_t i = k; i < kJoints; ++i) to[i][k] += mass_kg * dot(q.column_m[i], p.column_m[k]);
    return;
  }
  for (uint32_t i = 0; i < kJoints; ++i)
    for (uint32_t j = 0; j <= i; ++j) {
      to[i][j] += mass_kg * dot(p.column_m[i], q.column_m[j]);
      to[i][j] += mass_kg * dot(q.column_m[i], p.column_m[j]);
    }
}

// The same of a mass at one point.
void add_mass(double mass_kg, const MovingPoint& p, double (&to)[kJoints][kJoints]) {
  if (p.end == 0) return;
  if (has_one_column(p)) {
    const uint32_t k = p.first;
    to[k][k] += mass_kg * dot(p.column_m[k], p.column_m[k]);
    return;
  }
  for (uint32_t i = 0; i < kJoints; ++i)
    for (uint32_t j = 0; j <= i; ++j) to[i][j] += mass_kg * dot(p.column_m[i], p.column_m[j]);
}

// The inverse of the largest eigenvalue of J inverse J^T.
double least_of(const LinkageDevice& device, const MovingPoint& tip,
                const double (&inverse)[kJoints][kJoints]) {
  Matrix ease(3, std::vector<double>(3, 0.0));
  for (uint32_t i = 0; i < device.joints.joints; ++i)
    for (uint32_t j = 0; j < device.joints.joints; ++j) {
      const Point a = tip.column_m[i], b = tip.column_m[j];
      const double by_i[] = {a.x, a.y, a.z}, by_j[] = {b.x, b.y, b.z};
      for (uint32_t row = 0; row < 3; ++row)
        for (uint32_t column = 0; column < 3; ++column)
          ease[row][column] += by_i[row] * inverse[i][j] * by_j[column];
    }
  return 1 / directions_of(ease).value[0];
}

}  // namespace

std::vector<RodMoments> moments_of(const LinkageDevice& device) {
  std::vector<RodMoments> moments;
  for (const Link& link : links_of(device)) {
    const Rod& rod = device.masses.rod[moments.size()];
    const double centre = rod.mass_kg * rod.centre_m / link.length_m;
    const double second = (rod.inertia_kg_m2 + rod.mass_kg * rod.centre_m * rod.centre_m) /
                          (link.length_m * link.length_m);
    moments.push_back({rod.mass_kg - 2 * centre + second, centre - second, second});
  }
  return moments;
}

void put_inertia(const LinkageDevice& device, const std::vector<RodMoments>& moments,
                 const MovingPoints& points, double (&mass)[kJoints][kJoints]) {
  for (auto& row : mass)
    for (double& each : row) each = 0;
  double at_tip_kg = device.masses.tip_mass_kg;
  const size_t half = moments.size() / 2;
  for (size_t k = 0; k < half; ++k) {
    const RodMoments &driven = moments[k], &outer = moments[half + k];
    const MovingPoint &base = points.base[k], &elbow = points.elbow[k];
    add_mass(driven.a, base, mass);
    add_masses(driven.b, base, elbow, mass);
    add_mass(driven.c + outer.a, elbow, mass);
    add_masses(outer.b, elbow, points.tip, mass);
    at_tip_kg += outer.c;
  }
  add_mass(at_tip_kg, points.tip, mass);
  for (uint32_t k = 0; k < kJoints; ++k) {
    const JointFriction& joint = device.masses.joint[k];
    if (k >= device.joints.joints)
      mass[k][k] = 1;
    else if (!(joint.cable_N_m_per_rad > 0))  // behind a cable the rotor moves by itself
      mass[k][k] += joint.rotor_kg_m2;
    for (uint32_t j = k + 1; j < kJoints; ++j) mass[k][j] = mass[j][k];
  }
}

bool invert(const double (&m)[kJoints][kJoints], double (&inverse)[kJoints][kJoints]) {
  const double a = m[1][1] * m[2][2] - m[2][1] * m[2][1];
  const double b = m[2][1] * m[2][0] - m[1][0] * m[2][2];
  const double c = m[1][0] * m[2][1] - m[1][1] * m[2][0];
  const double minor = m[0][0] * m[1][1] - m[1][0] * m[1][0];
  const double volume = m[0][0] * a + m[1][0] * b + m[2][0] * c;
  const double scale = 1 / volume;
  inverse[0][0] = a * scale;
  inverse[1][0] = inverse[0][1] = b * scale;
  inverse[2][0] = inverse[0][2] = c * scale;
  inverse[1][1] = (m[0][0] * m[2][2] - m[2][0] * m[2][0]) * scale;
  inverse[2][1] = inverse[1][2] = (m[1][0] * m[2][0] - m[0][0] * m[2][1]) * scale;
  inverse[2][2] = minor * scale;
  return m[0][0] > 0 && minor > 0 && volume > 0;
}

TipFigures tip_figures(const LinkageDevice& device, const JointMotion& at) {
  const MovingPoints points = points_of(device, at);
  double mass[kJoints][kJoints], inverse[kJoints][kJoints];
  put_inertia(device, moments_of(device), points, mass);
  TipFigures figures;
  if (!points.is_closed || !invert(mass, inverse)) return figures;
  figures.least_mass_kg = least_of(device, points.tip, inverse);
  double damping[kJoints][kJoints] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (uint32_t k = 0; k < device.joints.joints; ++k)
    damping[k][k] = device.masses.joint[k].viscous_N_m_s;
  if (invert(damping, inverse))
    figures.least_damping_N_s_per_m = least_of(device, points.tip, inverse);
  return figures;
}

namespace {

// 0 is not known, and never the least.
void lower(double& least, double value) {
  if (value > 0 && (!(least > 0) || value < least)) least = value;
}

}  // namespace

RangeFigures least_figures(const LinkageDevice& device) {
  const uint32_t joints = device.joints.joints, steps = joints == 3 ? 20 : 100;
  RangeFigures least;
  bool is_right = false, is_left = false;
  uint32_t at[kJoints] = {};  // counts through the grid
  while (at[joints - 1] <= steps) {
    float angle_rad[kJoints] = {};
    JointMotion motion;
    for (uint32_t k = 0; k < joints; ++k) {
      const device::JointSetting& joint = device.joints.joint[k];
      const double low = static_cast<double>(joint.low_rad);
      motion.angle_rad[k] = low + (static_cast<double>(joint.high_rad) - low) * at[k] / steps;
      angle_rad[k] = static_cast<float>(motion.angle_rad[k]);
    }
    const device::Pose pose = std::visit(
        [&](const auto& linkage) { return device::pose_of(linkage, angle_rad); }, device.linkage);
    ++least.poses;
    if (pose.is_reachable && pose.reciprocal_condition >= device.limits.full_from) {
      ++least.whole;
      const Point a = to_point(pose.column_m[0]), b = to_point(pose.column_m[1]);
      const Point c = joints == 2 ? Point{0, 0, 1} : to_point(pose.column_m[2]);
      const Point across{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
      (dot(across, c) > 0 ? is_left : is_right) = true;
      const TipFigures tip = tip_figures(device, motion);
      lower(least.least_mass_kg, tip.least_mass_kg);
      lower(least.least_damping_N_s_per_m, tip.least_damping_N_s_per_m);
    }
    for (uint32_t k = 0; k < joints && ++at[k] > steps && k + 1 < joints; ++k) at[k] = 0;
  }
  least.turns = is_right && is_left;
  return least;
}

}  // namespace firmtouch::tools
