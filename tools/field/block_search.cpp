#include "field/block_search.hpp"

#include <cmath>

namespace firmtouch::tools {
namespace {

using Point3 = BlockSearch::Point3;

constexpr float kTiny = 1e-37f;  // keeps 0 / 0 away

Point3 middle_of(const Point3& low, const Point3& high) {
  return {(low[0] + high[0]) * 0.5f, (low[1] + high[1]) * 0.5f, (low[2] + high[2]) * 0.5f};
}

// Eight squared distances from boxes to the box low..high.
[[gnu::always_inline]] inline Lanes gaps2(const float* boxes, const Point3& low,
                                          const Point3& high) {
  Lanes sum(0.0f);
  for (uint32_t k = 0; k < 3; ++k) {
    const Lanes below = Lanes(boxes + k * kLanes) - Lanes(high[k]);
    const Lanes above = Lanes(low[k]) - Lanes(boxes + (3 + k) * kLanes);
    const Lanes gap = larger(larger(below, above), Lanes(0.0f));
    sum = sum + gap * gap;
  }
  return sum;
}

// Eight squared lower bounds of the distance to triangles: to the disk about each. Toward a wall of
// small triangles the disks differ in distance, the boxes do not.
[[gnu::always_inline]] inline Lanes disk_gaps2(const float* disks, const Lanes3& p) {
  const Lanes3 centre{Lanes(disks), Lanes(disks + kLanes), Lanes(disks + 2 * kLanes)};
  const Lanes3 normal{Lanes(disks + 3 * kLanes), Lanes(disks + 4 * kLanes),
                      Lanes(disks + 5 * kLanes)};
  const Lanes radius(disks + 6 * kLanes);
  const Lanes3 v = p - centre;
  const Lanes height = dot(v, normal), height2 = height * height;
  const Lanes aside2 = larger(dot(v, v) - height2, Lanes(0.0f));
  const Lanes beyond = larger(square_root(aside2) - radius, Lanes(0.0f));
  return height2 + beyond * beyond;
}

[[gnu::always_inline]] inline Lanes segment2(const Lanes3& ap, const Lanes3& ab) {
  const Lanes size2 = larger(dot(ab, ab), Lanes(kTiny));
  const Lanes t = smaller(larger(dot(ap, ab) / size2, Lanes(0.0f)), Lanes(1.0f));
  const Lanes3 q = ap - ab * t;
  return dot(q, q);
}

// Eight squared distances from p to triangles, without a branch: to the plane where the foot is
// between the edges, else to the nearest edge.
[[gnu::always_inline]] inline Lanes distances2(const TriangleTree& tree, const uint32_t* which,
                                               const Lanes3& p) {
  const float* corners[kLanes];
  float last[kLanes];
  for (uint32_t lane = 0; lane < kLanes; ++lane) {
    corners[lane] = tree.triangles()[which[lane]].at;
    last[lane] = corners[lane][8];
  }
  Lanes at[kLanes];
  turn(corners, at);
  const Lanes3 a{at[0], at[1], at[2]}, b{at[3], at[4], at[5]}, c{at[6], at[7], Lanes(last)};
  const Lanes3 ab = b - a, ac = c - a, bc = c - b, ap = p - a, bp = p - b;
  const Lanes3 n = cross(ab, ac);
  const Lanes n2 = dot(n, n), zero(0.0f);
  const Lanes of_b = dot(cross(ap, ac), n), of_c = dot(cross(ab, ap), n), height = dot(ap, n);
  const Lanes to_plane = height * height / larger(n2, Lanes(kTiny));
  const Lanes to_edge = smaller(smaller(segment2(ap, ab), segment2(ap, ac)), segment2(bp, bc));
  return choose((zero < of_b) & (zero < of_c) & (of_b + of_c < n2), to_plane, to_edge);
}

}  // namespace

// The nearest so far to one point; triangles wait until there are enough for all lanes.
class BlockSearch::Best {
 public:
  Best(const TriangleTree& tree, const Point3& p, uint32_t seed)
      : tree_(tree),
        p_{Lanes(p[0]), Lanes(p[1]), Lanes(p[2])},
        best_(seed),
        least2_(tree.distance2(p, seed)) {
    set_limit();
  }

  const Lanes3& p() const { return p_; }
  /// What is farther cannot be nearer, whatever float32 lost.
  float limit2() const { return limit2_; }
  void add(uint32_t triangle) {
    waiting_[count_++] = triangle;
    if (count_ == kLanes) measure();
  }
  uint32_t finish() {
    if (count_ != 0) measure();
    return best_;
  }

 private:
  void measure() {
    for (uint32_t i = count_; i < kLanes; ++i) waiting_[i] = waiting_[0];
    alignas(32) float found2[kLanes];
    distances2(tree_, waiting_, p_).store(found2);
    const float before2 = least2_;
    for (uint32_t i = 0; i < count_; ++i)
      if (found2[i] < least2_) least2_ = found2[i], best_ = waiting_[i];
    if (least2_ < before2) set_limit();
    count_ = 0;
  }
  void set_limit() {
    const float limit = __builtin_sqrtf(least2_) + tree_.slack_m();
    limit2_ = limit * limit;
  }

  const TriangleTree& tree_;
  Lanes3 p_;
  uint32_t best_, count_ = 0;
  float least2_, limit2_ = 0;
  uint32_t waiting_[kLanes];
};

// The square of how far a triangle may be from the cube that can be nearest to a point of it: the
// seed, nearest to the cube's middle, is no farther from any point than that and half the diagonal.
float BlockSearch::reach2(const Point3& low, const Point3& high) {
  float diagonal2 = 0;
  for (size_t k = 0; k < 3; ++k) diagonal2 += (high[k] - low[k]) * (high[k] - low[k]);
  const float reach = std::sqrt(tree_.distance2(middle_of(low, high), seed)) +
                      0.5f * std::sqrt(diagonal2) + tree_.slack_m();
  return reach * reach;
}

void BlockSearch::open_block(const Point3& low, const Point3& high, BoxList& found) {
  seed = tree_.nearest(middle_of(low, high), seed);
  const float limit2 = reach2(low, high);
  found.count = 0;
  stack_.assign(1, 0);
  while (!stack_.empty()) {
    const TriangleTree::Node& node = tree_.nodes()[stack_.back()];
    stack_.pop_back();
    if (gap2(node.box, low, high) > limit2) continue;
    if (node.count == 0) {
      stack_.push_back(node.first + 1);
      stack_.push_back(node.first);
      continue;
    }
    found.reserve(found.count + node.count);
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const float* const box = tree_.boxes()[i].word;
      if (gap2(box, box + 3, low, high) <= limit2) found.triangle[found.count++] = i;
    }
  }
  found.fill(tree_.boxes());
}

template <class List>
void BlockSearch::list_within(const BoxList& from, const Point3& low, const Point3& high,
                              List& found) {
  const Point3 middle = middle_of(low, high);
  Best best(tree_, middle, seed);
  for (uint32_t at = 0; at < from.count; at += kLanes) {
    uint32_t bits = bits_of_mask(gaps2(from.group(at), middle, middle) < Lanes(best.limit2()));
    for (; bits != 0; bits &= bits - 1) {
      const uint32_t i = at + static_cast<uint32_t>(__builtin_ctz(bits));
      if (i < from.count) best.add(from.triangle[i]);
    }
  }
  seed = best.finish();
  const float limit2 = reach2(low, high);
  found.reserve(from.count);
  uint32_t* const to = found.triangle.data();
  uint32_t count = 0;
  for (uint32_t at = 0; at < from.count; at += kLanes) {
    uint32_t bits = bits_of_mask(gaps2(from.group(at), low, high) < Lanes(limit2));
    if (from.count - at < kLanes) bits &= (1u << (from.count - at)) - 1u;
    count += keep(from.triangle.data() + at, bits, to + count);
  }
  found.count = count;
}

void BlockSearch::narrow(const BoxList& from, const Point3& low, const Point3& high,
                         BoxList& found) {
  list_within(from, low, high, found);
  found.fill(tree_.boxes());
}

void BlockSearch::narrow(const BoxList& from, const Point3& low, const Point3& high,
                         DiskList& found) {
  list_within(from, low, high, found);
  found.fill(tree_.disks());
}

uint32_t BlockSearch::nearest(const DiskList& from, const Point3& p) {
  Best best(tree_, p, seed);
  for (uint32_t at = 0; at < from.count; at += kLanes) {
    uint32_t bits = bits_of_mask(disk_gaps2(from.group(at), best.p()) < Lanes(best.limit2()));
    for (; bits != 0; bits &= bits - 1) {
      const uint32_t i = at + static_cast<uint32_t>(__builtin_ctz(bits));
      if (i < from.count) best.add(from.triangle[i]);
    }
  }
  return seed = best.finish();
}

}  // namespace firmtouch::tools
