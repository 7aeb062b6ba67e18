// Instructions of the query orders of `firmtouch-lab orders`: `orders POINTS.csv` on the
// emulator's command line. Builds the trees in the memory behind the board's asset and queries
// every 64th row cold. A row a combination:
//     BOXES | ORDER | UPPER | MEAN INSTRUCTIONS | WORST
// tools/bench/cortex-m7 --orders runs it.
#include <stdint.h>

#include "emulator/semihosting.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "lab/orders/build.hpp"
#include "lab/orders/names.hpp"
#include "target/count.hpp"
#include "target/csv_points.hpp"
#include "target/scene_views.hpp"

using namespace firmtouch;  // NOLINT: a program of the tests
namespace orders = lab::orders;

namespace {

constexpr uint32_t kMaxPoints = 256;
constexpr uint32_t kEvery = 64;
constexpr uint32_t kRing = 1u << 15;  // breadth-first with 20,000 triangles needs a third of it

math::Vec3 g_points[kMaxPoints];
orders::Pending g_waiting[kRing];
uint32_t g_empty = 0;  // cost of reading the clock twice

// Bump allocator in the emulated external memory behind the asset.
struct Arena {
  uint8_t* next;
  uint8_t* end;

  template <class T>
  T* take(uint32_t count) {
    T* const taken = reinterpret_cast<T*>(next);
    if (count > static_cast<uint32_t>(end - next) / sizeof(T)) return nullptr;
    next += (count * sizeof(T) + 15) / 16 * 16;
    return taken;
  }
};

void print_row(const char* kind, const char* order, const char* upper, uint32_t mean,
               uint32_t worst) {
  const char* const words[] = {kind, order, upper};
  for (int i = 0; i < 3; ++i) {
    hal::board_print(words[i]);
    hal::board_print(" | ");
  }
  target::print(mean, " | ");
  target::print(worst, "\n");
}

template <class K>
bool run(const char* kind, const orders::Tree<K>& tree, uint32_t points) {
  const uint32_t per_1000 = hal::clock_work_per_1000();
  for (const orders::Variant<K>& variant : orders::kVariants<K>) {
    uint64_t sum = 0;
    uint32_t worst = 0;
    for (uint32_t i = 0; i < points; ++i) {
      orders::Counters ignored;
      orders::Nearest nearest;
      const uint32_t before = hal::clock_work();
      const bool done = variant.run(tree, g_points[i], {g_waiting, kRing}, ignored, nearest);
      const uint32_t work = hal::clock_work() - before - g_empty;
      if (!done) return false;
      sum += work;
      worst = work > worst ? work : worst;
    }
    print_row(kind, orders::name_of(variant.order), orders::name_of(variant.upper),
              static_cast<uint32_t>(sum * 1000 / per_1000 / points),
              static_cast<uint32_t>(uint64_t{worst} * 1000 / per_1000));
  }
  return true;
}

template <class K>
bool plant_and_run(const char* kind, const mesh::View& view, orders::Workshop work, Arena arena,
                   uint32_t points) {
  const uint32_t nodes = view.nodes().size();
  typename K::Node* const node = arena.take<typename K::Node>(nodes);
  uint32_t* const middle = arena.take<uint32_t>(K::kWays * nodes);
  if (node == nullptr || middle == nullptr) return false;
  if constexpr (K::kWays == 4) {
    return run(kind, orders::build_wide(view, work, node, middle), points);
  } else {
    return run(kind, orders::build<K>(view, work, node, middle), points);
  }
}

uint32_t read_points(const char* path) {
  target::CsvPoints file(path);
  uint32_t points = 0, row = 0;
  for (math::Vec3 p_m; points < kMaxPoints && file.next(p_m); ++row)
    if (row % kEvery == 0) g_points[points++] = p_m;
  return points;
}

}  // namespace

int main() {
  hal::board_begin();
  const core::Bytes region = hal::board_asset();
  const target::Views views = target::open_views(region);
  char line[512];
  if (!views.verdict.ok() || !views.mesh.is_open()) {
    hal::board_print("no mesh in the asset, or a rule rejects it\n");
    return 1;
  }
  constexpr uint32_t kWord = 7;  // "orders "
  if (!hal::semihosting_command_line(line, sizeof line)) return 2;
  const uint32_t points = read_points(line + kWord);
  if (points == 0) {
    hal::board_print("no rows x,y,z in the walk\n");
    return 1;
  }
  g_empty = target::empty_work();
  const uint32_t used = (asset::stated_bytes(region) + 15) / 16 * 16;
  uint8_t* const free = const_cast<uint8_t*>(region.data()) + used;
  Arena arena{free, free + (region.size() - used)};
  const uint32_t nodes = views.mesh.nodes().size();
  const orders::Workshop work{arena.take<orders::Range>(2 * nodes), arena.take<uint32_t>(nodes)};
  bool fits = work.ranges != nullptr && work.sources != nullptr;
  fits = fits &&
         plant_and_run<orders::GridKind>(orders::kKindNames[0], views.mesh, work, arena, points);
  fits = fits &&
         plant_and_run<orders::FloatKind>(orders::kKindNames[1], views.mesh, work, arena, points);
  fits = fits &&
         plant_and_run<orders::WideKind>(orders::kKindNames[2], views.mesh, work, arena, points);
  fits = fits && plant_and_run<orders::OrientedKind>(orders::kKindNames[3], views.mesh, work, arena,
                                                     points);
  if (!fits)
    hal::board_print("the model is too large for this board: its trees or its queues do not fit\n");
  return fits ? 0 : 1;
}
