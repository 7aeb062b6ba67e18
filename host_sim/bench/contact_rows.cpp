#include "host_sim/bench/contact_rows.hpp"

#include <algorithm>
#include <cmath>

#include "host_sim/report/buzz.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kDegrees = 57.29577951308232;
constexpr size_t kBuzzTicks = 2048;

// A force that rests between two counts of the encoder may be either's.
double force_bar_N(double closed_form_N) { return 0.005 * closed_form_N + 0.012; }

double last_buzz_N(const RigRun& run) {
  std::vector<Vec> last_N;
  for (size_t i = run.size() - kBuzzTicks; i < run.size(); ++i) last_N.push_back(run[i].force_N);
  return buzz_N(last_N.data(), last_N.size(), 1000);
}

double largest(Vec a) { return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)}); }

std::string closed_form(double value, const char* unit) {
  return "closed form " + bench::number_text(value) + " " + unit;
}

ContactRow force_row(const std::string& what, Vec mean_N, Vec closed_form_N) {
  return {what + ": force, off the closed form", largest(mean_N - closed_form_N), "N",
          force_bar_N(largest(closed_form_N)), closed_form(largest(closed_form_N), "N")};
}

double softer(const Rig& rig) { return std::max(1.0, rig.stiffness_N_per_m / 1000); }

void add_plane(const Rig& rig, Contact contact, std::vector<ContactRow>& rows) {
  const double r = rig.radius_m, aim_m = 0.003, force_N = rig.series_N_per_m() * aim_m;
  const RigRun run = rig.run(plate(0.04), {-0.025, 0.01, 0.01 + r},
                             {Rig::hold_s(0.3), rig.to({-0.025, 0.01, r - aim_m}, 0.05),
                              Rig::hold_s(0.5), rig.to({0.025, -0.01, r - aim_m}, 0.1)},
                             contact);
  double along2 = 0, across_N = 0;
  const size_t begin = 1500;
  for (size_t i = begin; i < run.size(); ++i) {
    const Vec f = run[i].force_N;
    along2 += f.x * f.x + f.y * f.y;
    across_N += f.z / static_cast<double>(run.size() - begin);
  }
  rows.push_back({"frictionless plane, 100 mm/s: force along it, rms",
                  std::sqrt(along2 / static_cast<double>(run.size() - begin)), "N",
                  rig.seed == 0 ? 1e-5 : 2e-5 * std::max(1.0, force_N), closed_form(0, "N")});
  rows.push_back(force_row("frictionless plane", {0, 0, across_N}, {0, 0, force_N}));
}

void add_two_walls(const Rig& rig, Contact contact, std::vector<ContactRow>& rows) {
  const double r = rig.radius_m, aim_m = 0.006, force_N = rig.series_N_per_m() * aim_m;
  const RigRun run = rig.run(
      two_walls(), {-0.012 - r, 0, 0.012 + r},
      {Rig::hold_s(0.3), rig.to({-r + aim_m, 0, r - aim_m}, 0.05), Rig::hold_s(3)}, contact);
  const Score score = score_of(scored(run, rig.stiffness_N_per_m), rig.score_settings());
  size_t pressed = 0;
  while (pressed + 1 < run.size() && norm(run[pressed].force_N) <= 0.5) ++pressed;
  double turn = 0;
  for (size_t i = pressed + 1; i < run.size(); ++i)
    turn = std::max(turn, turn_rad(run[i - 1].force_N, run[i].force_N));
  rows.push_back({"2 walls: buzz", last_buzz_N(run), "N", 0.01 * softer(rig), ""});
  rows.push_back({"2 walls: worst turn in a tick", turn * kDegrees, "degrees", 10, ""});
  rows.push_back({"2 walls: energy given plus stored", score.given_J * 1e3, "mJ", 0.2, ""});
  rows.push_back(force_row("2 walls", mean_force_N(run, 1000), {-force_N, 0, force_N}));
}

void add_three_walls(const Rig& rig, Contact contact, std::vector<ContactRow>& rows) {
  const double r = rig.radius_m, aim_m = 0.006, force_N = rig.series_N_per_m() * aim_m;
  const double from_m = 0.012 + r, to_m = r - aim_m;
  const RigRun run =
      rig.run(three_walls(), {from_m, from_m, from_m},
              {Rig::hold_s(0.3), rig.to({to_m, to_m, to_m}, 0.05), Rig::hold_s(3)}, contact);
  rows.push_back({"3 walls: buzz", last_buzz_N(run), "N", 0.015 * softer(rig), ""});
  rows.push_back(force_row("3 walls", mean_force_N(run, 1000), {force_N, force_N, force_N}));
}

void add_groove(const Rig& rig, Contact contact, std::vector<ContactRow>& rows) {
  const double r = rig.radius_m, aim_m = 0.004, force_N = rig.series_N_per_m() * aim_m;
  const double seat_m = -0.01 + r / std::sin(rig.half_angle_rad);
  const RigRun run =
      rig.run(groove(rig.half_angle_rad), {0, 0, 0.012 + r},
              {Rig::hold_s(0.3), rig.to({0, 0, seat_m - aim_m}, 0.05), Rig::hold_s(3)}, contact);
  double aside_m = 0;
  for (size_t i = run.size() - 1000; i < run.size(); ++i)
    aside_m = std::max(aside_m, std::fabs(run[i].proxy_m.x));
  const double bar_N = rig.seed == 0 ? 0.005 : 0.01 * rig.stiffness_N_per_m / 1000;
  rows.push_back({"V groove: buzz", last_buzz_N(run), "N", bar_N, ""});
  rows.push_back(force_row("V groove", mean_force_N(run, 1000), {0, 0, force_N}));
  rows.push_back({"V groove: proxy off its middle", aside_m * 1e6, "um", 12, closed_form(0, "um")});
}

void add_slot(const Rig& rig, Contact contact, std::vector<ContactRow>& rows) {
  const double r = rig.radius_m, aim_m = 0.005, force_N = rig.series_N_per_m() * aim_m;
  const double seat_m = std::sqrt(r * r - rig.slot_m * rig.slot_m / 4);
  const RigRun run =
      rig.run(slot(rig.slot_m), {0, 0, 0.012 + r},
              {Rig::hold_s(0.3), rig.to({0, 0, seat_m - aim_m}, 0.05), Rig::hold_s(2)}, contact);
  double z_m = 0;
  for (size_t i = run.size() - 500; i < run.size(); ++i) z_m += run[i].proxy_m.z / 500;
  rows.push_back({"ball on a slot: height, off the closed form", std::fabs(z_m - seat_m) * 1e6,
                  "um", 1, closed_form(seat_m * 1e3, "mm")});
  rows.push_back(force_row("ball on a slot", mean_force_N(run, 500), {0, 0, force_N}));
}

}  // namespace

std::vector<ContactRow> resting_rows(const Rig& rig, Contact contact) {
  std::vector<ContactRow> rows;
  add_plane(rig, contact, rows);
  add_two_walls(rig, contact, rows);
  add_three_walls(rig, contact, rows);
  add_groove(rig, contact, rows);
  add_slot(rig, contact, rows);
  return rows;
}

// Without damping the force of each tick is K times how far the measured position is behind the
// walls, as long as no limit acts: below 7 N, less than 4 N from the last tick.
std::vector<ContactRow> onset_rows(const Rig& rig, Contact contact) {
  const double r = rig.radius_m, stiffness = rig.stiffness_N_per_m;
  const struct {
    const char* name;
    Solid solid;
    Vec outward[3];  // of walls through the origin
    int walls;
  } cases[] = {{"1 wall", plate(0.04), {{0, 0, 1}}, 1},
               {"2 walls", two_walls(), {{0, 0, 1}, {-1, 0, 0}}, 2},
               {"3 walls", three_walls(), {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 3}};
  std::vector<ContactRow> rows;
  for (const auto& each : cases) {
    Vec out;
    for (int k = 0; k < each.walls; ++k) out = out + each.outward[k];
    double late = 0, off_share = 0, off_deg = 0;
    const double diagonal_m = rig.diagonal_m(each.solid);
    for (const double speed : {0.1, 0.5, 1.8}) {
      const RigRun run =
          rig.run(each.solid, out * (0.012 + r),
                  {Rig::hold_s(0.3), rig.to(out * (r - 0.004), speed), Rig::hold_s(0.3)}, contact,
                  {{"contact_damping", "0 N*s/m"}});
      Vec last_N;
      for (const RigTick& tick : run) {
        Vec wanted_N;
        for (int k = 0; k < each.walls; ++k) {
          const Vec n = each.outward[k];
          wanted_N = wanted_N + n * (stiffness * std::max(0.0, r - dot(n, tick.position_m)));
        }
        const double size_N = norm(wanted_N), off_N = norm(tick.force_N - wanted_N);
        const bool is_limited = size_N > 7 || norm(wanted_N - last_N) > 4;
        last_N = tick.force_N;
        if (is_limited || !tick.is_on) continue;
        const double bar_N = 0.005 * size_N + stiffness * 2e-6 * diagonal_m;
        if (size_N > bar_N && norm(tick.force_N) < size_N / 2) ++late;
        off_share = std::max(off_share, off_N / bar_N);
        if (size_N < 0.1) continue;
        const double sine = norm(cross(tick.force_N, wanted_N));
        off_deg = std::max(off_deg, kDegrees * std::atan2(sine, dot(tick.force_N, wanted_N)));
      }
    }
    const std::string name = std::string("onset on ") + each.name;
    rows.push_back({name + ": ticks late", late, "", 0, closed_form(0, "ticks")});
    rows.push_back({name + ": force, off the closed form over what is allowed", off_share, "", 1,
                    "allowed: 0.5 % + K x 2e-6 diagonals"});
    rows.push_back({name + ": direction", off_deg, "degrees", 0.5, "from 0.1 N on"});
  }
  return rows;
}

std::vector<ContactRow> plate_rows(const Rig& rig, Contact contact, bool is_long) {
  const std::vector<double> thick_m = is_long ? std::vector<double>{5e-5, 2.5e-4, 1e-3, 2e-3, 8e-3}
                                              : std::vector<double>{5e-5, 2e-3};
  const std::vector<double> radii_m =
      is_long ? std::vector<double>{2e-5, 5e-4, 1e-3, 3e-3} : std::vector<double>{2e-5, 3e-3};
  const std::vector<double> speeds =
      is_long ? std::vector<double>{0.05, 2, 10} : std::vector<double>{0.05, 10};
  // Penalty contact has no proxy: there a force that pulls shows that the tool is through.
  const bool has_proxy = contact == Contact::kProxy;
  double through = 0, fastest_mps = 0, runs = 0;
  for (const double t : thick_m)
    for (const double r : radii_m)
      for (const double speed : speeds) {
        // A firm grip and a way, so that the tool comes to the speed of the hand.
        const double from_m = speed > 1 ? 0.3 : 0.1;
        const RigRun run = rig.run(
            plate(t), {0.0023, 0.0011, from_m},
            {Rig::hold_s(0.3), rig.to({0.0023, 0.0011, -0.1}, speed), Rig::hold_s(0.3)}, contact,
            {{"tool_radius", with_unit(r, "m")},
             {"hand_stiffness", "20000 N/m"},
             {"hand_damping", "80 N*s/m"},
             {"max_speed", "100 m/s"}});
        double least_m = 1, pulled_N = 0;
        for (size_t i = 1; i < run.size(); ++i) {
          least_m = std::min(least_m, run[i].proxy_m.z);
          pulled_N = std::min(pulled_N, run[i].force_N.z);
          fastest_mps = std::max(fastest_mps, (run[i - 1].device_m.z - run[i].device_m.z) * 1000);
        }
        ++runs;
        if ((has_proxy && least_m < r - 1e-6) || pulled_N < -0.01) ++through;
      }
  return {{"plates of 0.05 to 8 mm, r 0.02 to 3 mm: times through", through, "", 0,
           "of " + bench::number_text(runs) + " runs, the tool comes at up to " +
               bench::number_text(fastest_mps) + " m/s"}};
}

}  // namespace firmtouch::host_sim
