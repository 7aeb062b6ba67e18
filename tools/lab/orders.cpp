// `firmtouch-lab orders`: query orders, upper bounds and kinds of boxes, each with each, over the
// baker's tree.
#include <cstdio>

#include "bench/models.hpp"
#include "bench/problem.hpp"
#include "bench/timing.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "lab/orders/contest.hpp"
#include "lab/trials.hpp"

namespace firmtouch::lab {
namespace {

using orders::Entrant;

constexpr uint32_t kQueries = 500, kQueriesLong = 2000;

std::string fixed(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

struct PointSet {
  const char* what;
  std::vector<math::Vec3> points;
};

// The firmware's own search, each query on its own: with certificate, sides and direction.
double firmware_pass(const mesh::View& view, const std::vector<math::Vec3>& points,
                     uint64_t& steps) {
  double sum = 0;
  steps = 0;
  for (const math::Vec3& p : points) {
    mesh::Hint hint;
    const mesh::Closest c = mesh::closest_point(view, p, query::kUnlimited, hint);
    sum += static_cast<double>(c.distance_m);
    steps += c.certificate.steps;
  }
  return sum;
}

void report_set(const Model& model, const PointSet& set, const std::vector<Entrant>& entrants,
                Report& report) {
  report.stage(std::string(set.what) + ", " + model.name);
  const double queries = static_cast<double>(set.points.size());
  const double triangles = model.report.triangles;
  uint64_t steps = 0;
  std::vector<Contender> contenders{
      timed(set.points.size(), [&] { return firmware_pass(model.view, set.points, steps); })};
  for (const Entrant& entrant : entrants)
    contenders.push_back(timed(set.points.size(), [&] { return entrant.pass(set.points); }));
  const std::vector<double> us = medians_us(contenders);
  std::vector<std::vector<std::string>> rows;
  rows.push_back(
      {"the firmware's", "best first, then last", "triangles",
       fixed(static_cast<double>(steps) / queries, 1), "", "", fixed(us[0], 3), "",
       fixed(static_cast<double>(sizeof(mesh::Node)) * model.report.nodes / triangles, 1)});
  for (size_t i = 0; i < entrants.size(); ++i) {
    const orders::Counters c = entrants[i].count(set.points);
    rows.push_back({entrants[i].kind, entrants[i].order, entrants[i].upper,
                    fixed(c.nodes / queries, 1), fixed(c.boxes / queries, 1),
                    fixed(c.triangles / queries, 1), fixed(us[i + 1], 3),
                    std::to_string(c.max_pending) + (c.overflows > 0 ? " (full)" : ""),
                    fixed(entrants[i].tree_bytes / triangles, 1)});
  }
  report.heading(model.name + ", " + set.what + ", each query on its own, a query");
  report.table({"boxes", "order", "upper bound from", "steps", "box tests", "triangles", "us",
                "most pending", "tree B/triangle"},
               rows);
}

}  // namespace

void run_orders(const Options& options, Report& report) {
  const uint32_t queries = options.is_long ? kQueriesLong : kQueries;
  for (const Model& model : load_models(options, Sides::kUnsigned)) {
    if (model.report.triangles < 2)
      throw Problem(model.name + ": has one triangle; there is nothing to search");
    report.stage("building the trees of " + model.name);
    const orders::Contest contest(model.view);
    // A walk of few points would stay in one place.
    const std::vector<math::Vec3> path = walk(model, 40 * queries);
    PointSet touching{"touching path", {}};
    for (size_t i = 0; i < path.size(); i += 40) touching.points.push_back(path[i]);
    for (const PointSet& set : {PointSet{"random points", random_points(model, queries)}, touching})
      report_set(model, set, contest.entrants(), report);
  }
}

}  // namespace firmtouch::lab
