#include <vector>

#include "bake/hull/bake_base_hull.hpp"
#include "cli/failure.hpp"
#include "cli/queries.hpp"
#include "cli/timing.hpp"
#include "firmtouch/hull/complete_cast.hpp"
#include "firmtouch/hull/ray.hpp"
#include "firmtouch/hull/refinement.hpp"
#include "firmtouch/hull/triangle_cast.hpp"

namespace firmtouch::cli {
namespace {

struct Corners {
  math::Vec3 at_m[3];
};

// How a segment is answered.
class HullQuery {
 public:
  virtual ~HullQuery() = default;
  virtual mesh::Hit first(math::Vec3 a_m, math::Vec3 b_m) = 0;
  /// Every crossing in order of t, none left out for want of room.
  core::Span<const mesh::SurfaceCrossing> all(math::Vec3 a_m, math::Vec3 b_m) {
    Found found = cross(a_m, b_m);
    if (found.count > room_.size()) {
      room_.resize(found.count);
      found = cross(a_m, b_m);
    }
    if (!found.exact) ++cut_short_;
    return {room_.data(), found.count};
  }
  /// Of how many rows the work ended before all of their crossings were found.
  size_t cut_short() const { return cut_short_; }

 protected:
  struct Found {
    uint32_t count;
    bool exact;
  };
  virtual Found cross(math::Vec3 a_m, math::Vec3 b_m) = 0;
  core::Span<mesh::SurfaceCrossing> room() {
    return {room_.data(), static_cast<uint32_t>(room_.size())};
  }

 private:
  std::vector<mesh::SurfaceCrossing> room_ = std::vector<mesh::SurfaceCrossing>(64);
  size_t cut_short_ = 0;
};

class Complete : public HullQuery {
 public:
  Complete(const hull::View& view, query::Budget budget) : view_(view), budget_(budget) {}
  mesh::Hit first(math::Vec3 a_m, math::Vec3 b_m) override {
    return hull::cast_segment(view_, a_m, b_m, budget_);
  }

 protected:
  Found cross(math::Vec3 a_m, math::Vec3 b_m) override {
    const auto all = hull::all_crossings(view_, a_m, b_m, budget_, room());
    return {all.found, all.exact};
  }

 private:
  const hull::View& view_;
  query::Budget budget_;
};

class Refined : public HullQuery {
 public:
  Refined(const hull::View& view, const hull::BaseHull& base_hull, query::Budget budget)
      : bits_(hull::bit_words(view.collapse_count())),
        splits_(view.collapse_count() + 1),
        candidates_(4096),
        refinement_(view, base_hull, {span(bits_), span(splits_), span(candidates_)}),
        budget_(budget) {}
  mesh::Hit first(math::Vec3 a_m, math::Vec3 b_m) override {
    const hull::RefinedHit hit = refinement_.first(a_m, b_m, budget_);
    return {hit.hit,    hit.t,     hit.is_of_mesh ? hit.triangle : UINT32_MAX,
            hit.enters, hit.steps, hit.exact};
  }

  hull::RefinedCrossings crossed(const math::Vec3 (&corner_m)[3],
                                 core::Span<mesh::SurfaceCrossing> room) {
    return refinement_.all(corner_m, budget_, room);
  }

 protected:
  Found cross(math::Vec3 a_m, math::Vec3 b_m) override {
    const hull::RefinedCrossings all = refinement_.all(a_m, b_m, budget_, room());
    return {all.found, all.exact};
  }

 private:
  template <class T>
  static core::Span<T> span(std::vector<T>& items) {
    return {items.data(), static_cast<uint32_t>(items.size())};
  }
  std::vector<uint32_t> bits_, splits_;
  std::vector<hull::Candidate> candidates_;
  hull::Refinement refinement_;
  query::Budget budget_;
};

void answer(HullQuery& hull_query, const LoadedHull& hull, CsvTable& table,
            const Arguments& arguments) {
  const bool is_ray = primitive_of(arguments) == "ray";
  const hull::Head& head = hull.view.head();
  const auto line_of = [&](size_t i) {  // a ray's reach, or 1
    const float* row = table.row(i);
    const math::Vec3 a_m{row[0], row[1], row[2]}, b{row[3], row[4], row[5]};
    hull::RaySegment line{a_m, b, 1};
    if (is_ray && !hull::segment_of_ray(head.low_m, head.high_m, a_m, b, line))
      fail_input("standard input, row " + std::to_string(i + 1) +
                 ": a ray without a direction, or too far off; give dx,dy,dz that are not all 0");
    return line;
  };
  if (arguments.has("--time")) {
    std::vector<hull::RaySegment> lines;
    for (size_t i = 0; i < table.rows(); ++i) lines.push_back(line_of(i));
    print_time(table.rows(), arguments, [&] {
      float sum = 0;
      for (const hull::RaySegment& line : lines) {
        if (!arguments.has("--all")) {
          sum += hull_query.first(line.from_m, line.to_m).t;
          continue;
        }
        for (const mesh::SurfaceCrossing& c : hull_query.all(line.from_m, line.to_m)) sum += c.t;
      }
      return sum;
    });
    return;
  }
  if (arguments.has("--all")) {
    Rows<std::tuple<size_t, float, uint32_t>> rows({"segment", "t", "triangle"}, arguments);
    for (size_t i = 0; table.has(i); ++i) {
      const hull::RaySegment line = line_of(i);
      for (const mesh::SurfaceCrossing& c : hull_query.all(line.from_m, line.to_m))
        rows.add({i, c.t * line.reach, hull.source_of(c.triangle)});
    }
    rows.finish();
    return warn_cut_short(hull_query.cut_short());
  }
  Rows<std::tuple<bool, float, int64_t, uint32_t, bool>> rows(
      {"hit", "t", "triangle", "steps", "exact"}, arguments);
  for (size_t i = 0; table.has(i); ++i) {
    const hull::RaySegment line = line_of(i);
    const mesh::Hit hit = hull_query.first(line.from_m, line.to_m);
    const bool is_of_mesh = hit.hit && hit.triangle != UINT32_MAX;
    const int64_t triangle = is_of_mesh ? int64_t{hull.source_of(hit.triangle)} : -1;
    rows.add({hit.hit, hit.t * line.reach, triangle, hit.steps, hit.exact});
  }
  rows.finish();
}

// Of a triangle's query.
struct Effort {
  uint32_t steps;
  bool exact;
};

// The lowest triangle that each row's crosses, or all of them.
template <class Query>
void answer_triangles(const LoadedHull& hull, CsvTable& table, const Arguments& arguments,
                      Query query_one) {
  const auto corners = [&](size_t i) {
    const float* row = table.row(i);
    return Corners{{{row[0], row[1], row[2]}, {row[3], row[4], row[5]}, {row[6], row[7], row[8]}}};
  };
  std::vector<uint32_t> met;
  if (arguments.has("--time")) {
    print_time(table.rows(), arguments, [&] {
      float sum = 0;
      for (size_t i = 0; i < table.rows(); ++i) {
        (void)query_one(corners(i), met);
        sum += static_cast<float>(met.size());
      }
      return sum;
    });
    return;
  }
  if (arguments.has("--all")) {
    Rows<std::tuple<size_t, uint32_t>> rows({"asked", "triangle"}, arguments);
    size_t cut_short = 0;
    for (size_t i = 0; table.has(i); ++i) {
      if (!query_one(corners(i), met).exact) ++cut_short;
      for (const uint32_t triangle : met) rows.add({i, hull.source_of(triangle)});
    }
    rows.finish();
    return warn_cut_short(cut_short);
  }
  Rows<std::tuple<bool, int64_t, uint32_t, bool>> rows({"hit", "triangle", "steps", "exact"},
                                                       arguments);
  for (size_t i = 0; table.has(i); ++i) {
    const Effort effort = query_one(corners(i), met);
    rows.add({!met.empty(), met.empty() ? -1 : int64_t{hull.source_of(met[0])}, effort.steps,
              effort.exact});
  }
  rows.finish();
}

bool is_refined(const Arguments& arguments) {
  return arguments.choice("--mode", "complete", {"complete", "refine"}) == "refine";
}

}  // namespace

std::string primitive_of(const Arguments& arguments) {
  return arguments.choice("--primitive", "segment", {"segment", "ray", "triangle"});
}

void check_hull_options(const Arguments& arguments) {
  (void)primitive_of(arguments);
  (void)arguments.count("--base", 4, 4, UINT32_MAX);
  if (!is_refined(arguments) && arguments.has("--base"))
    fail_usage("query: --base has no meaning for --mode complete; leave it out");
}

void query_hull(const LoadedHull& hull, CsvTable table, const Arguments& arguments) {
  const bool is_triangle = primitive_of(arguments) == "triangle";
  const query::Budget budget = budget_of(arguments);
  const uint32_t triangles = hull.view.head().mesh_triangle_count;
  if (is_triangle && !is_refined(arguments)) {
    return answer_triangles(hull, table, arguments, [&](const Corners& c, auto& met) {
      met.resize(triangles);
      const hull::TriangleHits reported =
          hull::all_crossed(hull.view, c.at_m, budget, {met.data(), triangles});
      met.resize(reported.reported);
      return Effort{reported.steps, reported.exact};
    });
  }
  if (!is_refined(arguments)) {
    Complete complete(hull.view, budget);
    return answer(complete, hull, table, arguments);
  }
  const hull::BaseHull& coarsest = hull.view.base_hull();
  const uint32_t base = arguments.count("--base", coarsest.face_count(), 4, UINT32_MAX);
  if (base < coarsest.face_count()) {
    fail_input("the hull is baked down to " + std::to_string(coarsest.face_count()) +
               " faces, and --base requests " + std::to_string(base) +
               ": request more, or bake with a lower --hull-faces");
  }
  const std::vector<uint32_t> words = tools::cut_base_hull(hull.view, base);
  if (words.empty()) {
    fail_input("--base " + std::to_string(base) + " is too fine: a shell numbers " +
               std::to_string(hull::kMaxBaseHullVertices) + " vertices; request fewer faces");
  }
  hull::BaseHull base_hull;
  const core::Verdict verdict = hull::open_base_hull(
      {reinterpret_cast<const uint8_t*>(words.data()), static_cast<uint32_t>(4 * words.size())},
      hull.view, base_hull);
  if (!verdict.ok())
    fail_input("the hull of " + std::to_string(base) + " faces breaks rule R" +
               std::to_string(verdict.rule));
  Refined refined(hull.view, base_hull, budget);
  if (is_triangle) {
    std::vector<mesh::SurfaceCrossing> room(triangles);
    return answer_triangles(hull, table, arguments, [&](const Corners& c, auto& met) {
      const hull::RefinedCrossings reported = refined.crossed(c.at_m, {room.data(), triangles});
      met.clear();
      for (uint32_t i = 0; i < reported.reported; ++i) met.push_back(room[i].triangle);
      return Effort{reported.steps, reported.exact};
    });
  }
  answer(refined, hull, table, arguments);
}

}  // namespace firmtouch::cli
