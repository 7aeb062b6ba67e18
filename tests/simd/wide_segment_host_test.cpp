// The wide segment search of every level that this processor has gives the scalar search's
// crossings, t and visits, to the bit, within any budget.
#include <cmath>

#include "firmtouch/math/isa.hpp"
#include "firmtouch/mesh/segment_cast.hpp"
#include "harness/long.hpp"
#include "harness/test.hpp"
#include "mesh/baked_mesh.hpp"
#include "simd/wide_mesh.hpp"
#include "surface/make/make_cad.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;

struct Baked : mesh_test::BakedMesh {
  std::vector<simd::WideMesh> wide;  // of each level

  explicit Baked(const tools::TreeShape& shape,
                 const tools::Surface& of = tools::make_part(3, 3000))
      : BakedMesh(of, shape) {
    for (const firmtouch_simd::Level& level : firmtouch_simd::levels())
      wide.emplace_back(view, level);
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

bool is_same(const mesh::Hit& a, const mesh::Hit& b) {
  return a.hit == b.hit && math::bits_of(a.t) == math::bits_of(b.t) && a.triangle == b.triangle &&
         a.enters == b.enters && a.steps == b.steps && a.exact == b.exact;
}

// What one search answers to the three kinds of query.
struct Answers {
  mesh::Hit first, any;
  mesh::Crossings all;
  mesh::SurfaceCrossing buffer[64];
};

size_t differences(const Answers& a, const Answers& b) {
  size_t differ = (is_same(a.first, b.first) ? 0u : 1u) + (is_same(a.any, b.any) ? 0u : 1u);
  if (a.all.found != b.all.found || a.all.reported != b.all.reported ||
      a.all.steps != b.all.steps || a.all.exact != b.all.exact)
    return differ + 1;
  for (uint32_t i = 0; i < a.all.reported; ++i)
    if (math::bits_of(a.buffer[i].t) != math::bits_of(b.buffer[i].t) ||
        a.buffer[i].triangle != b.buffer[i].triangle || a.buffer[i].enters != b.buffer[i].enters)
      ++differ;
  return differ;
}

size_t differences(const Baked& baked, Vec3 a_m, Vec3 b_m, query::Budget budget, size_t& hits) {
  Answers scalar;
  scalar.first = mesh::cast_segment(baked.view, a_m, b_m, budget);
  scalar.any = mesh::any_crossing(baked.view, a_m, b_m, budget);
  scalar.all = mesh::all_crossings(baked.view, a_m, b_m, budget, {scalar.buffer});
  hits += scalar.first.hit ? 1u : 0u;
  size_t differ = 0;
  for (const simd::WideMesh& wide : baked.wide) {
    Answers other;
    other.first = wide.cast_segment(a_m, b_m, budget);
    other.any = wide.any_crossing(a_m, b_m, budget);
    other.all = wide.all_crossings(a_m, b_m, budget, {other.buffer});
    differ += differences(scalar, other);
  }
  return differ;
}

void compare(const Baked& baked, uint64_t seed) {
  const uint32_t segments = firmtouch::test::is_long() ? 2000 : 200;
  Ends ends(baked, seed);
  size_t differ = 0, hits = 0;
  for (uint32_t i = 0; i < segments; ++i) {
    const Vec3 a_m = ends.next(), b_m = ends.next();
    for (const uint32_t steps : {UINT32_MAX, i % 40})
      differ += differences(baked, a_m, b_m, {steps}, hits);
  }
  CHECK_EQ(differ, size_t{0});
  CHECK(hits > segments / 2);
}

// Segments from the grid's first plane that end where a widened box is entered, so that its key is
// the limit, or at the next float.
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

TEST(EveryLevel_HasTheCrossingsOfTheScalarSearch) {
  compare(Baked(tools::kFastTree), 1);
  compare(Baked(tools::kSmallTree), 2);
  compare(Baked(tools::kDesktopTree), 3);
}

TEST(EveryLevel_HasTheCrossingsOfTheScalarSearch_TurnedBoxes) {
  const Baked baked(tools::kFastTree, tools::to_surface(tools::make_cad(tools::kCadKinds)));
  CHECK(baked.view.box_frame() != nullptr);
  compare(baked, 4);
}

TEST(EveryLevel_EntersBoxesAtTheEndOfTheSegment) {
  compare_at_limit(tools::kFastTree);
  compare_at_limit(tools::kDesktopTree);
}
