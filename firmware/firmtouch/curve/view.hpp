#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/curve/layout.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/headed_view.hpp"
#include "firmtouch/query/seen_box.hpp"
#include "firmtouch/query/staged_check.hpp"

namespace firmtouch::curve {

/// The bytes of a curve's sections, as the container returns them; `tree` may be empty.
struct Sections {
  core::Bytes head, samples, arcs, tree, boxes, runs, radii;

  /// Calls take(section type, bytes) for each.
  template <class Take>
  void each(const Take& take) {
    take(kHeadSection, head), take(kSamplesSection, samples), take(kArcsSection, arcs),
        take(kTreeSection, tree), take(kBoxesSection, boxes), take(kRunsSection, runs),
        take(kRadiiSection, radii);
  }
};

/// A curve that open() has proven: every index, order, box, radius and float. Immutable; share it
/// between any number of tools.
class View : public query::HeadedView<Head, Sections> {
 public:
  bool is_closed() const { return head_->is_closed != 0; }
  bool is_smooth() const { return head_->is_smooth != 0; }
  core::Span<const Sample> samples() const { return samples_; }
  core::Span<const float> arcs() const { return arcs_; }
  /// The k-d tree of samples; empty where the asset has none. Only tools read it.
  core::Span<const uint32_t> tree() const { return tree_; }
  core::Span<const Box> boxes() const { return boxes_; }
  core::Span<const Run> runs() const { return runs_; }
  core::Span<const uint16_t> radii() const {
    return {radii_, runs_.size() * (parts_of(run_levels()) + 1)};
  }
  uint32_t segment_count() const { return samples_.size() - 1; }
  uint32_t run_levels() const { return head_->run_levels; }

  math::Vec3 sample(uint32_t i) const {
    return {samples_[i].x_m, samples_[i].y_m, samples_[i].z_m};
  }

 private:
  friend class Proof;
  core::Span<const Sample> samples_;
  core::Span<const float> arcs_;
  core::Span<const uint32_t> tree_;
  core::Span<const Box> boxes_;
  core::Span<const Run> runs_;
  const uint16_t* radii_ = nullptr;  // as many as the runs have
};

/// What Opening proves of a curve: rules R201 to R231 of tools/FORMAT.md.
class Proof {
 public:
  static const query::CheckStage kStages[6];
  core::Verdict take(const Sections& sections);
  core::Verdict check_head() const;
  View view;

 private:
  uint32_t sample_count() const { return view.samples_.size(); }
  uint32_t tree_count() const { return view.tree_.size(); }
  uint32_t box_count() const { return view.boxes_.size(); }
  uint32_t run_count() const { return view.runs_.size(); }
  uint32_t part_count() const { return view.runs_.size() << view.run_levels(); }
  core::Verdict check_samples(uint32_t first, uint32_t end);
  core::Verdict finish_samples();
  core::Verdict finish_lengths();
  core::Verdict check_length(uint32_t i);
  core::Verdict check_tree(uint32_t first, uint32_t end);
  core::Verdict check_boxes(uint32_t first, uint32_t end);
  core::Verdict check_runs(uint32_t first, uint32_t end);
  core::Verdict check_part(uint32_t i);

  query::SeenBox seen_;
  uint64_t travelled_ = 0;  // along the curve, in 2^-62 of its length
  float longest_half_m_ = 0;
  // Of the part of each level that the next smallest part is in: its farthest point so far.
  float max2_m2_[kMaxRunLevels + 1] = {};
};

using Opening = query::Opening<Proof>;

/// All at once.
inline core::Verdict open(const Sections& sections, View& view) {
  return query::open_at_once<Opening>(view, sections);
}

}  // namespace firmtouch::curve

extern template class firmtouch::query::Opening<firmtouch::curve::Proof>;
