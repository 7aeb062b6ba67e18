#include "field/oracle.hpp"
#include "lab/morris_search.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"
#include "surface/shapes.hpp"

// The published search, as it is meant and as it is printed.

namespace firmtouch::tools {
namespace {

using P3 = std::array<float, 3>;

// What the print says where it is not what is meant, one by one.
struct Print {
  bool squares_the_sum;  // (dx + dy + dz)^2 for a box, not dx^2 + dy^2 + dz^2
  bool keeps_bounds;     // the bounds of one point go on for the next
};

class PrintedSearch {
 public:
  PrintedSearch(const TriangleTree& tree, Print print) : tree_(tree), print_(print) {}

  float distance2(const P3& p) {
    if (!print_.keeps_bounds) least2_ = upper2_ = 3e38f;
    to_descend_.push_back(0);
    while (!to_descend_.empty()) {
      const uint32_t node = to_descend_.front();
      to_descend_.pop_front();
      look_at(tree_.nodes()[node], p);
    }
    return least2_;
  }

 private:
  void look_at(const TriangleTree::Node& node, const P3& p) {
    if (node.count != 0) {
      const float found2 = tree_.distance2(p, node.first);
      if (found2 < least2_) least2_ = upper2_ = found2;
      return;
    }
    float best = 0, worst = 0;
    for (size_t k = 0; k < 3; ++k) {
      const float near = std::max({node.box.low[k] - p[k], p[k] - node.box.high[k], 0.0f});
      const float far = std::max(p[k] - node.box.low[k], node.box.high[k] - p[k]);
      best += print_.squares_the_sum ? near : near * near;
      worst += print_.squares_the_sum ? far : far * far;
    }
    if (print_.squares_the_sum) best *= best, worst *= worst;
    if (best > upper2_) return;
    upper2_ = std::min(upper2_, worst);
    to_descend_.push_front(node.first);
    to_descend_.push_front(node.first + 1);
  }

  const TriangleTree& tree_;
  Print print_;
  std::deque<uint32_t> to_descend_;
  float least2_ = 3e38f, upper2_ = 3e38f;
};

// Points of a small grid about the model, in their order.
std::vector<Point> points_of(const TriangleTree& tree) {
  std::vector<Point> points;
  const FloatBox box = tree.nodes()[0].box;
  for (int z = -1; z < 12; ++z)
    for (int y = -1; y < 12; ++y)
      for (int x = -1; x < 12; ++x) {
        const int at[3] = {x, y, z};
        double p[3];
        for (size_t k = 0; k < 3; ++k)
          p[k] = static_cast<double>(box.low[k]) +
                 static_cast<double>(box.high[k] - box.low[k]) * at[k] / 10;
        points.push_back(tree.origin_m() + Point{p[0], p[1], p[2]});
      }
  return points;
}

template <class Distance2>
size_t count_wrong(const Surface& surface, const TriangleTree& tree, const Distance2& distance2) {
  size_t wrong = 0;
  for (const Point& p : points_of(tree)) {
    const double truth = oracle_distance(surface, p);
    const double reported = std::sqrt(static_cast<double>(distance2(tree.local(p))));
    if (!(std::fabs(reported - truth) <= 1e-6)) ++wrong;
  }
  return wrong;
}

size_t wrong_as_printed(Print print) {
  const Surface part = make_part(1, 800);
  const TriangleTree tree(part, 1);
  PrintedSearch search(tree, print);
  return count_wrong(part, tree, [&](const P3& p) { return search.distance2(p); });
}

}  // namespace

TEST(ThePrintedFormIsWrongInEachOfItsTwoSlips) {
  CHECK_EQ(wrong_as_printed({false, false}), 0u);  // with neither the same code is right
  CHECK_GT(wrong_as_printed({true, false}), 20u);
  CHECK_GT(wrong_as_printed({false, true}), 1000u);
  CHECK_GT(wrong_as_printed({true, true}), 1000u);
}

TEST(TheMeantFormIsRightForEverySeedAndOrder) {
  const Surface part = make_part(1, 800);
  const TriangleTree tree(part, 1);
  for (const bool depth_first : {true, false}) {
    for (const uint32_t ascend : {0u, 1u, 2u, 5u, 40u}) {
      MorrisSearch search(tree, {ascend, true, depth_first});
      CHECK_EQ(count_wrong(part, tree,
                           [&](const P3& p) { return tree.distance2(p, search.nearest(p)); }),
               0u);
    }
  }
}

TEST(TheSeedSavesBoxes) {
  const Surface part = make_part(1, 800);
  const TriangleTree tree(part, 1);
  MorrisSearch seeded(tree, {2, true, true}), cold(tree, {2, false, true});
  for (const Point& p : points_of(tree)) {
    seeded.nearest(tree.local(p));
    cold.nearest(tree.local(p));
  }
  CHECK_LT(seeded.boxes_read(), cold.boxes_read());
}

TEST(TheTreesOwnSearchIsRightWithAnySeed) {
  const Surface part = make_part(2, 800);
  const TriangleTree tree(part);
  Random random(1);
  CHECK_EQ(count_wrong(
               part, tree,
               [&](const P3& p) { return tree.distance2(p, tree.nearest(p, random.below(800))); }),
           0u);
  CHECK_EQ(count_wrong(part, tree,
                       [&](const P3& p) { return tree.distance2(p, tree.nearest(p, kNoFace)); }),
           0u);
}

}  // namespace firmtouch::tools
