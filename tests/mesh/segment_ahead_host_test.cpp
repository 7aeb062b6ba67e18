// A search that looks ahead, with triangles side by side and by blocks, tells to the bit what the one in
// turn tells: crossings, t and steps, whatever the budget, from the asset and from what is made of it.
#include <cmath>

#include "bake/mesh/bake_mesh.hpp"
#include "bake/mesh/mesh_ahead.hpp"
#include "firmtouch/mesh/crossing_takers.hpp"
#include "firmtouch/mesh/segment_search.hpp"
#include "harness/test.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;

struct Baked {
  tools::Surface surface = tools::make_part(3, 3000);
  std::vector<tools::Section> sections;
  tools::MeshAhead ahead;
  mesh::View view, lined;

  explicit Baked(const tools::TreeShape& shape) {
    tools::MeshOptions options;
    options.shape = shape;
    tools::MeshReport report;
    sections = tools::bake_mesh(surface, "part", options, report);
    CHECK(report.problem.empty());
    CHECK(mesh::open(tools::mesh_sections(sections, "part"), view).ok());
    ahead = tools::MeshAhead(view);
    lined = ahead.view();
  }
};

// Anywhere about the part, along its edges and through its corners, and far off.
class Ends {
 public:
  Ends(const Baked& baked, uint64_t seed) : baked_(baked), random_(seed) {}
  Vec3 next() {
    const mesh::Head& head = baked_.view.head();
    const double size = static_cast<double>(head.diagonal_m);
    const double reach = size * (random_.below(20) == 0 ? 1e25 : 0.6);
    if (random_.below(3) == 0)
      return baked_.surface
          .vertices[random_.below(static_cast<uint32_t>(baked_.surface.vertices.size()))];
    float at[3];
    for (uint32_t k = 0; k < 3; ++k)
      at[k] = static_cast<float>(static_cast<double>((head.low_m[k] + head.high_m[k]) / 2) +
                                 random_.between(-reach, reach));
    if (random_.below(200) == 0) at[random_.below(3)] = NAN;
    return {at[0], at[1], at[2]};
  }

 private:
  const Baked& baked_;
  tools::Random random_;
};

template <class Visitor>
struct Found {
  Visitor visitor;
  uint32_t steps = 0;
  bool is_done = false;
};

bool is_same(const mesh::Hit& a, const mesh::Hit& b) {
  return a.hit == b.hit && math::bits_of(a.t) == math::bits_of(b.t) && a.triangle == b.triangle &&
         a.enters == b.enters;
}

size_t differences(const mesh::View& view, Vec3 a_m, Vec3 b_m, query::Budget budget, size_t& hits) {
  mesh::Hit of_first, of_first_ahead, of_any, of_any_ahead;
  mesh::First first(of_first), first_ahead(of_first_ahead);
  mesh::Any any(of_any), any_ahead(of_any_ahead);
  mesh::SurfaceCrossing buffer[64], buffer_wide[64];
  mesh::All all{{buffer}}, all_ahead{{buffer_wide}};
  size_t differ = 0;
  const auto same_way = [&](auto& in_turn, auto& ahead) {
    uint32_t steps = 0, steps_ahead = 0;
    const bool done = mesh::search_in_turn(view, a_m, b_m, budget, in_turn, steps);
    const bool done_ahead = mesh::search_side_by_side(view, a_m, b_m, budget, ahead, steps_ahead);
    if (done != done_ahead || steps != steps_ahead) ++differ;
  };
  same_way(first, first_ahead);
  same_way(any, any_ahead);
  same_way(all, all_ahead);
  if (!is_same(of_first, of_first_ahead) || !is_same(of_any, of_any_ahead)) ++differ;
  if (all.crossings.found != all_ahead.crossings.found ||
      all.crossings.reported != all_ahead.crossings.reported)
    return differ + 1;
  for (uint32_t i = 0; i < all.crossings.reported; ++i)
    if (math::bits_of(buffer[i].t) != math::bits_of(buffer_wide[i].t) ||
        buffer[i].triangle != buffer_wide[i].triangle || buffer[i].enters != buffer_wide[i].enters)
      ++differ;
  hits += of_first.hit ? 1 : 0;
  return differ;
}

size_t differences(const Baked& baked, Vec3 a_m, Vec3 b_m, query::Budget budget, size_t& hits) {
  size_t differ = differences(baked.view, a_m, b_m, budget, hits);
  if constexpr (mesh::SegmentLanes::kHoldsLeaf)
    differ += differences(baked.lined, a_m, b_m, budget, hits);
  return differ;
}

void compare(const tools::TreeShape& shape, uint64_t seed) {
  const Baked baked(shape);
  Ends ends(baked, seed);
  size_t differ = 0, hits = 0;
  for (uint32_t i = 0; i < 2000; ++i) {
    const Vec3 a_m = ends.next(), b_m = ends.next();
    for (const uint32_t steps : {UINT32_MAX, i % 40})
      differ += differences(baked, a_m, b_m, {steps}, hits);
  }
  CHECK_EQ(differ, size_t{0});
  CHECK(hits > 1000);
}

// Segments from the grid's first plane that end where a box is entered, widened as boxes are: a key that
// is the limit. Where the end is no float the segment ends beside it.
void compare_at_limit(const tools::TreeShape& shape) {
  const Baked baked(shape);
  const mesh::Head& head = baked.view.head();
  size_t differ = 0, hits = 0;
  for (const mesh::Node& node : baked.view.nodes())
    for (const mesh::Side& side : node.side)
      for (uint32_t k = 0; k < 3; ++k) {
        float a_m[3], b_m[3];
        for (uint32_t axis = 0; axis < 3; ++axis) {
          const uint32_t low = side.box[axis] & 0xFFFFu, high = 32767u - (side.box[axis] >> 16);
          const double end = axis == k ? low - 0x1p-6 : (low + high) / 2.0;
          b_m[axis] =
              head.grid_low_m[axis] + static_cast<float>(end * static_cast<double>(head.cell_m));
          a_m[axis] = axis == k ? head.grid_low_m[axis] : b_m[axis];
        }
        differ += differences(baked, {a_m[0], a_m[1], a_m[2]}, {b_m[0], b_m[1], b_m[2]},
                              query::kUnlimited, hits);
      }
  CHECK_EQ(differ, size_t{0});
  CHECK(hits > 1000);
}

}  // namespace

TEST(LookingAheadTellsWhatTheSearchInTurnTells) {
  compare(tools::kFastTree, 1);
  compare(tools::kSmallTree, 2);
  compare(tools::kDesktopTree, 3);
}

TEST(LookingAheadEntersWhatIsEnteredAtTheVeryEnd) {
  compare_at_limit(tools::kFastTree);
  compare_at_limit(tools::kDesktopTree);
}
