#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"

namespace firmtouch::query {

/// One stage of a proof of untrusted sections. An element takes at most `units`, of about 100
/// instructions of a Cortex-M7 each.
struct CheckStage {
  uint32_t units;
  uint32_t (*count)(const void* proof);
  core::Verdict (*check)(void* proof, uint32_t first, uint32_t end);  // in rising order
  core::Verdict (*finish)(void* proof) = nullptr;                     // after the last element
};

/// Members of a proof as functions of a CheckStage, so that all proofs share one StagedCheck.
template <class Proof>
class StageOf {
  using Count = uint32_t (Proof::*)() const;
  using Finish = core::Verdict (Proof::*)();

 public:
  /// kCheck takes an element, or the first and the end.
  template <Count kCount, auto kCheck, Finish... kFinish>
  static constexpr CheckStage of(uint32_t units) {
    return {units, count<kCount>, check<kCheck>, finish<kFinish>...};
  }

 private:
  template <Count kCount>
  static uint32_t count(const void* proof) {
    return (static_cast<const Proof*>(proof)->*kCount)();
  }
  template <core::Verdict (Proof::*kCheck)(uint32_t)>
  static core::Verdict check(void* proof, uint32_t first, uint32_t end) {
    core::Verdict found;
    for (uint32_t i = first; i < end && found.ok(); ++i)
      found = (static_cast<Proof*>(proof)->*kCheck)(i);
    return found;
  }
  template <core::Verdict (Proof::*kCheck)(uint32_t, uint32_t)>
  static core::Verdict check(void* proof, uint32_t first, uint32_t end) {
    return (static_cast<Proof*>(proof)->*kCheck)(first, end);
  }
  template <Finish kFinish>
  static core::Verdict finish(void* proof) {
    return (static_cast<Proof*>(proof)->*kFinish)();
  }
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

  /// Checks elements of at most `units` together, or one that takes more.
  [[gnu::noinline]] void work(void* proof, core::Span<const CheckStage> stages, uint32_t units) {
    while (!done()) {
      const CheckStage& stage = stages[stage_];
      const uint32_t left = stage.count(proof) - next_;
      if (left == 0) {
        next_ = 0;
        if (stage.finish != nullptr) verdict_ = stage.finish(proof);
        stage_ =
            verdict_.ok() && stage_ + 1u < stages.size() ? static_cast<uint8_t>(stage_ + 1) : kDone;
      } else {
        if (units == 0) return;
        const uint32_t fit = units < stage.units ? 1 : units / stage.units;
        const uint32_t count = fit < left ? fit : left;
        verdict_ = stage.check(proof, next_, next_ + count);
        next_ += count;
        units -= count * stage.units < units ? count * stage.units : units;
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

/// Proves the sections of a geometry in slices:
///
///     mesh::Opening opening(sections);
///     while (!opening.done()) opening.work(500);
///     if (opening.verdict().ok()) view = opening.view();
///
/// `Proof` holds what is proven, `view`, and its stages, `kStages`, and has
///     core::Verdict take(sections...);  // checks the sections' sizes and points the view to them
///     core::Verdict check_head();       // the rest of what comes before the stages
template <class Proof>
class Opening {
 public:
  using View = decltype(Proof::view);

  template <class... Sources>
  [[gnu::always_inline]] explicit Opening(const Sources&... sources) {
    const core::Verdict taken = proof_.take(sources...);
    check_.begin(taken.ok() ? proof_.check_head() : taken);
  }

  /// Checks elements of at most `units` together, or one that takes more (CheckStage).
  /// Bounds: no recursion; reads only inside the sections.
  void work(uint32_t units) { check_.work(&proof_, Proof::kStages, units == 0 ? 1 : units); }
  bool done() const { return check_.done(); }
  core::Verdict verdict() const { return check_.verdict(); }
  /// What was proven; a view that is not open unless done() and verdict().ok().
  View view() const { return check_.has_passed() ? proof_.view : View{}; }

 private:
  Proof proof_;
  StagedCheck check_;
};

/// Instead of an Opening, for an asset whose signature the boot loader checked: only sizes and
/// head are checked; the stages are neither run nor linked.
template <class Proof>
class Unproven {
 public:
  template <class... Sources>
  [[gnu::always_inline]] explicit Unproven(const Sources&... sources)
      : verdict_(proof_.take(sources...)) {
    if (verdict_.ok()) verdict_ = proof_.check_head();
  }
  void work(uint32_t) {}
  bool done() const { return true; }
  core::Verdict verdict() const { return verdict_; }
  decltype(Proof::view) view() const {
    return verdict_.ok() ? proof_.view : decltype(Proof::view){};
  }

 private:
  Proof proof_;
  core::Verdict verdict_;
};

/// Proves the sections at once.
template <class Opening, class... Sources>
core::Verdict open_at_once(typename Opening::View& view, const Sources&... sources) {
  Opening opening(sources...);
  while (!opening.done()) opening.work(UINT32_MAX);
  view = opening.view();
  return opening.verdict();
}

/// A power of two from 2^-95 to 2^65, as sides of cells and quanta are.
inline bool is_power_of_two(float value) {
  uint32_t bits;
  __builtin_memcpy(&bits, &value, sizeof bits);
  return (bits & 0x807FFFFFu) == 0 && bits >= 0x10000000u && bits <= 0x60000000u;
}

}  // namespace firmtouch::query
