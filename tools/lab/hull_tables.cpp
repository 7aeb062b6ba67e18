#include <chrono>
#include <cmath>
#include <memory>

#include "bench/baked_hull.hpp"
#include "bench/models.hpp"
#include "bench/segments.hpp"
#include "bench/timing.hpp"
#include "firmtouch/hull/complete_cast.hpp"
#include "firmtouch/mesh/segment_cast.hpp"
#include "lab/kdop_tree.hpp"
#include "lab/published_refinement.hpp"
#include "lab/trials.hpp"

namespace firmtouch::lab {
namespace {

using Room = std::vector<mesh::SurfaceCrossing>;

// Table 4: everything in one run, in turn, all by the same segments.
class Table4 {
 public:
  Table4(const Model& model, const Baked& baked, size_t count)
      : model_(model), baked_(baked), segments_(across_box(model, count, 7)) {}

  void run(Report& report) {
    for (const uint32_t k : {6u, 14u, 18u, 26u}) add_kdops(k, KdopTree::Test::kIntervals);
    add_kdops(26, KdopTree::Test::kClip);
    add_published();
    add_refined(1000);
    add_refined(2000);
    add_exact();
    std::vector<Contender> contenders;
    for (const Row& row : rows_) contenders.push_back(row.contender);
    us_ = medians_us(contenders);
    print(report);
    compare(report);
  }

 private:
  struct Row {
    std::string name;
    double prepared_s, bytes;
    Contender contender;
    std::string remark;
  };
  enum { kOf26 = 3, kPublished = 5, kComplete = 11 };  // rows

  template <class Answer>
  void add(const std::string& name, double prepared_s, double bytes, const std::string& remark,
           Answer answer) {
    const auto pass = [this, answer] {
      double sum = 0;
      for (const FloatSegment& s : segments_) sum += answer(s);
      return sum;
    };
    rows_.push_back({name, prepared_s, bytes, timed(segments_.size(), pass), remark});
  }

  void add_kdops(uint32_t k, KdopTree::Test test) {
    const auto begin = std::chrono::steady_clock::now();
    trees_.push_back(std::make_unique<KdopTree>(model_.surface, k));
    const double seconds = seconds_since(begin);
    const KdopTree* tree = trees_.back().get();
    uint64_t visits = 0;
    const auto answer = [tree, test](const FloatSegment& s, uint64_t& nodes) {
      return tree->crossings(tools::to_point(s.a_m), tools::to_point(s.b_m), test, nodes);
    };
    for (const FloatSegment& s : segments_) (void)answer(s, visits);
    const double each = static_cast<double>(visits) / static_cast<double>(segments_.size());
    const bool is_interval = test == KdopTree::Test::kIntervals;
    if (k == 26 && is_interval) visits_26_ = each;
    add(std::to_string(k) + "-DOPs, " + (is_interval ? "intervals" : "clipped"), seconds,
        static_cast<double>(tree->bytes()), number_text(each) + " nodes a segment",
        [answer](const FloatSegment& s) {
          uint64_t ignored = 0;
          return answer(s, ignored);
        });
  }

  // The paper's algorithm, in double and without boxes, at the bases that suit it best.
  void add_published() {
    tools::HullReport ignored;
    tools::HullOptions options;
    options.target_faces = 500;
    const auto begin = std::chrono::steady_clock::now();
    built_ = tools::build_hull(model_.surface, options, ignored);
    const double seconds = seconds_since(begin);
    for (const uint32_t base : {1000u, 2000u}) {
      published_.push_back(std::make_unique<tools::Refinement>(built_, base));
      tools::Refinement* refinement = published_.back().get();
      add("hull as published, base " + std::to_string(base), seconds, baked_.report.other_bytes,
          "misses inner crossings", [refinement](const FloatSegment& s) {
            tools::RefinementCounts counts;
            return static_cast<double>(
                refinement->hits({tools::to_point(s.a_m), tools::to_point(s.b_m)}, counts).size());
          });
    }
  }

  void add_refined(uint32_t base) {
    refined_.push_back(
        std::make_unique<Refined>(baked_.view, base, baked_.view.collapse_count() + 1, 4096));
    hull::Refinement* refinement = refined_.back()->refinement.get();
    const double bytes = baked_.report.other_bytes + baked_.report.star_bytes +
                         static_cast<double>(4 * refined_.back()->words.size());
    const std::string name = "hull, boxes of stars, base " + std::to_string(base);
    add(name + ", all", baked_.seconds, bytes, "misses inner crossings",
        [refinement](const FloatSegment& s) {
          mesh::SurfaceCrossing room[256];
          return refinement->all(s.a_m, s.b_m, query::kUnlimited, {room}).found;
        });
    add(name + ", first", baked_.seconds, bytes, "exact from outside",
        [refinement](const FloatSegment& s) {
          return static_cast<double>(refinement->first(s.a_m, s.b_m, query::kUnlimited).t);
        });
  }

  void add_exact() {
    const hull::View& view = baked_.view;
    const mesh::View& mesh = model_.view;
    const double boxes = baked_.report.box_bytes,
                 nodes = static_cast<double>(mesh.nodes().size() * sizeof(mesh::Node));
    add("hull, complete, all", baked_.seconds, boxes, "exact", [&view](const FloatSegment& s) {
      mesh::SurfaceCrossing room[256];
      return hull::all_crossings(view, s.a_m, s.b_m, query::kUnlimited, {room}).found;
    });
    add("hull, complete, first", baked_.seconds, boxes, "exact", [&view](const FloatSegment& s) {
      return static_cast<double>(hull::cast_segment(view, s.a_m, s.b_m, query::kUnlimited).t);
    });
    add("AABB tree of the mesh, all", NAN, nodes, "exact", [&mesh](const FloatSegment& s) {
      mesh::SurfaceCrossing room[256];
      return mesh::all_crossings(mesh, s.a_m, s.b_m, query::kUnlimited, {room}).found;
    });
    add("AABB tree of the mesh, first", NAN, nodes, "exact", [&mesh](const FloatSegment& s) {
      return static_cast<double>(mesh::cast_segment(mesh, s.a_m, s.b_m, query::kUnlimited).t);
    });
  }

  void print(Report& report) const {
    std::vector<std::vector<std::string>> table;
    const double triangles = model_.view.head().triangle_count;
    for (size_t i = 0; i < rows_.size(); ++i)
      table.push_back({rows_[i].name, number_text(us_[i]), number_text(us_[kOf26] / us_[i]),
                       std::isnan(rows_[i].prepared_s) ? "-" : number_text(rows_[i].prepared_s),
                       number_text(rows_[i].bytes / triangles), rows_[i].remark});
    report.table(
        {"", "us a segment", "26-DOPs' time over it", "seconds to prepare", "bytes a triangle", ""},
        table);
  }

  void compare(Report& report) const {
    const std::string& name = model_.name;
    const bool is_horse = name == "horse", is_reported = is_horse || name == "rocker-arm";
    const double published = us_[kOf26] / std::min(us_[kPublished], us_[kPublished + 1]),
                 complete = us_[kOf26] / us_[kComplete],
                 over_tree = us_[kComplete] / us_[kComplete + 2];
    const char* const kWhats[] = {"26-DOPs' time over the hull as published",
                                  "26-DOPs' time over the complete hull, all",
                                  "complete hull over the AABB tree, all"};
    if (is_horse)
      report.bar("26-DOPs: nodes a segment off 3,386", name, 100 * std::fabs(visits_26_ / 3386 - 1),
                 "%", 5);
    if (is_reported) {
      report.bar_at_least(kWhats[0], name, published, "x", is_horse ? 1.8 : 1.2,
                          is_horse ? "the paper's: 2.5" : "the paper's: 1.3");
      report.bar_at_least(kWhats[1], name, complete, "x", is_horse ? 40 : 25);
      report.bar(kWhats[2], name, over_tree, "x", is_horse ? 6 : 4);
    } else {
      report.figure(kWhats[0], name, published, "x");
      report.figure(kWhats[1], name, complete, "x");
      report.figure(kWhats[2], name, over_tree, "x");
    }
    report.figure("complete hull over the AABB tree, first", name,
                  us_[kComplete + 1] / us_[kComplete + 3], "x");
  }

  const Model& model_;
  const Baked& baked_;
  const std::vector<FloatSegment> segments_;
  std::vector<std::unique_ptr<KdopTree>> trees_;
  tools::ProgressiveHull built_;
  std::vector<std::unique_ptr<tools::Refinement>> published_;
  std::vector<std::unique_ptr<Refined>> refined_;
  std::vector<Row> rows_;
  std::vector<double> us_;
  double visits_26_ = 0;
};

// Table 3 with boxes of stars: by the base's size.
void run_bases(const Model& model, const Baked& baked, Report& report) {
  const std::vector<FloatSegment> segments = across_box(model, 10000, 7);
  std::vector<std::vector<std::string>> rows;
  for (const uint32_t base : {500u, 1000u, 2000u, 4000u, 10000u}) {
    if (base < baked.view.base_hull().face_count() || base >= model.surface.faces.size()) continue;
    report.stage("boxes of stars, base " + std::to_string(base) + ", " + model.name);
    Refined refined(baked.view, base, baked.view.collapse_count() + 1, 4096);
    double counts[2][3] = {};
    uint32_t most[2] = {};
    Room room(256);
    for (const FloatSegment& s : segments) {
      const hull::RefinedCrossings all =
          refined.refinement->all(s.a_m, s.b_m, query::kUnlimited, span(room));
      const hull::RefinedHit first = refined.refinement->first(s.a_m, s.b_m, query::kUnlimited);
      const uint32_t each[2][3] = {{all.tests, all.splits, all.steps},
                                   {first.tests, first.splits, first.steps}};
      for (int kind = 0; kind < 2; ++kind) {
        most[kind] = std::max(most[kind], each[kind][1]);
        for (int i = 0; i < 3; ++i)
          counts[kind][i] += each[kind][i] / static_cast<double>(segments.size());
      }
    }
    std::vector<std::string> row{std::to_string(refined.base_hull.face_count())};
    for (int kind = 0; kind < 2; ++kind) {
      for (const double value : counts[kind]) row.push_back(number_text(value));
      row.push_back(std::to_string(most[kind]));
    }
    rows.push_back(row);
  }
  report.table({"base, faces", "all: tests", "splits", "boxes", "most splits", "first: tests",
                "splits", "boxes", "most splits"},
               rows);
}

// Between two queries: vertices collapsed again at once, or kept split for some.
void run_keeping(const Model& model, Report& report) {
  report.stage("keeping between queries, " + model.name);
  tools::HullReport ignored;
  tools::HullOptions options;
  options.target_faces = 1000;
  const tools::ProgressiveHull built = tools::build_hull(model.surface, options, ignored);
  const std::vector<FloatSegment> segments = across_box(model, 2000, 7);
  // Neighbouring rays, as a scan casts them.
  std::vector<FloatSegment> scan = segments;
  for (size_t i = 0; i < scan.size(); ++i) {
    const FloatSegment& from = segments[i / 20];
    const float shift = 0.0005f * model.view.head().diagonal_m * static_cast<float>(i % 20);
    scan[i] = {{from.a_m.x + shift, from.a_m.y, from.a_m.z},
               {from.b_m.x + shift, from.b_m.y, from.b_m.z}};
  }
  std::vector<std::vector<std::string>> rows;
  constexpr uint32_t kCoarsened = 0;
  for (const uint32_t keep : {1u, 2u, 5u, 20u, kCoarsened}) {
    std::vector<std::string> row{keep == kCoarsened ? "coarsened where not crossed"
                                                    : std::to_string(keep)};
    for (const auto* all :
         std::initializer_list<const std::vector<FloatSegment>*>{&segments, &scan}) {
      tools::Refinement refinement(built, 1000);
      refinement.keep_for(keep);
      refinement.coarsen_between(keep == kCoarsened);
      tools::RefinementCounts counts;
      const auto pass = [&] {
        double sum = 0;
        for (const FloatSegment& s : *all)
          sum += static_cast<double>(
              refinement.hits({tools::to_point(s.a_m), tools::to_point(s.b_m)}, counts).size());
        return sum;
      };
      (void)pass();
      row.push_back(number_text(static_cast<double>(counts.tests) / 2000));
      row.push_back(number_text(static_cast<double>(counts.splits) / 2000));
      row.push_back(number_text(medians_us({timed(all->size(), pass)})[0]));
    }
    rows.push_back(row);
  }
  report.table(
      {"kept for queries", "random: tests", "splits", "us", "neighbouring: tests", "splits", "us"},
      rows);
}

}  // namespace

// Platis & Theoharis 2003: tables 3 and 4 with the baked hull and the published algorithm.
void run_hull_tables(const Options& options, Report& report) {
  for (const Model& model : load_models(options)) {
    report.stage("baking a hull of " + model.name);
    const Baked baked(model, 500, 16);
    report.heading("trees and hulls (table 4), all crossings unless stated: " + model.name);
    report.stage("trees and hulls, " + model.name);
    Table4(model, baked, options.is_long ? 10000 : 2000).run(report);
    report.heading("by base size with boxes of stars (as table 3): " + model.name);
    run_bases(model, baked, report);
    report.heading(
        "vertices collapsed again at once or kept split between queries, as published, base "
        "1,000: " +
        model.name);
    run_keeping(model, report);
  }
}

}  // namespace firmtouch::lab
