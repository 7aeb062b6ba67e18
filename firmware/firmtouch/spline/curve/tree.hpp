#pragma once
// The leaves and capsules of curves as a query sees them, for .cpp files of this module only.
#include "firmtouch/spline/curve/point.hpp"
#include "firmtouch/spline/search.hpp"

namespace firmtouch::spline {

/// A part of a piece.
struct CurveRange {
  float low, high;  // of the piece's s
  float start;      // where to evaluate first
};

class CurveTree {
 public:
  struct Seen {
    float lower_m, share;
  };

  CurveTree(const View& model, math::Vec3 p_m)
      : pieces_(model.pieces().data()),
        piece_count_(model.pieces().size()),
        coefficients_(model.coefficients().data()),
        leaves_(model.leaves().data()),
        bends_(model.curve_bends().data()),
        radii_(model.curve_radii().data()),
        points_(model.points().data()),
        heights_m_(model.is_flat() ? &pieces_->origin_m[2] : model.heights_m().data()),
        height_mask_(model.is_flat() ? 0 : UINT32_MAX),
        levels_(model.leaf_count()),
        unit_(math::bits_of(model.head().radius_unit_m)),
        p_m_(p_m) {}

  /// Leaves have the last nodes, as they follow along the curve.
  uint32_t last() const { return levels_.leaf_count - 1; }
  uint32_t leaf_of(uint32_t node) const { return node - levels_.first_node(); }
  uint32_t node_of(uint32_t leaf) const { return levels_.first_node() + leaf; }
  bool is_leaf(uint32_t node) const { return node >= levels_.first_node(); }
  CurveLevels::Leaves below(uint32_t node) const { return levels_.below(node); }
  const CurveLevels& levels() const { return levels_; }

  /// kNoLeaf where the leaf is none.
  uint32_t piece_of(uint32_t leaf) const { return leaves_[leaf]; }
  uint32_t piece_count() const { return piece_count_; }
  const Piece& piece(uint32_t index) const { return pieces_[index]; }
  CurvePoint point_at(const Piece& piece, float s) const {
    if (piece.degree_u == 3 && piece.is_rational == 0)
      return cubic_at(coefficients_ + piece.coefficients, 3, s);
    return evaluate(piece, coefficients_, s);
  }
  const CurveBend& bend_of(uint32_t piece) const { return bends_[piece]; }
  math::Vec3 query_from(const Piece& piece) const { return p_m_ - vec3_at(piece.origin_m); }

  /// Of a chord, by the vectors from its ends to the query: no point within the radius of it is
  /// nearer, and its nearest point. The stored radius holds what float32 loses here (with_slack()).
  /// kIsFlat: both ends have one z, and nothing of that is computed twice.
  template <bool kIsFlat = false>
  static Seen see(math::Vec3 off_m, math::Vec3 off_end_m, float radius_m) {
    const math::Vec3 along = off_m - off_end_m;
    const float progress_m2 = product<kIsFlat>(off_m, along);
    float share = 0.0f;
    if (progress_m2 > 0.0f) {
      const float length2_m2 = product<kIsFlat>(along, along);
      share = progress_m2 < length2_m2 ? progress_m2 / length2_m2 : 1.0f;
      off_m.x -= along.x * share;
      off_m.y -= along.y * share;
      if (!kIsFlat) off_m.z -= along.z * share;
    }
    return {math::length(off_m) * (1.0f - 0x1p-20f) - radius_m, share};
  }
  Seen see(uint32_t node) const {
    const CurveLevels::Leaves under = levels_.below(node);
    return see(off_m(under.first), off_m(under.end), radius_m(node));
  }
  /// The chords of nodes next to each other, one after the other.
  template <bool kIsFlat>
  class Chords {
   public:
    /// Pre: the node is there.
    Chords(const CurveTree& tree, uint32_t node, uint32_t below)
        : tree_(tree),
          wide_(1u << below),
          leaf_((node << below) - tree.levels_.first_node()),
          radius_(tree.radii_ + node - 1),
          off_m_(tree.off_m(leaf_)) {}
    Seen next() {
      const math::Vec3 from_m = off_m_;
      leaf_ += wide_;
      if (leaf_ > tree_.levels_.leaf_count) leaf_ = tree_.levels_.leaf_count;
      const Point& end = tree_.points_[leaf_];
      off_m_.x = tree_.p_m_.x - end.x_m;
      off_m_.y = tree_.p_m_.y - end.y_m;
      if (!kIsFlat) off_m_.z = tree_.p_m_.z - tree_.heights_m_[leaf_];
      const uint32_t byte = *radius_++;
      return see<kIsFlat>(from_m, off_m_, math::float_of(tree_.unit_ + (byte << 20)));
    }

   private:
    const CurveTree& tree_;
    uint32_t wide_, leaf_;
    const uint8_t* radius_;
    math::Vec3 off_m_;
  };

  bool is_flat() const { return height_mask_ == 0; }
  /// From a point between leaves to the query.
  math::Vec3 off_m(uint32_t point) const {
    const Point& a = points_[point];
    return {p_m_.x - a.x_m, p_m_.y - a.y_m, p_m_.z - heights_m_[point & height_mask_]};
  }
  float radius_m(uint32_t node) const {
    return math::float_of(unit_ + (static_cast<uint32_t>(radii_[node - 1]) << 20));
  }

  /// Of a leaf that is one, to be begun at a share of its length.
  CurveRange range_of(uint32_t leaf, float share) const {
    const uint32_t piece = leaves_[leaf];
    const float wide = width_of(piece);
    const float low = end_of(piece, leaf, wide);
    return {low, low + wide, low + wide * share};
  }
  /// The leaf of a piece that holds a place of it.
  uint32_t leaf_at(uint32_t piece, float s) const {
    const uint32_t level = pieces_[piece].level_u;
    const auto index = static_cast<uint32_t>((s + 1.0f) * math::float_of((126u + level) << 23));
    const uint32_t most = (1u << level) - 1;
    return bends_[piece].first_leaf + (index < most ? index : most);
  }
  uint32_t first_of(uint32_t piece) const { return bends_[piece].first_leaf; }
  uint32_t last_of(uint32_t piece) const {
    return bends_[piece].first_leaf + (1u << pieces_[piece].level_u) - 1;
  }
  /// Of a piece's leaves, by its s: 2^(1 - level), and where one begins.
  float width_of(uint32_t piece) const {
    return math::float_of((128u - pieces_[piece].level_u) << 23);
  }
  float end_of(uint32_t piece, uint32_t leaf, float wide) const {
    return static_cast<float>(leaf - bends_[piece].first_leaf) * wide - 1.0f;
  }

 private:
  template <bool kIsFlat>
  static float product(math::Vec3 a, math::Vec3 b) {
    return kIsFlat ? a.x * b.x + a.y * b.y : dot(a, b);
  }

  const Piece* pieces_;
  uint32_t piece_count_;
  const float* coefficients_;
  const uint16_t* leaves_;
  const CurveBend* bends_;
  const uint8_t* radii_;
  const Point* points_;
  const float* heights_m_;
  uint32_t height_mask_;  // a flat model has one for all
  CurveLevels levels_;
  uint32_t unit_;
  math::Vec3 p_m_;
};

}  // namespace firmtouch::spline
