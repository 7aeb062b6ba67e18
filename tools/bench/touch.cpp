#include <algorithm>
#include <string>

#include "bench/all_benches.hpp"
#include "bench/touch_ride.hpp"
#include "firmtouch/scene/proxy.hpp"

// The theorems of contact through a proxy (firmware/firmtouch/scene/README.md), attacked: a hand
// drags spheres through a model, in turn at up to 10 m/s and at 1 m/s, with budgets of 10 work
// units to unlimited and coefficients of friction of 0 to 2. Every move of the proxy is cast
// through the surface, exactly; some places are measured in double. Speeds are of a model of 0.15 m
// at 1 kHz; others are as if scaled to it.
namespace firmtouch::bench {
namespace {

constexpr uint64_t kRideTicks = 5000;
constexpr uint32_t kReleaseTicks = 20;

void attack(TouchSubject& subject, const Options& options, Report& report) {
  const uint64_t ticks = options.ticks > 0 ? options.ticks : options.is_long ? 20000000 : 200000;
  const bool is_spline = !is_mesh(subject);
  const uint64_t rides = (ticks + kRideTicks - 1) / kRideTicks;
  TouchSums sums;
  for (uint64_t n = 0; n < rides; ++n) {
    report.stage("touching " + subject.name + ": ride " + std::to_string(n + 1) + " of " +
                 std::to_string(rides));
    ride(subject, options.seed + n, std::min(kRideTicks, ticks - n * kRideTicks), sums);
  }
  const std::string& of = subject.name;
  const double usual = static_cast<double>(sums.usual);
  report.bar("moves that cross the surface", of, static_cast<double>(sums.crossings), "", 0,
             "of " + std::to_string(sums.moves) + " in " + std::to_string(sums.ticks) + " ticks");
  report.bar("places nearer than the radius", of, static_cast<double>(sums.too_near), "", 0,
             "of " + std::to_string(sums.places));
  report.bar("moves away from the hand, with friction", of, static_cast<double>(sums.longer), "",
             0);
  report.bar("the same without, the longest", of,
             sums.longer_m / static_cast<double>(subject.size_m), "diagonals", 1e-7);
  report.bar("queries a tick at 1 m/s", of, static_cast<double>(sums.queries) / usual, "", 1.3);
  report.bar("the most in a tick", of, static_cast<double>(sums.most_queries), "",
             scene::kMaxQueries);
  report.bar_at_least("ticks that end at the solution", of,
                      100 * static_cast<double>(sums.optimal) / usual, "%", is_spline ? 95 : 98);
  // A bench that touches nothing shows nothing.
  report.bar_at_least("ticks with the hand elsewhere", of,
                      100 * static_cast<double>(sums.usual - sums.free) / usual, "%", 1);
  report.figure("of those at the solution", of,
                100 * static_cast<double>(sums.held_optimal) /
                    static_cast<double>(std::max<uint64_t>(sums.usual - sums.free, 1)),
                "%");
  report.figure("ticks that are uncertain", of, 100 * static_cast<double>(sums.starved) / usual,
                "%");
}

struct Released {
  uint32_t contacts = 0, faults = 0, late = 0, worst = 0;
};

Released release(TouchSubject& subject, uint32_t contacts, Report& report) {
  Released all;
  // Some seeds touch nothing.
  for (uint64_t seed = 0; all.contacts < contacts && seed < 10ull * contacts; ++seed) {
    if (seed % 64 == 0) report.stage("leaving " + subject.name + ": " + std::to_string(seed));
    const Leaving one = leave(subject, seed);
    if (!one.is_contact) continue;
    ++all.contacts;
    all.worst = std::max(all.worst, one.ticks);
    all.faults += one.is_fault;
    all.late += one.ticks > kReleaseTicks;
  }
  return all;
}

// Without a base hull a contact may end in a fault.
void run_release(TouchSubject& subject, bool has_hull, uint32_t contacts, Report& report) {
  const std::string& of = subject.name;
  const Released all = release(subject, contacts, report);
  const std::string share = "of " + std::to_string(all.contacts);
  report.bar(std::string("ticks until a leaving hand is let go") +
                 (has_hull ? ", hull of 1,000 faces" : ", or a fault"),
             of, all.worst, "", kReleaseTicks,
             std::to_string(all.late) + " " + share + " contacts longer; 20 work units a tick");
  if (has_hull)
    report.bar("contacts that a fault ends", of, all.faults, "", 0, share);
  else
    report.figure("contacts that a fault ends", of, all.faults, "", share);
}

}  // namespace

void run_touch(const Options& options, Report& report) {
  for (const auto& subject : load_touch_subjects(options)) {
    if (!options.is_release) attack(*subject, options, report);
    const uint32_t contacts = options.is_release || options.is_long ? 1500 : 100;
    run_release(*subject, false, contacts, report);
    if (!options.is_release) continue;
    if (!is_mesh(*subject)) {
      report.absent("ticks until a leaving hand is let go", subject->name, "splines have no hull");
      continue;
    }
    report.stage("baking a hull of " + subject->name);
    run_release(*with_base_hull(*subject, 1000), true, contacts, report);
  }
}

}  // namespace firmtouch::bench
