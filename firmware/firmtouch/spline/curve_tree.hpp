#pragma once
// The leaves and capsules of curves as a query sees them, for .cpp files of this room only.
#include "firmtouch/spline/evaluation.hpp"
#include "firmtouch/spline/search.hpp"

namespace firmtouch::spline {

/// A part of a leaf.
struct CurveRange {
  float low, high;  // of the piece's s
  float start;      // where to evaluate first
};

/// from_half(), in line.
static inline float half_float(uint32_t stored) { return math::float_of(stored << 16); }

/// kFlat: of curves in a plane of one z, where z takes no part in what is computed but in a distance.
template <bool kFlat>
static inline float dot_as(math::Vec3 a, math::Vec3 b) {
  if constexpr (kFlat) return a.x * b.x + a.y * b.y;
  return dot(a, b);
}
/// At least as long as the vector.
template <bool kFlat>
static inline float size_as(math::Vec3 v) {
  if constexpr (kFlat) return (v.x < 0.0f ? -v.x : v.x) + (v.y < 0.0f ? -v.y : v.y);
  return size_of(v);
}

template <bool kFlat>
class CurveTree {
 public:
  struct Seen {
    float lower_m, share;
  };

  CurveTree(const View& model, math::Vec3 p_m)
      : pieces_(model.pieces().data()),
        coefficients_(model.coefficients().data()),
        leaves_(model.leaves().data()),
        bends_(model.bends().data()),
        capsules_(model.capsules().data()),
        points_(model.points().data()),
        base_(model.leaf_count() - 1),
        p_m_(p_m) {
    const uint32_t levels = 31u - static_cast<uint32_t>(__builtin_clz(2 * base_ + 1));
    deepest_ = (1u << levels) - 1;
    deep_count_ = 2 * base_ + 1 - deepest_;
    if constexpr (kFlat) {
      const float off_m = p_m.z - points_[0].z_m;
      height2_m2_ = off_m * off_m;
    }
  }

  /// Leaves have the last nodes, in their order in the asset.
  uint32_t last() const { return base_; }
  uint32_t leaf_of(uint32_t node) const { return node - base_; }
  uint32_t node_of(uint32_t leaf) const { return base_ + leaf; }
  bool is_leaf(uint32_t node) const { return node >= base_; }
  uint32_t piece_of(uint32_t node) const { return leaves_[node - base_].piece; }
  const Piece& piece(uint32_t index) const { return pieces_[index]; }
  const float* coefficients() const { return coefficients_; }
  const Bend& bend_of(uint32_t node) const { return bends_[node - base_]; }
  math::Vec3 query_from(const Piece& piece) const { return p_m_ - vec3_at(piece.origin_m); }

  /// Along the curve: the leaves of the deepest level come first.
  uint32_t order_of(uint32_t leaf) const {
    return leaf >= deepest_ ? leaf - deepest_ : leaf - base_ + deep_count_;
  }
  uint32_t leaf_at(uint32_t order) const {
    return order < deep_count_ ? deepest_ + order : base_ + order - deep_count_;
  }

  /// No point below the node is nearer; what of its chord is nearest. The stored radius holds what
  /// float32 loses here (with_slack()).
  Seen see(uint32_t node) const {
    const Capsule& capsule = capsules_[node];
    const Point &a = points_[capsule.first], &b = points_[capsule.last];
    math::Vec3 off{p_m_.x - a.x_m, p_m_.y - a.y_m, 0.0f}, along{b.x_m - a.x_m, b.y_m - a.y_m, 0.0f};
    if constexpr (!kFlat) {
      off.z = p_m_.z - a.z_m;
      along.z = b.z_m - a.z_m;
    }
    const float progress_m2 = dot_as<kFlat>(off, along);
    float share = 0.0f;
    if (progress_m2 > 0.0f) {
      const float length2_m2 = dot_as<kFlat>(along, along);
      share = progress_m2 < length2_m2 ? progress_m2 / length2_m2 : 1.0f;
      off.x -= along.x * share;
      off.y -= along.y * share;
      if constexpr (!kFlat) off.z -= along.z * share;
    }
    float off2_m2 = dot_as<kFlat>(off, off);
    if constexpr (kFlat) off2_m2 += height2_m2_;
    return {math::square_root(off2_m2) * (1.0f - 0x1p-20f) - half_float(capsule.radius), share};
  }

  /// Of what is below a node.
  uint32_t first_leaf(uint32_t node) const {
    while (node < base_) node = first_child(node);
    return node;
  }
  uint32_t last_leaf(uint32_t node) const {
    while (node < base_) node = first_child(node) + 1;
    return node;
  }

  /// Squared distance of the query to the piece's point that is `off_m` from it.
  float distance2(math::Vec3 off_m) const {
    const float sum_m2 = dot_as<kFlat>(off_m, off_m);
    if constexpr (kFlat) return sum_m2 + height2_m2_;
    return sum_m2;
  }

  /// A leaf, to be begun at a share of its length.
  CurveRange range_of(uint32_t node, float share) const {
    const Leaf& at = leaves_[node - base_];
    const float wide = math::float_of((128u - pieces_[at.piece].level_u) << 23);  // 2^(1 - level)
    const float low = static_cast<float>(static_cast<uint32_t>(at.index_u)) * wide - 1.0f;
    return {low, low + wide, low + wide * share};
  }

 private:
  const Piece* pieces_;
  const float* coefficients_;
  const Leaf* leaves_;
  const Bend* bends_;
  const Capsule* capsules_;
  const Point* points_;
  uint32_t base_;
  uint32_t deepest_, deep_count_;  // first leaf of the deepest level, how many there are
  float height2_m2_ = 0.0f;
  math::Vec3 p_m_;
};

}  // namespace firmtouch::spline
