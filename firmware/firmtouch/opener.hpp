#pragma once
#include <stdint.h>

#include "firmtouch/asset/opening.hpp"
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/curve/view.hpp"
#include "firmtouch/mesh/view.hpp"

namespace firmtouch {

// What verdict() says beyond the rules of the asset's rooms (tools/FORMAT.md).
constexpr uint16_t kRuleNoSuchMesh = 901;     // no section of the mesh that was asked for by name
constexpr uint16_t kRuleNoSuchCurve = 902;    // the same for the curve
constexpr uint16_t kRuleNothingToFeel = 903;  // neither a mesh nor a curve in the asset
constexpr uint16_t kRuleArithmetic =
    904;  // rounding, denormals or contraction differ from the baker's machine
constexpr uint16_t kRuleMeshProbes =
    905;  // the mesh's probe queries answered other bits, or there are none
constexpr uint16_t kRuleCurveProbes = 906;  // the same for the curve

/// Which mesh and curve of the asset to feel; nullptr: the first one, if there is any. The names
/// must outlive the opener.
struct Selection {
  const char* mesh = nullptr;
  const char* curve = nullptr;
};

/// From the bytes of an asset to a proven mesh and a proven curve, in slices for the main loop;
/// then the floating-point mode is checked and the asset's probe queries are run.
class Opener {
 public:
  /// `asset` must outlive the views.
  void begin(core::Bytes asset, Selection selection);

  /// About `budget` bytes, vertices, nodes, triangles or samples more; the last slice runs all the
  /// probe queries.
  /// Result: true when finished.
  bool work(uint32_t budget);

  core::Verdict verdict() const { return verdict_; }
  /// Safe to ask from an interrupt: once true, the views do not change until the next begin().
  bool is_ready() const;
  bool is_refused() const { return stage_ == Stage::kRefused; }
  /// One that is not open where the asset has none.
  const mesh::View& mesh() const { return mesh_; }
  const curve::View& curve() const { return curve_; }
  const asset::Container& container() const { return container_; }

 private:
  enum class Stage : uint8_t { kIdle, kAsset, kMesh, kCurve, kProbes, kReady, kRefused };
  void set_stage(Stage stage);
  void refuse(core::Verdict verdict);
  void start_mesh();
  void start_curve();
  void run_probes();

  Stage stage_ = Stage::kIdle;
  core::Verdict verdict_;
  Selection selection_;
  asset::Container container_;
  mesh::View mesh_;
  curve::View curve_;
  asset::Opening asset_opening_{core::Bytes{}};
  mesh::Opening mesh_opening_{mesh::Sections{}};
  curve::Opening curve_opening_{curve::Sections{}};
};

}  // namespace firmtouch
