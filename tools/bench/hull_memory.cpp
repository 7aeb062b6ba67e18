#include "bench/hull_memory.hpp"

#include "bench/segments.hpp"
#include "firmtouch/hull/base_hull_cast.hpp"
#include "firmtouch/hull/base_hull_distance.hpp"
#include "firmtouch/mesh/segment_cast.hpp"

namespace firmtouch::bench {

void run_memory(const Model& model, const Baked& baked, Report& report) {
  const std::vector<FloatSegment> segments = across_box(model, 10000, 7);
  std::vector<std::vector<std::string>> rows;
  for (const uint32_t base : {500u, 2000u}) {
    if (base < baked.view.base_hull().face_count() || base >= model.surface.faces.size()) continue;
    for (const uint32_t entries : {32u, 64u, 128u, 256u, 512u, 1024u}) {
      report.stage("memory of " + std::to_string(entries) + " entries, " + model.name);
      Refined refined(baked.view, base, entries, 64);
      size_t cut_off = 0, ghosts = 0, wrong = 0, hits = 0;
      double error = 0;
      for (const FloatSegment& s : segments) {
        const mesh::Hit truth = mesh::cast_segment(model.view, s.a_m, s.b_m, query::kUnlimited);
        const hull::RefinedHit hit = refined.refinement->first(s.a_m, s.b_m, query::kUnlimited);
        cut_off += hit.exact ? 0 : 1;
        ghosts += hit.hit && !truth.hit ? 1 : 0;
        const bool is_late = truth.hit && (!hit.hit || hit.t > truth.t + 0x1p-17f);
        const bool is_other =
            hit.exact && (hit.hit != truth.hit || (hit.hit && hit.triangle != truth.triangle));
        wrong += is_late || is_other ? 1 : 0;
        if (!truth.hit) continue;
        ++hits;
        error += length(tools::to_point(s.b_m) - tools::to_point(s.a_m)) *
                 static_cast<double>(truth.t - hit.t) / model.diagonal_m();
      }
      error *= 100 / static_cast<double>(hits);
      rows.push_back({std::to_string(base), std::to_string(entries), std::to_string(cut_off),
                      std::to_string(ghosts), number_text(error), std::to_string(wrong)});
      if (base != 2000 || entries != 256) continue;
      const double bytes = 4 * 256 + 8 * 64 + static_cast<double>(sizeof(hull::Refinement));
      report.bar("RAM of a first hit at 256 entries, beside a bit a collapse", model.name, bytes,
                 "bytes", 2000);
      report.bar("mean depth error at 256 entries, base 2,000", model.name, error,
                 "% of the diagonal", 0.03);
      report.bar("answers later than the mesh, or wrong where exact", model.name,
                 static_cast<double>(wrong), "", 0);
    }
  }
  report.table({"base, faces", "entries", "of 10,000 cut off", "of them reported without a hit",
                "mean depth error, % of the diagonal", "late or wrong"},
               rows);
}

namespace {

// A path of short moves that stays off the shell: none of them may read flash.
void run_path(const Model& model, const hull::BaseHull& base_hull, Report& report) {
  const double off_m = 0.02 * model.diagonal_m();
  size_t moves = 0, reads = 0;
  math::Vec3 last{};
  bool has_last = false;
  for (const FloatSegment& s : across_box(model, 300, 9)) {
    const tools::Point a = tools::to_point(s.a_m), way = tools::to_point(s.b_m) - a;
    has_last = false;
    for (int i = 0; i <= 200; ++i) {
      const math::Vec3 here = tools::to_vec3(a + way * (i / 200.0));
      const hull::BaseHullDistance near =
          hull::base_hull_distance(base_hull, here, query::kUnlimited);
      const bool is_off = static_cast<double>(near.lower_m) > off_m;
      if (is_off && has_last) {
        ++moves;
        reads += hull::cast_base_hull(base_hull, last, here, query::kUnlimited).hit ? 1u : 0u;
      }
      last = here;
      has_last = is_off;
    }
  }
  report.bar("moves that read flash on paths 2 % of the diagonal off the shell", model.name,
             static_cast<double>(reads), "of " + std::to_string(moves), 0);
}

}  // namespace

void run_base_hulls(const Model& model, const Baked& baked, Report& report) {
  const std::vector<FloatSegment> segments = across_box(model, 10000, 7);
  std::vector<std::vector<std::string>> rows;
  for (const uint32_t faces : {500u, 1000u, 2000u}) {
    if (faces < baked.view.base_hull().face_count() || faces >= model.surface.faces.size())
      continue;
    const Refined refined(baked.view, faces, 1, 1);
    size_t free_segments = 0, read = 0, late = 0, hits = 0;
    double error = 0, steps = 0;
    for (const FloatSegment& s : segments) {
      const mesh::Hit truth = mesh::cast_segment(model.view, s.a_m, s.b_m, query::kUnlimited);
      const hull::BaseHullHit hit =
          hull::cast_base_hull(refined.base_hull, s.a_m, s.b_m, query::kUnlimited);
      steps += hit.steps / static_cast<double>(segments.size());
      late += truth.hit && (!hit.hit || hit.t > truth.t + 0x1p-17f) ? 1 : 0;
      free_segments += truth.hit ? 0 : 1;
      read += !truth.hit && hit.hit ? 1 : 0;
      if (!truth.hit) continue;
      ++hits;
      error += length(tools::to_point(s.b_m) - tools::to_point(s.a_m)) *
               static_cast<double>(truth.t - hit.t) / model.diagonal_m();
    }
    const double share = 100 * static_cast<double>(read) / static_cast<double>(free_segments);
    rows.push_back({std::to_string(refined.base_hull.face_count()),
                    std::to_string(refined.base_hull.resident_bytes()), number_text(steps),
                    number_text(share), number_text(100 * error / static_cast<double>(hits)),
                    std::to_string(late)});
    if (faces != 1000) continue;
    report.bar("bytes of a shell of 1,000 faces with boxes", model.name,
               refined.base_hull.resident_bytes(), "bytes", 12288);
    report.bar("segments without a hit that read flash, shell of 1,000", model.name, share, "%",
               1.5);
    report.bar("shell hits later than the mesh", model.name, static_cast<double>(late), "", 0);
    run_path(model, refined.base_hull, report);
  }
  report.table({"shell, faces", "bytes", "boxes a segment", "free segments that read flash, %",
                "mean depth error, % of the diagonal", "late"},
               rows);
}

}  // namespace firmtouch::bench
