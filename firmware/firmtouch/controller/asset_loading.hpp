#pragma once
#include <stdint.h>

#include "firmtouch/asset/loading.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/controller/controller_core.hpp"
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"

namespace firmtouch {

/// What the controller program opens between two polls of its link (Controller::work()): below
/// 100,000 instructions of a Cortex-M7 (tools/bench/cortex-m7-opening --bar).
constexpr uint32_t kSliceUnits = 500;

/// Which surface and which guide of the asset to use; null: the first that the parts find. A null
/// name in an asset without one is no error, unless both are missing. The names must outlive the
/// controller.
struct Selection {
  const char* surface = nullptr;
  const char* guide = nullptr;
};

/// From the bytes of an asset to proven geometries, in slices for the main loop: the frame of the
/// file, the parts that it needs, the arithmetic of this machine. Loaders (loaders.hpp) go on from
/// there.
class AssetLoading {
 public:
  // Safe to call in an interrupt of work(): the results change only when loading ends, and at the
  // next begin().
  core::Verdict verdict() const;  // passed until it ends
  bool is_ready() const { return stage() == Stage::kReady; }
  bool is_refused() const { return stage() == Stage::kRefused; }
  AssetStatus status() const;
  const asset::Container& container() const { return container_; }
  const Selection& selection() const { return selection_; }

 protected:
  enum class Stage : uint8_t { kIdle, kFrame, kParts, kReady, kRefused };

  Stage stage() const;
  void begin_frame(Selection selection);
  /// Result: true when the frame is done; then the stage is kParts or kRefused.
  bool work_frame(asset::Opening& frame, uint32_t units, uint32_t linked_parts);
  void end(core::Verdict verdict);

 private:
  void set_stage(Stage stage);

  Stage stage_ = Stage::kIdle;
  core::Verdict verdict_;
  Selection selection_;
  asset::Container container_;
};

}  // namespace firmtouch
