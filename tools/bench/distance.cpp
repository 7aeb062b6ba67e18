#include <cmath>

#include "bench/all_benches.hpp"
#include "bench/certificates.hpp"
#include "bench/models.hpp"
#include "bench/peer.hpp"
#include "bench/timing.hpp"
#include "bench/true_distance.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::bench {
namespace {

constexpr double kWalkGoal = 0.40;  // warm on both sides
constexpr double kRandomGoal = 0.35;
constexpr double kBytesGoal = 36;
constexpr uint32_t kQueries = 20000;
constexpr uint32_t kWork = 160;  // units, about 64 visits
constexpr size_t kBudgetQueries = 1500;
constexpr uint64_t kBudgetSeed = 2;

// All points in order; warm: each starts where the one before ended.
Contender ours(const simd::WideMesh& mesh, const std::vector<math::Vec3>& points, bool is_warm) {
  const auto pass = [&mesh, &points, is_warm] {
    double sum = 0;
    mesh::Hint hint;
    for (const math::Vec3& p : points) {
      if (!is_warm) hint = mesh::Hint{};
      sum += static_cast<double>(mesh.closest_point(p, query::kUnlimited, hint).distance_m);
    }
    return sum;
  };
  return timed(points.size(), pass);
}

struct Race {
  const char* what;
  std::vector<math::Vec3> points;
  bool is_warm;
  double goal;
};

// As baked for a controller, and for a desktop. A warm race has a warm peer, and the cold one
// beside it.
void run_race(const Race& race, const Model& model, const Model& desktop, const Peer& peer,
              Report& report) {
  report.stage(std::string(race.what) + ", " + model.name);
  const TemporaryFolder folder;
  std::vector<Contender> contenders{
      median_of_passes(ours(model.wide, race.points, race.is_warm)),
      median_of_passes(ours(desktop.wide, race.points, race.is_warm))};
  if (peer.is_present()) {
    const std::string file = file_for_peer(model, folder);
    const std::string points = folder.write("points.csv", tools::to_csv(race.points));
    if (race.is_warm) contenders.push_back(peer.contender("closest", file, points, "--warm"));
    contenders.push_back(peer.contender("closest", file, points));
  }
  const std::vector<double> us = medians_us(contenders);
  const char* const bakes[] = {", --fast", ", --desktop"};
  for (size_t i = 0; i < 2; ++i)
    report.figure(std::string(race.what) + bakes[i], model.name, us[i], "us");
  if (!peer.is_present())
    return report.absent(std::string(race.what) + " against the peer", model.name, kPeerAbsent);
  report.figure(std::string(race.what) + ", the peer", model.name, us[2], "us");
  for (size_t i = 0; i < 2; ++i)
    report.bar(std::string(race.what) + bakes[i] + " against the peer", model.name, us[i] / us[2],
               "x", race.goal);
  if (race.is_warm)
    report.figure(std::string(race.what) + ", the peer, cold", model.name, us[3], "us",
                  number_text(us[0] / us[3]) + " x, " + number_text(us[1] / us[3]) + " x");
}

// Bytes that queries read, by what they are for; names in the imported file, probes and provenance
// are not among them.
void report_bytes(const Model& model, Report& report) {
  double all = 0, sides = 0;
  for (const tools::Section& section : model.sections) {
    if (section.type == mesh::kSourceSection) continue;
    const double bytes = static_cast<double>(section.bytes.size());
    all += bytes;
    if (section.type == mesh::kVertexNormalsSection || section.type == mesh::kEdgeFoldsSection)
      sides += bytes;
  }
  const double triangles = model.report.triangles;
  report.bar("bytes a triangle that queries read", model.name, all / triangles, "B", kBytesGoal);
  report.figure("of these for tree, indices and vertices", model.name, (all - sides) / triangles,
                "B");
  report.figure("of these for inside and outside", model.name, sides / triangles, "B");
}

// The bar is in instructions, which tools/bench/cortex-m7 counts; here it is time.
void race_sides(const Model& model, const std::vector<math::Vec3>& points, Report& report) {
  report.stage("with and without sides, " + model.name);
  const Model plain = baked_again(model, Sides::kUnsigned);
  const std::vector<double> us =
      medians_us({ours(model.wide, points, true), ours(plain.wide, points, true)});
  report.figure("time for inside and outside, touching path", model.name, 100 * (us[0] / us[1] - 1),
                "%", "instructions: tools/bench/cortex-m7 --unsigned");
}

BudgetQuery cold_query(const simd::WideMesh& mesh, const std::vector<math::Vec3>& points) {
  return [&mesh, &points](size_t i, uint32_t budget) {
    mesh::Hint hint;
    const mesh::Closest c = mesh.closest_point(points[i], {budget}, hint);
    return Reported{std::fabs(static_cast<double>(c.distance_m)),
                    static_cast<double>(c.certificate.lower_m), c.certificate.steps};
  };
}

// As a controller searches; `steps` are work units.
BudgetQuery cold_work_query(const mesh::View& mesh, const std::vector<math::Vec3>& points) {
  return [&mesh, &points](size_t i, uint32_t budget) {
    mesh::Hint hint;
    const mesh::Closest c = mesh::closest_point(mesh, points[i], {budget}, hint);
    return Reported{std::fabs(static_cast<double>(c.distance_m)),
                    static_cast<double>(c.certificate.lower_m), c.certificate.work};
  };
}

void report_certificates(const Model& model, Report& report) {
  report.stage("certificates, " + model.name);
  const TrueDistance truth(model.surface);
  const std::vector<math::Vec3> points = random_points(model, kBudgetQueries, kBudgetSeed);
  std::vector<double> truths_m;
  for (const math::Vec3& p : points) truths_m.push_back(truth(p));
  const BudgetQuery query = cold_query(model.wide, points);

  const BoundShares shares = bound_shares(truths_m, kWork, cold_work_query(model.view, points));
  const std::string cold = std::to_string(kWork) + " work units, cold: ";
  report.bar_at_least(cold + "lower / truth, median", model.name, shares.lower_median, "", 0.95);
  report.bar_at_least(cold + "lower / truth, 10 %", model.name, shares.lower_p10, "", 0.90);
  report.bar(cold + "upper / truth, 90 %", model.name, shares.upper_p90, "", 1.05);
  report.figure(cold + "done within them", model.name, 100 * shares.exact, "%");

  const CertificateCounts counts = count_certificates(truths_m, model.diagonal_m(), query);
  const std::string queried = "of " + std::to_string(counts.queried) +
                              " answers, budgets 1, 2, 4, ... " +
                              std::to_string(counts.worst_steps);
  report.bar("lower bounds above the truth", model.name, static_cast<double>(counts.lower_wrong),
             "", 0, queried);
  report.bar("returned distances below the truth", model.name,
             static_cast<double>(counts.upper_wrong), "", 0, queried);
  report.bar("gaps that a larger budget widened", model.name, static_cast<double>(counts.gap_grew),
             "", 0, queried);
  report.figure("median gap at half the worst", model.name,
                100 * counts.half_gap_m / model.diagonal_m(), "% of the diagonal");
}

}  // namespace

void run_distance(const Options& options, Report& report) {
  const Peer peer(options.peer);
  for (const Model& model : load_models(options)) {
    report.heading("closest points: " + model.name);
    const Model desktop = baked_for_desktop(model);
    run_race({"touching path, warm", walk(model, kQueries), true, kWalkGoal}, model, desktop, peer,
             report);
    race_sides(model, walk(model, kQueries), report);
    run_race({"random points, cold, exact", random_points(model, kQueries), false, kRandomGoal},
             model, desktop, peer, report);
    report_certificates(model, report);
    report_bytes(model, report);
  }
}

void run_certificates(const Options& options, Report& report) {
  for (const Model& model : load_models(options)) {
    report.heading("certificates: " + model.name);
    report_certificates(model, report);
  }
}

}  // namespace firmtouch::bench
