#pragma once
#include <stdint.h>

#include "firmtouch/core/status.hpp"

namespace firmtouch::query {

/// One stage of a proof of untrusted sections, as member functions of the class that proves them.
/// `count` and `cost` are called again for each element: they should only read.
template <class Proof>
struct CheckStage {
  uint32_t (Proof::*count)() const;                   // elements; 0 skips to `finish`
  core::Verdict (Proof::*check)(uint32_t element);    // of one, in rising order from 0
  core::Verdict (Proof::*finish)() = nullptr;         // after the last element
  uint32_t (Proof::*cost)(uint32_t) const = nullptr;  // of one, in units of the budget; else 1
};

/// Runs the stages of a proof in slices, up to the first verdict that rejects, so that a main loop
/// stays alive while it opens a large asset.
class StagedCheck {
 public:
  /// With the verdict on what was checked before the stages, such as the head.
  void begin(core::Verdict head) {
    verdict_ = head;
    stage_ = head.ok() ? 0 : kDone;
    next_ = 0;
  }

  /// Checks elements until their costs reach `budget`; the last one may exceed it.
  template <class Proof, uint32_t kStages>
  void work(Proof& proof, const CheckStage<Proof> (&stages)[kStages], uint32_t budget) {
    while (!done()) {
      const CheckStage<Proof>& stage = stages[stage_];
      if (next_ == (proof.*stage.count)()) {
        next_ = 0;
        if (stage.finish != nullptr) verdict_ = (proof.*stage.finish)();
        stage_ = verdict_.ok() && stage_ + 1u < kStages ? static_cast<uint8_t>(stage_ + 1) : kDone;
      } else {
        if (budget == 0) return;
        const uint32_t cost = stage.cost == nullptr ? 1 : (proof.*stage.cost)(next_);
        budget = cost < budget ? budget - cost : 0;
        verdict_ = (proof.*stage.check)(next_++);
        if (!verdict_.ok()) stage_ = kDone;
      }
    }
  }

  bool done() const { return stage_ == kDone; }
  core::Verdict verdict() const { return verdict_; }
  bool has_passed() const { return done() && verdict_.ok(); }

 private:
  static constexpr uint8_t kDone = 255;
  core::Verdict verdict_;
  uint8_t stage_ = kDone;
  uint32_t next_ = 0;
};

/// Whole proof at once. `Opening` has work(), done(), verdict() and view().
template <class Opening, class View>
core::Verdict open_at_once(Opening& opening, View& view) {
  while (!opening.done()) opening.work(UINT32_MAX);
  view = opening.view();
  return opening.verdict();
}

/// Smallest box of the points so far, to compare with the one that a head states.
class SeenBox {
 public:
  /// Result: false where the point is outside the stated box, or NaN.
  bool take(const float* point_m, const float* low_m, const float* high_m) {
    for (uint32_t k = 0; k < 3; ++k) {
      if (!(point_m[k] >= low_m[k] && point_m[k] <= high_m[k])) return false;
      if (!(point_m[k] >= low_m_[k])) low_m_[k] = point_m[k];
      if (!(point_m[k] <= high_m_[k])) high_m_[k] = point_m[k];
    }
    return true;
  }
  bool touches_low(uint32_t k, float low_m) const { return low_m_[k] <= low_m; }
  bool touches_high(uint32_t k, float high_m) const { return high_m_[k] >= high_m; }

 private:
  static constexpr float kMax_m = 0x1p127f;
  float low_m_[3] = {kMax_m, kMax_m, kMax_m}, high_m_[3] = {-kMax_m, -kMax_m, -kMax_m};
};

/// A power of two from 2^-95 to 2^65, as sides of cells and quanta are.
inline bool is_power_of_two(float value) {
  uint32_t bits;
  __builtin_memcpy(&bits, &value, sizeof bits);
  return (bits & 0x807FFFFFu) == 0 && bits >= 0x10000000u && bits <= 0x60000000u;
}

}  // namespace firmtouch::query
