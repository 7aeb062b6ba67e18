// Instructions of segment casts against the hull of the board's asset; its base hull is copied to
// RAM first. Segments join two sides of a box twice the mesh's. A row a segment:
//     BASE FIRST COMPLETE VISITS_BASE SPLITS HIT_BASE HIT
// (instructions of the first crossing of the base hull, of the refinement with 256 entries, of the
// complete hull). tools/bench/cortex-m7-hull runs it and adds up.
#include <stdint.h>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hull/base_hull_cast.hpp"
#include "firmtouch/hull/complete_cast.hpp"
#include "firmtouch/hull/loader.hpp"
#include "firmtouch/hull/refinement.hpp"
#include "target/count.hpp"

using namespace firmtouch;  // NOLINT: a program of the tests

namespace {

constexpr uint32_t kSegments = 2000;
uint32_t g_base_hull[8192];
uint32_t g_bits[hull::bit_words(65536)];
uint32_t g_split[256];
hull::Candidate g_candidates[64];

uint32_t g_random = 7;
float random_in(float low, float high) {
  g_random = g_random * 1664525u + 1013904223u;
  const volatile float share = (high - low) * static_cast<float>(g_random >> 8) * 0x1p-24f;
  return low + share;
}
math::Vec3 on_side(const mesh::Head& head, uint32_t side) {
  float p[3];
  for (uint32_t k = 0; k < 3; ++k) {
    const float half = (head.high_m[k] - head.low_m[k]) * 0.5f, low = head.low_m[k] - half,
                high = head.high_m[k] + half;
    p[k] = k != side / 2 ? random_in(low, high) : side % 2 == 0 ? low : high;
  }
  return {p[0], p[1], p[2]};
}

void run(const hull::View& view, const hull::BaseHull& base_hull) {
  hull::Refinement refinement(view, base_hull, {{g_bits}, {g_split}, {g_candidates}});
  const uint32_t empty = target::empty_work();
  for (uint32_t i = 0; i < kSegments; ++i) {
    const uint32_t from = (g_random >> 12) % 6;
    const math::Vec3 a_m = on_side(view.mesh_head(), from);
    const math::Vec3 b_m = on_side(view.mesh_head(), (from + 1 + (g_random >> 12) % 5) % 6);
    const uint32_t begin = hal::clock_work();
    const hull::BaseHullHit of_base_hull =
        hull::cast_base_hull(base_hull, a_m, b_m, query::kUnlimited);
    const uint32_t base_hull_end = hal::clock_work();
    const hull::RefinedHit first = refinement.first(a_m, b_m, query::kUnlimited);
    const uint32_t first_end = hal::clock_work();
    const mesh::Hit hit = hull::cast_segment(view, a_m, b_m, query::kUnlimited);
    const uint32_t end = hal::clock_work();
    target::print(target::instructions(base_hull_end - begin - empty), " ");
    target::print(target::instructions(first_end - base_hull_end - empty), " ");
    target::print(target::instructions(end - first_end - empty), " ");
    target::print(of_base_hull.steps, " ");
    target::print(first.splits, of_base_hull.hit ? " 1" : " 0");
    hal::board_print(hit.hit ? " 1\n" : " 0\n");
  }
}

}  // namespace

int main() {
  hal::board_begin();
  const core::Bytes region = hal::board_asset();
  const uint32_t bytes = asset::stated_bytes(region);
  asset::Container file;
  hull::View view;
  hull::BaseHull base_hull;
  bool is_sound = asset::open({region.data(), bytes != 0 ? bytes : region.size()}, file).ok();
  const uint32_t at = is_sound ? file.next_of_type(hull::kHeadSection) : asset::kNoSection;
  is_sound = at != asset::kNoSection && asset::open_geometry(file, file.name(at), view).ok() &&
             hull::bit_words(view.collapse_count()) <= sizeof g_bits / 4;
  if (is_sound) {
    const uint32_t resident = view.base_hull().resident_bytes();
    is_sound = resident <= sizeof g_base_hull;
    const core::Bytes stored = file.find(hull::kBaseHullSection, file.name(at));
    if (is_sound) __builtin_memcpy(g_base_hull, stored.data(), resident);
    base_hull =
        view.base_hull().resident({reinterpret_cast<const uint8_t*>(g_base_hull), resident});
    is_sound = is_sound && base_hull.is_open();
  }
  if (!is_sound) {
    hal::board_print("no hull in the asset, or a rule rejects it, or it is too large\n");
    return 1;
  }
  run(view, base_hull);
  return 0;
}
