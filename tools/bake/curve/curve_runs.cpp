#include "bake/curve/curve_runs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/tree/left_filled.hpp"
#include "bake/tree/widest_axis.hpp"
#include "firmtouch/curve/derived.hpp"

namespace firmtouch::tools {
namespace {

// A run with the middle of its box, in half cells.
struct Item {
  std::array<uint32_t, 3> middle;
  uint32_t run;
};

struct Range {
  uint32_t box;
  uint32_t begin, end;
};

curve::Track track_of(const std::vector<curve::Sample>& samples, const curve::Head& head) {
  return {samples.data(), static_cast<uint32_t>(samples.size()), head.is_closed != 0};
}

curve::Box box_of(const std::vector<curve::Sample>& samples, const curve::Head& head,
                  const curve::Part& part) {
  curve::Box box;
  for (uint32_t k = 0; k < 3; ++k) {
    float low = HUGE_VALF, high = -HUGE_VALF;
    for (uint32_t s = part.first; s <= part.last; ++s) {
      const float cells = curve::cells_of(head, (&samples[s].x_m)[k], k);
      low = std::min(low, cells);
      high = std::max(high, cells);
    }
    for (uint32_t s = part.first; head.is_smooth != 0 && s < part.last; ++s) {
      const curve::Cubic c = curve::cubic_of(track_of(samples, head), s);
      for (const math::Vec3& off : {c.c1, c.c2}) {
        const float cells = curve::cells_of(head, (&samples[s].x_m)[k], (&off.x)[k], k);
        low = std::min(low, cells - 2 * curve::kPointSlack_cells);
        high = std::max(high, cells + 2 * curve::kPointSlack_cells);
      }
    }
    if (!(low >= 0 && high <= static_cast<float>(curve::kGridMax))) return {};
    box.side[k] = query::make_axis(static_cast<uint32_t>(std::floor(low)),
                                   static_cast<uint32_t>(std::ceil(high)));
  }
  return box;
}

curve::Box around(const curve::Box& a, const curve::Box& b) {
  curve::Box box;
  for (uint32_t k = 0; k < 3; ++k)
    box.side[k] = query::make_axis(std::min(query::low_of(a.side[k]), query::low_of(b.side[k])),
                                   std::max(query::high_of(a.side[k]), query::high_of(b.side[k])));
  return box;
}

void place_runs(std::vector<Item>& items, std::vector<curve::Run>& runs) {
  const auto leaves = static_cast<uint32_t>(runs.size() - 1);
  std::vector<Range> open{{0, 0, static_cast<uint32_t>(items.size())}};
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    if (range.box >= leaves) {
      const uint32_t run = items[range.begin].run, leaf = range.box - leaves;
      runs[run].leaf = leaf;
      runs[leaf].run = run;
      continue;
    }
    const uint32_t axis =
        widest_axis(items, range.begin, range.end, [](const Item& i) { return i.middle; });
    const uint32_t count = range.end - range.begin;
    const uint32_t middle = range.begin + (first_size(2 * count - 1) + 1) / 2;
    std::nth_element(items.begin() + range.begin, items.begin() + middle, items.begin() + range.end,
                     [axis](const Item& a, const Item& b) {
                       return a.middle[axis] != b.middle[axis] ? a.middle[axis] < b.middle[axis]
                                                               : a.run < b.run;
                     });
    open.push_back({curve::first_child(range.box), range.begin, middle});
    open.push_back({curve::first_child(range.box) + 1, middle, range.end});
  }
}

}  // namespace

bool choose_grid(curve::Head& head, float beyond) {
  float extent_m = 0;
  for (int k = 0; k < 3; ++k) extent_m = std::max(extent_m, head.high_m[k] - head.low_m[k]);
  head.cell_m = 0x1p-60f;
  const float least = 1.25f + 2 * beyond;
  while (head.cell_m * static_cast<float>(curve::kGridMax) < least * extent_m) head.cell_m *= 2;
  // Far from the origin the grid's low corner is rounded coarsely: more room, then coarser cells.
  for (int doubled = 0; doubled < 2; ++doubled, head.cell_m *= 2) {
    for (const float room : {0.125f, 0.1875f, 0.25f, 0.375f, 0.5f, 0.75f}) {
      for (int k = 0; k < 3; ++k) head.grid_low_m[k] = head.low_m[k] - (room + beyond) * extent_m;
      if (curve::wrong_of_grid(head) == 0) return true;
    }
  }
  return false;
}

uint32_t choose_run_levels(uint32_t sample_count) {
  constexpr uint32_t kFew = 10000;
  return sample_count < kFew ? 3 : curve::kMaxRunLevels;
}

CurveRuns build_curve_runs(const std::vector<curve::Sample>& samples, const curve::Head& head) {
  const auto sample_count = static_cast<uint32_t>(samples.size());
  const uint32_t levels = head.run_levels, parts = curve::parts_of(levels);
  const uint32_t count = curve::run_count_of(sample_count, levels);
  CurveRuns built;
  built.boxes.resize(2 * count - 1);
  built.runs.resize(count);
  built.radii.assign(size_t{count} * (parts + 1), 0);
  std::vector<curve::Box> boxes(count);
  std::vector<Item> items(count);
  for (uint32_t r = 0; r < count; ++r) {
    boxes[r] = box_of(samples, head, curve::part_of(levels, r, 0, sample_count - 1));
    for (size_t k = 0; k < 3; ++k)
      items[r].middle[k] = query::low_of(boxes[r].side[k]) + query::high_of(boxes[r].side[k]);
    items[r].run = r;
    for (uint32_t k = 0; k < parts; ++k) {
      const curve::Part part = curve::part_of(levels, r, k, sample_count - 1);
      built.radii[size_t{r} * (parts + 1) + k] =
          curve::part_radius(track_of(samples, head), head.is_smooth != 0, part.first, part.last);
    }
  }
  place_runs(items, built.runs);
  for (uint32_t leaf = 0; leaf < count; ++leaf)
    built.boxes[count - 1 + leaf] = boxes[built.runs[leaf].run];
  for (uint32_t i = count - 1; i-- > 0;) {  // children have higher numbers than their parent
    const uint32_t child = curve::first_child(i);
    built.boxes[i] = around(built.boxes[child], built.boxes[child + 1]);
  }
  return built;
}

}  // namespace firmtouch::tools
