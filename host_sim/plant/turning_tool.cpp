#include "host_sim/plant/turning_tool.hpp"

namespace firmtouch::host_sim {

void TurningTool::take(const record::TickRecord& record) {
  if ((record.output.state & record::kStateCommandTaken) != 0)
    turn_.want(record.input.command - record::kCommandTurnTool, record.input.command_value);
  if ((record.input.flags & record::kFlagModelApart) == 0) turn_.advance(tick_period_s_);
}

Vec TurningTool::turn_rad() const {
  const math::Vec3 v = turn_.turn_rad;
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

Vec TurningTool::centre_m(const scene::SphereLayout& sphere, Vec handle_m) const {
  const auto along = [&](const math::Vec3& row) {
    return static_cast<double>(row.x) * static_cast<double>(sphere.at_m[0]) +
           static_cast<double>(row.y) * static_cast<double>(sphere.at_m[1]) +
           static_cast<double>(row.z) * static_cast<double>(sphere.at_m[2]);
  };
  const math::Vec3(&row)[3] = turn_.rotation.row;
  return handle_m + Vec{along(row[0]), along(row[1]), along(row[2])};
}

std::vector<PlacedSphere> TurningTool::placed(Vec handle_m) const {
  std::vector<PlacedSphere> all;
  for (const scene::SphereLayout& sphere : spheres_)
    all.push_back({centre_m(sphere, handle_m), static_cast<double>(sphere.radius_m)});
  return all;
}

Vec TurningTool::nearest_m(const record::TickOutput& out, Vec handle_m) const {
  const uint32_t number = out.state >> record::kStateObjectShift & 31u;
  return number == 0 || number > spheres_.size() ? handle_m
                                                 : centre_m(spheres_[number - 1], handle_m);
}

}  // namespace firmtouch::host_sim
