#pragma once
#include <stdint.h>

#include "firmtouch/asset/opening.hpp"
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/curve/view.hpp"
#include "firmtouch/field/view.hpp"
#include "firmtouch/hull/probes.hpp"
#include "firmtouch/hull/view.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/guide_view.hpp"

namespace firmtouch {

// What verdict() says beyond the rules of the asset's modules (tools/FORMAT.md).
constexpr uint16_t kRuleNoSuchMesh = 901;     // no mesh or spline surface of the name asked for
constexpr uint16_t kRuleNoSuchCurve = 902;    // no curve, of samples or splines, of the name
constexpr uint16_t kRuleNothingToFeel = 903;  // neither surface nor curve in the asset
constexpr uint16_t kRuleArithmetic =
    904;  // rounding, denormals or contraction differ from the baker's machine
constexpr uint16_t kRuleMeshProbes =
    905;  // the mesh's probe queries answered other bits, or there are none
constexpr uint16_t kRuleCurveProbes = 906;   // the same for the curve
constexpr uint16_t kRuleSplineProbes = 907;  // the same for a spline surface or curve
constexpr uint16_t kRuleHullProbes = 908;    // the same for a hull of the mesh

/// Which surface (a mesh, or spline surfaces) and which curve (of samples, or of splines) of the asset
/// to feel; nullptr: the first mesh, else the first spline surfaces; the first sampled curve, else
/// the first splines that make a guide; none where there is none. The names must outlive the opener.
struct Selection {
  const char* mesh = nullptr;
  const char* curve = nullptr;
};

/// From the bytes of an asset to a proven surface and a proven curve, in slices for the main loop;
/// then the floating-point mode is checked and the asset's probe queries are run. Where the asset has
/// a distance map of the mesh, every cell of it is proven by a query of the mesh; where it has a hull
/// of the mesh, that is proven too.
class Opener {
 public:
  Opener() = default;
  Opener(const Opener&) = delete;  // the map is proven against the mesh that is in here
  Opener& operator=(const Opener&) = delete;

  /// `asset` must outlive the views.
  void begin(core::Bytes asset, Selection selection);

  /// About `budget` bytes more, or a sixteenth as many vertices, nodes, triangles, stars or samples, or a
  /// 512th as many cells of a map, which take about as long. Not by `budget` go the slices for probe
  /// queries, which are unlimited: one for all of the mesh's and one for all of the curve's (at most
  /// 256, and 64 as baked), of splines and of a hull one a query.
  /// Result: true when finished.
  bool work(uint32_t budget);

  // Safe to ask from an interrupt of work(): what they say once finished does not change until the
  // next begin(), nor do the views.
  /// Passed until it is finished.
  core::Verdict verdict() const;
  bool is_ready() const { return stage() == Stage::kReady; }
  bool is_refused() const { return stage() == Stage::kRefused; }
  /// One that is not open where the asset has none.
  const mesh::View& mesh() const { return mesh_; }
  const curve::View& curve() const { return curve_; }
  /// Of the mesh; one that is not open where the asset has none.
  const field::View& distance_field() const { return field_; }
  const hull::View& hull() const { return hull_; }
  const spline::View& spline_surface() const { return spline_surface_; }
  const spline::GuideView& spline_guide() const { return spline_guide_; }
  const asset::Container& container() const { return container_; }

 private:
  enum class Stage : uint8_t {
    kIdle,
    kAsset,
    kMesh,
    kSplineSurface,
    kCurve,
    kSplineCurve,
    kSplineGuide,
    kMeshProbes,
    kField,
    kHull,
    kHullProbes,
    kCurveProbes,
    kSurfaceProbes,
    kGuideProbes,
    kReady,
    kRefused
  };
  Stage stage() const;
  void set_stage(Stage stage);
  void refuse(core::Verdict verdict);
  void start_mesh();
  void start_spline_surface();
  void start_curve();
  void start_field();
  void start_hull();
  void take_hull(uint32_t budget);
  void run_hull_probe();
  void start_spline_curve();
  void take_spline(uint32_t budget);
  void take_spline_guide(uint32_t budget);
  void run_mesh_probes();
  void run_curve_probes();
  void start_spline_probes(Stage stage);
  void run_spline_probe();

  Stage stage_ = Stage::kIdle;
  core::Verdict verdict_;
  Selection selection_;
  asset::Container container_;
  mesh::View mesh_;
  curve::View curve_;
  field::View field_;
  hull::View hull_;
  spline::View spline_surface_;
  spline::GuideView spline_guide_;
  asset::Opening asset_opening_{core::Bytes{}};
  mesh::Opening mesh_opening_{mesh::Sections{}};
  curve::Opening curve_opening_{curve::Sections{}};
  field::Opening field_opening_{field::Sections{}, mesh_};
  hull::Opening hull_opening_{hull::Sections{}};
  hull::ProbeRun hull_probes_;
  spline::Opening spline_opening_{spline::Sections{}};  // of the surface, then of the curve
  spline::GuideOpening guide_opening_;
  spline::ProbeRun spline_probes_;
};

}  // namespace firmtouch
