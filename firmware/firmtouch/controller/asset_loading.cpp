#include "firmtouch/controller/asset_loading.hpp"

#include "firmtouch/controller/needed_parts.hpp"
#include "firmtouch/math/arithmetic_check.hpp"
#include "firmtouch/servo/fault.hpp"

namespace firmtouch {

// Released after everything that the stage says is there, for an interrupt.
void AssetLoading::set_stage(Stage stage) { __atomic_store(&stage_, &stage, __ATOMIC_RELEASE); }

AssetLoading::Stage AssetLoading::stage() const {
  Stage stage;
  __atomic_load(&stage_, &stage, __ATOMIC_ACQUIRE);
  return stage;
}

core::Verdict AssetLoading::verdict() const {
  return is_ready() || is_refused() ? verdict_ : core::kPassed;
}

AssetStatus AssetLoading::status() const {
  const Stage now = stage();
  if (now != Stage::kRefused) return {now == Stage::kReady, 0};
  const bool is_probes = verdict_.rule >= kRuleArithmetic && verdict_.rule <= kRuleHullProbes;
  return {false, is_probes ? servo::kFaultProbes : servo::kFaultAsset};
}

void AssetLoading::begin_frame(Selection selection) {
  set_stage(Stage::kFrame);
  verdict_ = core::kPassed;
  selection_ = selection;
  container_ = {};
}

bool AssetLoading::work_frame(asset::Opening& frame, uint32_t units, uint32_t linked_parts) {
  frame.work(units);
  if (!frame.done()) return false;
  container_ = frame.view();
  core::Verdict verdict = frame.verdict();
  if (verdict.ok()) verdict = missing_part(container_, selection_, linked_parts);
  if (verdict.ok() && !math::arithmetic_is_sound()) verdict = core::reject(kRuleArithmetic);
  if (verdict.ok()) {
    set_stage(Stage::kParts);
  } else {
    end(verdict);
  }
  return true;
}

void AssetLoading::end(core::Verdict verdict) {
  verdict_ = verdict;
  set_stage(verdict.ok() ? Stage::kReady : Stage::kRefused);
}

}  // namespace firmtouch
