#include <algorithm>
#include <cmath>

#include "host_sim/bench/contact_rows.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kDegrees = 57.29577951308232;

struct Slide {
  double turn_deg = 0, force_N = 0, drag_N = 0, given_J = 0;
};

// The hand goes once round, 6 mm below the corners of the faces, at 100 mm/s.
Slide slide(const Rig& rig, const std::string& shading) {
  constexpr double kTool_m = 0.0005, kBall_m = 0.02, kDeep_m = 0.006, kTilt = 0.3;
  const auto at = [&](double angle, double away_m) {
    return Vec{std::sin(angle), std::sin(kTilt) * std::cos(angle),
               std::cos(kTilt) * std::cos(angle)} *
           away_m;
  };
  const double away_m = kBall_m + kTool_m;
  std::vector<std::string> script = {Rig::hold_s(0.3), rig.to(at(0, away_m - kDeep_m), 0.05),
                                     Rig::hold_s(0.3)};
  for (int i = 1; i <= 128; ++i)
    script.push_back(rig.to(at(i * 0.049087385212340517, away_m - kDeep_m), 0.1));
  const RigRun run = rig.run(coarse_ball(), at(0, away_m + 0.005), script, Contact::kProxy,
                             {{"tool_radius", with_unit(kTool_m, "m")},
                              {"energy_reservoir", "1000 J"},
                              {"contact_shading", shading}});
  Slide result;
  size_t begin = run.size();
  while (begin > 1 && run[begin - 1].is_ramped_in && norm(run[begin - 1].force_N) > 0.5) --begin;
  for (size_t i = begin + 1; i < run.size(); ++i) {
    const Vec way_m = run[i].hand_m - run[i - 1].hand_m;
    result.turn_deg =
        std::max(result.turn_deg, kDegrees * turn_rad(run[i - 1].force_N, run[i].force_N));
    result.force_N += norm(run[i].force_N) / static_cast<double>(run.size() - begin);
    if (norm(way_m) > 0)
      result.drag_N -= dot(run[i].force_N, unit(way_m)) / static_cast<double>(run.size() - begin);
  }
  result.given_J = score_of(scored(run, rig.stiffness_N_per_m), rig.score_settings()).given_J;
  return result;
}

}  // namespace

std::vector<ContactRow> shading_rows(const Rig& rig) {
  const Slide bare = slide(rig, "0 m"), shaded = slide(rig, "0.01 m");
  const std::string name = "ball of 320 faces, tool of 0.5 mm, shaded to 10 mm: ";
  return {{name + "worst turn in a tick", shaded.turn_deg, "degrees", bare.turn_deg / 5,
           "without shading " + bench::number_text(bare.turn_deg)},
          {name + "drag that it adds, over the force",
           shaded.drag_N / shaded.force_N - bare.drag_N / bare.force_N, "", 0.1, ""},
          {name + "energy given plus stored", shaded.given_J * 1e3, "mJ", 0.2, ""}};
}

}  // namespace firmtouch::host_sim
