// What pictures show of a linkage: its links are as long as its file says and end at the tip, and
// the condition is that of differences of the tip, by singular values.
#include "host_sim/device/drawn_links.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "device/machines.hpp"
#include "harness/test.hpp"
#include "host_sim/report/condition_map.hpp"
#include "host_sim/report/run_charts.hpp"
#include "host_sim/report/scene3d.hpp"

using namespace firmtouch;  // NOLINT: a test file
using host_sim::JointMotion;
using host_sim::joints_m;
using host_sim::norm;
using host_sim::TipFollower;
using host_sim::Vec;
using tools::LinkageDevice;

namespace {

LinkageDevice machine(const std::string& name) {
  return tools::read_device(name, tools::machine_text(name));
}

// A closed path through the ranges of the joints that leaves out a tenth of each at their ends.
JointMotion pose(const LinkageDevice& device, double turn) {
  JointMotion at;
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const double low = static_cast<double>(device.joints.joint[k].low_rad);
    const double high = static_cast<double>(device.joints.joint[k].high_rad);
    at.angle_rad[k] = low + (high - low) * (0.5 + 0.4 * std::sin((k + 1) * turn + k));
  }
  return at;
}

host_sim::RunTick tick_at(const LinkageDevice& device, const JointMotion& at, uint32_t number) {
  host_sim::RunTick tick;
  tick.joints = at;
  tick.device_m = points_of(device, at).tip.at_m;
  tick.record.input.tick = number;
  const double p[] = {tick.device_m.x, tick.device_m.y, tick.device_m.z};
  for (int k = 0; k < 3; ++k) tick.record.output.position_m[k] = static_cast<float>(p[k]);
  return tick;
}

// Largest error of the links that a report draws over a run, in metres.
double error_of_lengths_m(const LinkageDevice& device) {
  host_sim::Scenario scenario;
  scenario.linkage = device;
  const host_sim::Environment environment;
  host_sim::RunFacts facts;
  facts.ticks = 300;
  host_sim::RunPaths run(environment, scenario, facts);
  for (uint32_t i = 0; i < facts.ticks; ++i) run.add(tick_at(device, pose(device, 0.02 * i), i));
  const std::vector<tools::Link> links = tools::links_of(device);
  const size_t chains = links.size() / 2;
  CHECK_EQ(run.joints_m().size(), 2 * chains * facts.ticks);
  double error_m = 0;
  for (size_t i = 0; i < run.joints_m().size(); ++i) {
    const size_t chain = i % (2 * chains) / 2;
    const Vec to = i % 2 == 0 ? run.joints_m()[i + 1] : run.samples()[i / (2 * chains)].device_m;
    const double length_m = links[i % 2 == 0 ? chain : chains + chain].length_m;
    error_m = std::max(error_m, std::fabs(norm(to - run.joints_m()[i]) - length_m));
  }
  return error_m;
}

}  // namespace

TEST(DrawnLinks_OfEachMachine_AreAsLongAsItsFileSaysAndEndAtTheTip) {
  for (const std::string& name : tools::machine_names())
    CHECK_LT(error_of_lengths_m(machine(name)), 1e-9);
}

// What an asset stores draws the same links; of a tip that cannot be there none, and then again.
TEST(DrawnLinks_OfAStoredLinkage_FollowTheTip) {
  for (const std::string& name : tools::machine_names()) {
    const LinkageDevice device = machine(name);
    const device::LinkageLayout layout = tools::layout_of(device);
    device::StoredLinkage stored;
    CHECK(open({reinterpret_cast<const uint8_t*>(&layout), sizeof layout}, stored).ok());
    TipFollower tip(host_sim::kinematics_of(stored));
    double off_m = 0;
    for (int i = 0; i < 200; ++i) {
      const JointMotion at = pose(device, 0.03 * i);
      const JointMotion* found = tip.at(points_of(device, at).tip.at_m);
      CHECK(found != nullptr);
      if (found == nullptr) return;
      const std::vector<Vec> drawn = joints_m(tip.device(), *found);
      const std::vector<Vec> wanted = joints_m(device, at);
      for (size_t k = 0; k < drawn.size(); ++k) off_m = std::max(off_m, norm(drawn[k] - wanted[k]));
      if (i % 50 == 49) CHECK(tip.at({3, 0, 0}) == nullptr);
    }
    CHECK_LT(off_m, 1e-7);
  }
}

#if __has_include(<Eigen/LU>)
#include <Eigen/LU>

namespace {

// n / (|J| |J^-1|) of the tip's differences.
double condition_of(const LinkageDevice& device, const JointMotion& at) {
  constexpr double kStep_rad = 1e-6;
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> jacobian(3, device.joints.joints);
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    JointMotion high = at, low = at;
    high.angle_rad[k] += kStep_rad, low.angle_rad[k] -= kStep_rad;
    const Vec column = points_of(device, high).tip.at_m - points_of(device, low).tip.at_m;
    jacobian.col(k) << column.x, column.y, column.z;
  }
  const double inverse = std::sqrt((jacobian.transpose() * jacobian).inverse().trace());
  return static_cast<double>(jacobian.cols()) / (jacobian.norm() * inverse);
}

}  // namespace

TEST(ConditionChart_OfEachMachine_IsThatOfTheTipsDifferences) {
  for (const std::string& name : tools::machine_names()) {
    const LinkageDevice device = machine(name);
    const host_sim::Environment environment;
    host_sim::RunFacts facts;
    facts.ticks = 400;
    host_sim::RunCharts charts(environment, facts, &device);
    for (uint32_t i = 0; i < facts.ticks; ++i)
      charts.add(tick_at(device, pose(device, 0.02 * i), i));
    charts.finish({});
    const host_sim::RunChart& chart = charts.charts().back();
    CHECK(chart.title == "Reciprocal condition of the linkage");
    const std::vector<float>& drawn = chart.curves[0].values.low();
    double off = 0, least = 1, greatest = 0;
    for (uint32_t i = 0; i < facts.ticks; ++i) {
      const double is = condition_of(device, pose(device, 0.02 * i));
      least = std::min(least, is), greatest = std::max(greatest, is);
      off = std::max(off, std::fabs(static_cast<double>(drawn[i]) - is));
    }
    CHECK_LT(off, 2e-5);  // float32 along the Jacobian
    CHECK_LT(least, 0.9 * greatest);
  }
}

// The map of a five-bar against its angles in closed form: cosines of the triangles of each side.
TEST(ConditionMap_OfAFiveBar_IsThatOfItsAnglesInClosedForm) {
  const LinkageDevice device = machine("pantograph_mk2");
  const device::FiveBar& bar = std::get<device::FiveBar>(device.linkage);
  const host_sim::ConditionMap map = host_sim::condition_map(device, 0);
  CHECK_EQ(map.reciprocal.size(), size_t{map.columns} * map.rows);
  CHECK_EQ(std::max(map.columns, map.rows), 120u);
  // The first cell is the upper left one, and the last ends at the lower right corner.
  const Vec first_m = map.middle_m(0, 0), last_m = map.middle_m(map.columns - 1, map.rows - 1);
  const double cell_m = (map.high_m.x - map.low_m.x) / map.columns;
  CHECK_LT(norm(first_m - Vec{map.low_m.x, map.high_m.y, 0} - Vec{cell_m, -cell_m, 0} * 0.5),
           0.02 * cell_m);
  CHECK_LT(norm(last_m - Vec{map.high_m.x, map.low_m.y, 0} - Vec{-cell_m, cell_m, 0} * 0.5),
           0.02 * cell_m);
  double off = 0;
  uint32_t reached = 0, wrong = 0;
  for (uint32_t i = 0; i < map.reciprocal.size(); ++i) {
    const Vec tip_m = map.middle_m(i % map.columns, i / map.columns);
    JointMotion at;
    bool is_there = true;
    for (uint32_t k = 0; k < 2; ++k) {
      const double side = k == 0 ? -1 : 1,
                   x = tip_m.x - side * 0.5 * static_cast<double>(bar.base_m);
      const double near_m = static_cast<double>(bar.proximal_m[k]);
      const double far_m = static_cast<double>(bar.distal_m[k]), way2 = x * x + tip_m.y * tip_m.y;
      const double cosine =
          (near_m * near_m + way2 - far_m * far_m) / (2 * near_m * std::sqrt(way2));
      at.angle_rad[k] = std::atan2(tip_m.y, x) - side * std::acos(std::clamp(cosine, -1.0, 1.0));
      const device::JointSetting& joint = device.joints.joint[k];
      is_there = is_there && std::fabs(cosine) < 1 &&
                 at.angle_rad[k] >= static_cast<double>(joint.low_rad) &&
                 at.angle_rad[k] <= static_cast<double>(joint.high_rad);
    }
    wrong += is_there != (map.reciprocal[i] >= 0) ? 1u : 0u;
    if (!is_there || map.reciprocal[i] < 0) continue;
    ++reached;
    off = std::max(off, std::fabs(map.reciprocal[i] - condition_of(device, at)));
  }
  CHECK_EQ(wrong, 0u);
  CHECK_LT(1000u, reached);
  CHECK_LT(reached, map.reciprocal.size() - 1000);
  CHECK_LT(off, 2e-5);
}
#endif
