#include <cmath>

#include "bench/all_benches.hpp"
#include "bench/baked_hull.hpp"
#include "bench/hull_memory.hpp"
#include "bench/models.hpp"
#include "bench/segments.hpp"
#include "firmtouch/hull/complete_cast.hpp"

namespace firmtouch::bench {
namespace {

using math::Vec3;
using Room = std::vector<mesh::SurfaceCrossing>;

// Against brute force in double: none missed, none made up. A segment that grazes an edge or an end
// is undecided in doubles and is left out.
void run_truth(const Model& model, const Baked& baked, bool is_long, Report& report) {
  Refined refined(baked.view, 1000, baked.view.collapse_count() + 1, 4096);
  const size_t count = is_long ? 10000 : 2000;
  for (const bool from_outside : {true, false}) {
    report.stage("brute force in double, " + model.name);
    size_t missed = 0, extra = 0, wrong_ends = 0, crossings = 0, grazing = 0;
    Room room(4096), found(4096);
    for (const FloatSegment& s :
         from_outside ? across_box(model, count, 7) : anywhere(model, count, 8)) {
      std::vector<double> truth;
      if (!all_crossings_in_double(model.surface, s, truth)) {
        ++grazing;
        continue;
      }
      const mesh::Crossings all =
          hull::all_crossings(baked.view, s.a_m, s.b_m, query::kUnlimited, span(room));
      crossings += truth.size();
      missed += truth.size() > all.found ? truth.size() - all.found : 0;
      extra += all.found > truth.size() ? all.found - truth.size() : 0;
      const hull::RefinedCrossings of_hull =
          refined.refinement->all(s.a_m, s.b_m, query::kUnlimited, span(found));
      const bool is_none = of_hull.found == 0;
      if (is_none != truth.empty() ||
          (!is_none &&
           (std::fabs(truth.front() - static_cast<double>(found[0].t)) > 1e-5 ||
            std::fabs(truth.back() - static_cast<double>(found[of_hull.reported - 1].t)) > 1e-5)))
        ++wrong_ends;
    }
    const std::string from = from_outside ? ", from outside" : ", from anywhere";
    report.figure("crossings in double" + from, model.name, static_cast<double>(crossings), "",
                  "of " + std::to_string(count) + " segments, " + std::to_string(grazing) +
                      " grazing ones left out");
    report.bar("complete: missed" + from, model.name, static_cast<double>(missed), "", 0);
    report.bar("complete: made up" + from, model.name, static_cast<double>(extra), "", 0);
    if (from_outside) {
      report.bar("refinement from 1,000 faces: first or last wrong" + from, model.name,
                 static_cast<double>(wrong_ends), "", 0);
    } else {
      report.figure("refinement from 1,000 faces: first or last wrong" + from, model.name,
                    static_cast<double>(wrong_ends), "", "it promises them from outside only");
    }
  }
}

}  // namespace

void run_hull_queries(const Options& options, Report& report) {
  for (const Model& model : load_models(options)) {
    report.heading("hull in an asset: " + model.name);
    report.stage("baking a hull of " + model.name);
    const Baked baked(model, 500, 16);
    const double triangles = model.view.head().triangle_count;
    report.figure("faces of the coarsest hull", model.name, baked.report.faces, "",
                  baked.report.stalled);
    report.bar("bytes a triangle: hull", model.name, baked.report.other_bytes / triangles, "bytes",
               23, "16-bit grid");
    report.bar("bytes a triangle: boxes of stars", model.name, baked.report.star_bytes / triangles,
               "bytes", 3);
    report.figure("bytes a triangle: boxes over the triangles", model.name,
                  baked.report.box_bytes / triangles, "bytes");
    report.heading("against brute force: " + model.name);
    run_truth(model, baked, options.is_long, report);
    report.heading("first hits in fixed memory: " + model.name);
    run_memory(model, baked, report);
    report.heading("resident shells: " + model.name);
    run_base_hulls(model, baked, report);
  }
}

}  // namespace firmtouch::bench
