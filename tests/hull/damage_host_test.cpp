// A hull whose bytes were changed is refused by a rule, or stays harmless: in range, finite, within
// its budget. (The sanitizers' build runs it too.)
#include <cmath>
#include <cstring>
#include <vector>

#include "bake/hull/bake_base_hull.hpp"
#include "firmtouch/hull/base_hull_cast.hpp"
#include "firmtouch/hull/base_hull_distance.hpp"
#include "firmtouch/hull/complete_cast.hpp"
#include "firmtouch/hull/refinement.hpp"
#include "refinement_faces.hpp"
#include "small_hull.hpp"
#include "surface/random.hpp"

namespace firmtouch::tools {
namespace {

// Each section in a block of its own, so that a read beyond it is seen.
struct Apart {
  std::vector<std::vector<uint32_t>> blocks;
  hull::Sections sections;

  explicit Apart(const hull::Sections& from) {
    const auto copy = [this](core::Bytes bytes) {
      std::vector<uint32_t> block((bytes.size() + 3) / 4);
      if (!bytes.empty()) std::memcpy(block.data(), bytes.data(), bytes.size());
      blocks.push_back(std::move(block));
      return core::Bytes(reinterpret_cast<const uint8_t*>(blocks.back().data()), bytes.size());
    };
    sections = {copy(from.head),          copy(from.vertices),       copy(from.origins),
                copy(from.records),       copy(from.record_offsets), copy(from.star_boxes),
                copy(from.boxes),         copy(from.base_hull),      copy(from.mesh_head),
                copy(from.mesh_vertices), copy(from.triangles16),    {}};
  }
};

void use(const hull::View& view, Random& random) {
  uint32_t bits[hull::bit_words(128)], splits[20];
  hull::Candidate candidates[8];
  hull::Refinement refinement(view, view.base_hull(), {{bits}, {splits}, {candidates}});
  for (int i = 0; i < 10; ++i) {
    const auto in = [&] { return static_cast<float>(random.between(-2, 2)); };
    const float v[6] = {in(), in(), in(), in(), in(), in()};
    const math::Vec3 a{v[0], v[1], v[2]}, b{v[3], v[4], v[5]};
    const hull::RefinedHit hit = refinement.first(a, b, {100});
    CHECK(hit.t >= 0 && hit.t <= 1);
    CHECK(!hit.is_of_mesh || hit.triangle < view.head().mesh_triangle_count);
    mesh::SurfaceCrossing buffer[8];
    const mesh::Crossings all = hull::all_crossings(view, a, b, {100}, {buffer});
    CHECK_LE(all.steps, 100u);
    (void)refinement.all(a, b, {100}, {buffer});
    CHECK_EQ(refinement.splits().size(), 0u);
    const hull::BaseHullHit base_hull = hull::cast_base_hull(view.base_hull(), a, b, {100});
    CHECK(base_hull.t >= 0 && base_hull.t <= 1);
    const hull::BaseHullDistance near = hull::base_hull_distance(view.base_hull(), a, {100});
    CHECK(std::isfinite(near.lower_m) && std::isfinite(near.deepest_m));
    CHECK_LE(near.steps, 100u);
  }
  for (hull_test::RefinementFaces faces(view, view.base_hull(), refinement); faces.next();)
    for (const uint32_t number : faces.number) CHECK_LT(number, view.id_count());
}

}  // namespace

TEST(AChangedHullIsRefusedByARuleOrHarmless) {
  Random random(77);
  uint32_t passed = 0, refused = 0;
  for (int turn = 0; turn < 6000; ++turn) {
    test::note("turn", turn);
    hull_test::SmallHull small;
    Apart apart(small.sections);
    const uint32_t which = random.below(11);
    std::vector<uint32_t>& block = apart.blocks[which];
    uint8_t* bytes = reinterpret_cast<uint8_t*>(block.data());
    const uint32_t at = random.below(static_cast<uint32_t>(block.size() * 4));
    bytes[at] = turn % 2 == 0 ? static_cast<uint8_t>(bytes[at] ^ (1u << random.below(8)))
                              : static_cast<uint8_t>(random.below(256));
    hull::View view;
    if (!hull::open(apart.sections, view).ok()) {
      ++refused;
      continue;
    }
    ++passed;
    use(view, random);
  }
  CHECK_LT(passed, refused);
  CHECK_LT(100u, passed);
}

TEST(ATruncatedHullIsRefused) {
  hull_test::SmallHull small;
  core::Bytes* const kAll[] = {
      &small.sections.head,          &small.sections.vertices,       &small.sections.origins,
      &small.sections.records,       &small.sections.record_offsets, &small.sections.star_boxes,
      &small.sections.boxes,         &small.sections.base_hull,      &small.sections.mesh_head,
      &small.sections.mesh_vertices, &small.sections.triangles16};
  for (core::Bytes* section : kAll) {
    const core::Bytes whole = *section;
    for (uint32_t size = 0; size < whole.size(); size += 1 + size / 3) {
      *section = {whole.data(), size};
      hull::View view;
      CHECK(!hull::open(small.sections, view).ok());
    }
    *section = whole;
  }
}

}  // namespace firmtouch::tools
