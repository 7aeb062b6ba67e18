#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/headed_view.hpp"
#include "firmtouch/spline/layout.hpp"

namespace firmtouch::spline {

/// The bytes of a spline model's sections, as the container hands them out.
struct Sections {
  core::Bytes head, pieces, coefficients, leaves, bends, nodes, points, grids, radii;

  /// Calls take(section type, bytes) for each.
  template <class Take>
  void each(const Take& take) {
    take(kHeadSection, head), take(kPiecesSection, pieces),
        take(kCoefficientsSection, coefficients), take(kLeavesSection, leaves),
        take(kBendsSection, bends), take(kNodesSection, nodes), take(kPointsSection, points),
        take(kGridsSection, grids), take(kRadiiSection, radii);
  }
};

/// Spline curves, or spline surfaces, that open() has proven: every index, float, bound and
/// enclosure. Immutable; share it between any number of tools.
class View : public query::HeadedView<Head, Sections> {
 public:
  bool is_surface() const { return head_->is_surface != 0; }
  core::Span<const Piece> pieces() const { return pieces_; }
  core::Span<const float> coefficients() const { return coefficients_; }
  uint32_t leaf_count() const { return head_->leaf_count; }
  // Of curves:
  bool is_flat() const { return heights_m_.empty(); }  // in a plane of one z
  core::Span<const uint16_t> leaves() const { return leaves_; }
  core::Span<const CurveBend> curve_bends() const { return curve_bends_; }
  core::Span<const uint8_t> curve_radii() const {
    return {radii_, CurveLevels(head_->leaf_count).node_count()};
  }
  core::Span<const Point> points() const { return points_; }
  core::Span<const float> heights_m() const { return heights_m_; }  // z of the points
  math::Vec3 point_at(uint32_t i) const {
    const float z_m = is_flat() ? pieces_[0].origin_m[2] : heights_m_[i];
    return {points_[i].x_m, points_[i].y_m, z_m};
  }
  // Of surfaces:
  core::Span<const Grid> grids() const { return grids_; }
  core::Span<const Corner> corners() const { return corners_; }
  core::Span<const uint8_t> radii() const { return {radii_, radius_count()}; }
  core::Span<const uint8_t> overlaps() const {
    return {radii_ + radius_count(), head_->leaf_count - head_->piece_count};
  }
  core::Span<const PatchBend> patch_bends() const { return patch_bends_; }
  core::Span<const Box> boxes() const { return boxes_; }

  /// Which part of which piece a leaf is, by its number in the asset.
  /// Pre: leaf < leaf_count(), and one that is_leaf().
  struct LeafIndex {
    uint32_t piece, index_u, index_v;
  };
  LeafIndex index_of(uint32_t leaf) const;
  bool is_leaf(uint32_t leaf) const { return is_surface() || leaves_[leaf] != kNoLeaf; }

 private:
  friend class Proof;
  uint32_t radius_count() const { return 2 * head_->leaf_count - head_->piece_count; }
  core::Span<const Piece> pieces_;
  core::Span<const float> coefficients_;
  core::Span<const uint16_t> leaves_;
  core::Span<const CurveBend> curve_bends_;
  core::Span<const Point> points_;
  core::Span<const float> heights_m_;
  core::Span<const Grid> grids_;
  core::Span<const Corner> corners_;
  const uint8_t* radii_ = nullptr;  // of surfaces, and the overlaps behind them
  core::Span<const PatchBend> patch_bends_;
  core::Span<const Box> boxes_;
};

}  // namespace firmtouch::spline
