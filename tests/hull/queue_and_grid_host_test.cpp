#include <algorithm>
#include <map>

#include "../surface/shapes.hpp"
#include "harness/test.hpp"
#include "hull/collapse_queue.hpp"
#include "hull/progressive_hull.hpp"
#include "surface/random.hpp"

namespace firmtouch::tools {

TEST(BothQueues_ReturnTheSmallestKey_AfterAnyChange) {
  constexpr uint32_t kEdges = 60;
  for (const QueueKind kind : {QueueKind::kTree, QueueKind::kHeap}) {
    Random random(4);
    const std::unique_ptr<CollapseQueue> queue = make_queue(kind, kEdges);
    std::map<uint32_t, double> wanted;
    for (int k = 0; k < 20000; ++k) {
      test::note("step", k);
      const uint32_t edge = random.below(kEdges), what = random.below(4);
      CHECK_EQ(queue->has(edge), wanted.count(edge) == 1);
      if (what < 2) {
        const double key = random.below(20);  // many are equal
        queue->put(edge, key);
        wanted[edge] = key;
      } else if (what == 2) {
        queue->remove(edge);
        wanted.erase(edge);
      } else if (!wanted.empty()) {
        const auto least =
            std::min_element(wanted.begin(), wanted.end(), [](const auto& a, const auto& b) {
              return a.second < b.second || (!(b.second < a.second) && a.first < b.first);
            });
        CHECK_EQ(queue->pop(), least->first);
        wanted.erase(least);
      }
      CHECK_EQ(queue->is_empty(), wanted.empty());
    }
  }
}

TEST(Grid_EveryPointIsAFloat_ModelFits) {
  for (const uint32_t bits : {22u, 16u}) {
    for (const float away : {0.0f, 0.3f, 70.0f, 9000.0f}) {
      for (const float half : {1.0f, 0.0173f}) {
        const Surface body = cube({away, -away, 0.1f}, half);
        const HullGrid grid = grid_for(body, bits);
        const double steps = static_cast<double>((1u << bits) - 1), cell = grid.cell_m;
        const double low[3] = {grid.low_m.x, grid.low_m.y, grid.low_m.z};
        for (int k = 0; k < 3; ++k) {
          const auto at = [&](const math::Vec3& v) {
            return static_cast<double>(k == 0 ? v.x : k == 1 ? v.y : v.z);
          };
          for (const math::Vec3& v : body.vertices) {
            CHECK_LE(low[k] + 0.24 * static_cast<double>(half), at(v));
            CHECK_LE(at(v), low[k] + steps * cell - 0.24 * static_cast<double>(half));
          }
          Random random(6);
          for (int i = 0; i < 100; ++i) {
            const double step = i == 0 ? 0 : i == 1 ? steps : std::floor(random.uniform() * steps);
            const double value = low[k] + step * cell;
            CHECK_EQ(static_cast<double>(static_cast<float>(value)), value);
          }
        }
        // Rounding moves a point by half a cell at most.
        Random random(7);
        for (int i = 0; i < 100; ++i) {
          const Point p = to_point(body.vertices[0]) +
                          Point{random.uniform(), random.uniform(), random.uniform()} *
                              static_cast<double>(half);
          math::Vec3 snapped;
          CHECK(grid.snap(p, snapped));
          const Point d = to_point(snapped) - p;
          CHECK_LE(std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)}), 0.5000001 * cell);
        }
        math::Vec3 off;
        CHECK(!grid.snap({low[0] - cell, low[1], low[2]}, off));
        CHECK(!grid.snap({low[0], low[1] + (steps + 1) * cell, low[2]}, off));
      }
    }
  }
}

}  // namespace firmtouch::tools
