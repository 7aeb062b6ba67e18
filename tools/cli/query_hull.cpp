#include <algorithm>
#include <cstdio>
#include <vector>

#include "bake/bake_shell.hpp"
#include "cli/failure.hpp"
#include "cli/queries.hpp"
#include "cli/timing.hpp"
#include "firmtouch/hull/complete_cast.hpp"
#include "firmtouch/hull/refinement.hpp"

namespace firmtouch::cli {
namespace {

// How a segment is answered.
class Asked {
 public:
  virtual ~Asked() = default;
  virtual mesh::Hit first(math::Vec3 a_m, math::Vec3 b_m) = 0;
  /// Every crossing in order of t, none left out for want of room.
  core::Span<const mesh::SurfaceCrossing> all(math::Vec3 a_m, math::Vec3 b_m) {
    uint32_t found = ask(a_m, b_m);
    if (found > room_.size()) {
      room_.resize(found);
      found = ask(a_m, b_m);
    }
    return {room_.data(), found};
  }

 protected:
  virtual uint32_t ask(math::Vec3 a_m, math::Vec3 b_m) = 0;
  core::Span<mesh::SurfaceCrossing> room() {
    return {room_.data(), static_cast<uint32_t>(room_.size())};
  }

 private:
  std::vector<mesh::SurfaceCrossing> room_ = std::vector<mesh::SurfaceCrossing>(64);
};

class Complete : public Asked {
 public:
  Complete(const hull::View& view, query::Budget budget) : view_(view), budget_(budget) {}
  mesh::Hit first(math::Vec3 a_m, math::Vec3 b_m) override {
    return hull::cast_segment(view_, a_m, b_m, budget_);
  }

 protected:
  uint32_t ask(math::Vec3 a_m, math::Vec3 b_m) override {
    return hull::all_crossings(view_, a_m, b_m, budget_, room()).found;
  }

 private:
  const hull::View& view_;
  query::Budget budget_;
};

class Refined : public Asked {
 public:
  Refined(const hull::View& view, const hull::Shell& shell, query::Budget budget)
      : bits_(hull::bit_words(view.collapse_count())),
        undone_(view.collapse_count() + 1),
        candidates_(4096),
        refinement_(view, shell, {span(bits_), span(undone_), span(candidates_)}),
        budget_(budget) {}
  mesh::Hit first(math::Vec3 a_m, math::Vec3 b_m) override {
    const hull::RefinedHit hit = refinement_.first(a_m, b_m, budget_);
    return {hit.hit,    hit.t,     hit.is_of_mesh ? hit.triangle : UINT32_MAX,
            hit.enters, hit.steps, hit.exact};
  }

 protected:
  uint32_t ask(math::Vec3 a_m, math::Vec3 b_m) override {
    return refinement_.all(a_m, b_m, budget_, room()).found;
  }

 private:
  template <class T>
  static core::Span<T> span(std::vector<T>& items) {
    return {items.data(), static_cast<uint32_t>(items.size())};
  }
  std::vector<uint32_t> bits_, undone_;
  std::vector<hull::Candidate> candidates_;
  hull::Refinement refinement_;
  query::Budget budget_;
};

void answer(Asked& asked, const LoadedHull& hull, const CsvTable& table,
            const Arguments& arguments) {
  const auto from = [&](size_t i) {
    const float* row = table.row(i);
    return math::Vec3{row[0], row[1], row[2]};
  };
  const auto to = [&](size_t i) {
    const float* row = table.row(i);
    return math::Vec3{row[3], row[4], row[5]};
  };
  const bool all = arguments.has("--all");
  if (arguments.has("--time")) {
    print_time(table.rows(), [&] {
      float sum = 0;
      for (size_t i = 0; i < table.rows(); ++i) {
        if (!all) sum += asked.first(from(i), to(i)).t;
        if (all)
          for (const mesh::SurfaceCrossing& c : asked.all(from(i), to(i))) sum += c.t;
      }
      return sum;
    });
    return;
  }
  std::puts(all ? "segment,t,triangle" : "hit,t,triangle,steps");
  for (size_t i = 0; i < table.rows(); ++i) {
    if (all) {
      for (const mesh::SurfaceCrossing& c : asked.all(from(i), to(i)))
        std::printf("%zu,%.9g,%u\n", i, static_cast<double>(c.t), hull.source_of(c.triangle));
      continue;
    }
    const mesh::Hit hit = asked.first(from(i), to(i));
    const bool is_of_mesh = hit.hit && hit.triangle != UINT32_MAX;
    const int64_t triangle = is_of_mesh ? int64_t{hull.source_of(hit.triangle)} : -1;
    std::printf("%d,%.9g,%lld,%u\n", hit.hit ? 1 : 0, static_cast<double>(hit.t),
                static_cast<long long>(triangle), hit.steps);
  }
}

bool is_refined(const Arguments& arguments) {
  return arguments.choice("--mode", "complete", {"complete", "refine"}) == "refine";
}

}  // namespace

void check_hull_options(const Arguments& arguments) {
  (void)arguments.count("--base", 4, 4, UINT32_MAX);
  if (!is_refined(arguments) && arguments.has("--base"))
    fail_usage("query: --base has no meaning for --mode complete; leave it out");
}

void query_hull(const LoadedHull& hull, const CsvTable& table, const Arguments& arguments) {
  if (!is_refined(arguments)) {
    Complete complete(hull.view, budget_of(arguments));
    return answer(complete, hull, table, arguments);
  }
  const hull::Shell& coarsest = hull.view.shell();
  const uint32_t base = arguments.count("--base", coarsest.face_count(), 4, UINT32_MAX);
  if (base < coarsest.face_count()) {
    fail_input("the hull is baked down to " + std::to_string(coarsest.face_count()) +
               " faces, and --base asks for " + std::to_string(base) +
               ": ask for more, or bake with a lower --hull-faces");
  }
  const std::vector<uint32_t> words = tools::cut_shell(hull.view, base);
  if (words.empty()) {
    fail_input("--base " + std::to_string(base) + " is too fine: a shell numbers " +
               std::to_string(hull::kMostShellVertices) + " vertices; ask for fewer faces");
  }
  hull::Shell shell;
  const core::Verdict verdict = hull::open_shell(
      {reinterpret_cast<const uint8_t*>(words.data()), static_cast<uint32_t>(4 * words.size())},
      hull.view, shell);
  if (!verdict.ok())
    fail_input("the hull of " + std::to_string(base) + " faces breaks rule R" +
               std::to_string(verdict.rule));
  Refined refined(hull.view, shell, budget_of(arguments));
  answer(refined, hull, table, arguments);
}

}  // namespace firmtouch::cli
