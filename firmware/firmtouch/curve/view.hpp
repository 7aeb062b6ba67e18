#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/curve/layout.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/staged_check.hpp"

namespace firmtouch::curve {

/// The bytes of a curve's sections, as the container returns them; `tree` may be empty.
struct Sections {
  core::Bytes head, samples, arcs, tree, boxes, runs, radii;
};

/// A curve that open() has proven: every index, order, box, radius and float. Immutable; share it
/// between any number of tools.
class View {
 public:
  View() = default;

  bool is_open() const { return head_ != nullptr; }
  bool is_closed() const { return head_->is_closed != 0; }
  bool is_smooth() const { return head_->is_smooth != 0; }
  const Head& head() const { return *head_; }
  core::Span<const Sample> samples() const { return samples_; }
  core::Span<const float> arcs() const { return arcs_; }
  /// The k-d tree of samples; empty where the asset has none. Only nearest_constraint() reads it.
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
  friend class Opening;
  const Head* head_ = nullptr;
  core::Span<const Sample> samples_;
  core::Span<const float> arcs_;
  core::Span<const uint32_t> tree_;
  core::Span<const Box> boxes_;
  core::Span<const Run> runs_;
  const uint16_t* radii_ = nullptr;  // as many as the runs have
};

/// Proves a curve in slices, so that a main loop stays alive while it opens a large one: rules R201
/// to R231 of tools/FORMAT.md.
///
///     Opening opening(sections);
///     while (!opening.done()) opening.work(1000);
///     if (opening.verdict().ok()) view = opening.view();
class Opening {
 public:
  explicit Opening(const Sections& sections);

  /// Checks up to `elements` samples or boxes more; a run, and a part of one, counts as an element
  /// a segment, one of cubic pieces as four. Bounds: at most kMaxLevels reads an element; at most a
  /// run, 1,024 segments, at once; no recursion; reads only inside the sections.
  void work(uint32_t elements);
  bool done() const { return check_.done(); }
  core::Verdict verdict() const { return check_.verdict(); }
  /// The proven curve; one that is not open unless done() and verdict().ok().
  View view() const { return check_.has_passed() ? view_ : View{}; }

 private:
  static const query::CheckStage<Opening> kStages[6];
  core::Verdict open_head(const Sections& sections);
  uint32_t sample_count() const { return view_.samples_.size(); }
  uint32_t tree_count() const { return view_.tree_.size(); }
  uint32_t box_count() const { return view_.boxes_.size(); }
  uint32_t run_count() const { return view_.runs_.size(); }
  uint32_t radius_count() const { return view_.radii().size(); }
  core::Verdict check_sample(uint32_t i);
  core::Verdict finish_samples();
  core::Verdict check_length(uint32_t i);
  core::Verdict finish_length();
  core::Verdict check_tree(uint32_t i);
  core::Verdict check_box(uint32_t i);
  core::Verdict check_run(uint32_t i);
  core::Verdict check_part(uint32_t i);
  uint32_t run_cost(uint32_t) const;
  uint32_t part_cost(uint32_t i) const;

  View view_;
  query::StagedCheck check_;
  query::SeenBox seen_;
  uint64_t travelled_ = 0;  // along the curve, in 2^-62 of its length
  float longest_half_m_ = 0;
};

/// All at once.
core::Verdict open(const Sections& sections, View& view);

}  // namespace firmtouch::curve
