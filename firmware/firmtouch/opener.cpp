#include "firmtouch/opener.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/math/arithmetic_check.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/query/probe.hpp"
#include "firmtouch/sections.hpp"

namespace firmtouch {
namespace {

// The probes of one section are one slice, because their hash is one. The baker writes 64.
constexpr uint32_t kMaxProbes = 256;
// To check a vertex, node or triangle costs up to this many times what a byte of a CRC does.
constexpr uint32_t kBytesAnElement = 16;
// And a cell of a map, which takes a query from its seed.
constexpr uint32_t kBytesACell = 512;

const char* choose(const asset::Container& container, uint32_t head_type, const char* wanted) {
  if (wanted != nullptr) return container.find(head_type, wanted).empty() ? nullptr : wanted;
  const uint32_t first = container.next_of_type(head_type);
  return first == asset::kNoSection ? nullptr : container.name(first);
}

// A curve of splines that holds what a guide needs, or surfaces: what a head says, as yet unproven.
bool is_of_kind(const asset::Container& container, const char* name, bool is_surface) {
  const core::Span<const spline::Head> head =
      core::as_whole_array<spline::Head>(container.find(spline::kHeadSection, name));
  if (head.size() != 1 || (head[0].is_surface != 0) != is_surface) return false;
  return is_surface || !container.find(spline::kArcsSection, name).empty();
}

const char* choose_spline(const asset::Container& container, const char* wanted, bool is_surface) {
  if (wanted != nullptr) return is_of_kind(container, wanted, is_surface) ? wanted : nullptr;
  for (uint32_t at = container.next_of_type(spline::kHeadSection); at != asset::kNoSection;
       at = container.next_of_type(spline::kHeadSection, at + 1))
    if (is_of_kind(container, container.name(at), is_surface)) return container.name(at);
  return nullptr;
}

bool is_sensible(const query::Probes& probes) {
  return !probes.points.empty() && probes.points.size() <= kMaxProbes;
}

}  // namespace

void Opener::begin(core::Bytes asset, Selection selection) {
  set_stage(Stage::kAsset);
  verdict_ = core::kPassed;
  selection_ = selection;
  container_ = {};
  mesh_ = {};
  curve_ = {};
  field_ = {};
  hull_ = {};
  spline_surface_ = {};
  spline_guide_ = {};
  asset_opening_ = asset::Opening(asset);
}

// An interrupt must not see a stage before what the stage stands on.
void Opener::set_stage(Stage stage) { __atomic_store(&stage_, &stage, __ATOMIC_RELEASE); }

Opener::Stage Opener::stage() const {
  Stage stage;
  __atomic_load(&stage_, &stage, __ATOMIC_ACQUIRE);
  return stage;
}

core::Verdict Opener::verdict() const {
  return is_ready() || is_refused() ? verdict_ : core::kPassed;
}

void Opener::refuse(core::Verdict verdict) {
  verdict_ = verdict;
  set_stage(Stage::kRefused);
}

bool Opener::work(uint32_t budget) {
  if (stage_ == Stage::kAsset) {
    asset_opening_.work(budget);
    if (!asset_opening_.done()) return false;
    container_ = asset_opening_.container();
    if (asset_opening_.verdict().ok()) {
      start_mesh();
    } else {
      refuse(asset_opening_.verdict());
    }
  } else if (stage_ == Stage::kMesh) {
    mesh_opening_.work(budget / kBytesAnElement + 1);
    if (!mesh_opening_.done()) return false;
    mesh_ = mesh_opening_.view();
    if (mesh_opening_.verdict().ok()) {
      start_curve();
    } else {
      refuse(mesh_opening_.verdict());
    }
  } else if (stage_ == Stage::kCurve) {
    curve_opening_.work(budget / kBytesAnElement + 1);
    if (!curve_opening_.done()) return false;
    curve_ = curve_opening_.view();
    if (curve_opening_.verdict().ok()) {
      set_stage(Stage::kMeshProbes);
    } else {
      refuse(curve_opening_.verdict());
    }
  } else if (stage_ == Stage::kSplineSurface || stage_ == Stage::kSplineCurve) {
    take_spline(budget);
  } else if (stage_ == Stage::kSplineGuide) {
    take_spline_guide(budget);
  } else if (stage_ == Stage::kMeshProbes) {
    run_mesh_probes();
  } else if (stage_ == Stage::kField) {
    field_opening_.work(budget / kBytesACell + 1);
    if (!field_opening_.done()) return false;
    field_ = field_opening_.view();
    if (field_opening_.verdict().ok()) {
      start_hull();
    } else {
      refuse(field_opening_.verdict());
    }
  } else if (stage_ == Stage::kHull) {
    take_hull(budget);
  } else if (stage_ == Stage::kHullProbes) {
    run_hull_probe();
  } else if (stage_ == Stage::kCurveProbes) {
    run_curve_probes();
  } else if (stage_ == Stage::kSurfaceProbes || stage_ == Stage::kGuideProbes) {
    run_spline_probe();
  }
  return stage_ == Stage::kReady || stage_ == Stage::kRefused || stage_ == Stage::kIdle;
}

void Opener::start_mesh() {
  const char* name = choose(container_, mesh::kHeadSection, selection_.mesh);
  if (name == nullptr) return start_spline_surface();
  selection_.mesh = name;
  mesh_opening_ = mesh::Opening(mesh_sections(container_, name));
  set_stage(Stage::kMesh);
}

void Opener::start_spline_surface() {
  const char* name = choose_spline(container_, selection_.mesh, true);
  if (name == nullptr && selection_.mesh != nullptr) return refuse(core::reject(kRuleNoSuchMesh));
  selection_.mesh = name;
  if (name == nullptr) return start_curve();
  spline_opening_ = spline::Opening(spline_sections(container_, name));
  set_stage(Stage::kSplineSurface);
}

void Opener::start_curve() {
  const char* name = choose(container_, curve::kHeadSection, selection_.curve);
  if (name == nullptr) return start_spline_curve();
  selection_.curve = name;
  curve_opening_ = curve::Opening(curve_sections(container_, name));
  set_stage(Stage::kCurve);
}

void Opener::start_spline_curve() {
  const char* name = choose_spline(container_, selection_.curve, false);
  if (name == nullptr && selection_.curve != nullptr) return refuse(core::reject(kRuleNoSuchCurve));
  selection_.curve = name;
  if (name == nullptr && selection_.mesh == nullptr)
    return refuse(core::reject(kRuleNothingToFeel));
  if (name == nullptr) return set_stage(Stage::kMeshProbes);
  spline_opening_ = spline::Opening(spline_sections(container_, name));
  set_stage(Stage::kSplineCurve);
}

void Opener::take_spline(uint32_t budget) {
  spline_opening_.work(budget / kBytesAnElement + 1);
  if (!spline_opening_.done()) return;
  if (!spline_opening_.verdict().ok()) return refuse(spline_opening_.verdict());
  if (stage_ == Stage::kSplineSurface) {
    spline_surface_ = spline_opening_.view();
    return start_curve();
  }
  guide_opening_ =
      spline::GuideOpening(spline_opening_.view(), guide_sections(container_, selection_.curve));
  set_stage(Stage::kSplineGuide);
}

void Opener::take_spline_guide(uint32_t budget) {
  guide_opening_.work(budget / kBytesAnElement + 1);
  if (!guide_opening_.done()) return;
  if (!guide_opening_.verdict().ok()) return refuse(guide_opening_.verdict());
  spline_guide_ = guide_opening_.view();
  set_stage(Stage::kMeshProbes);
}

void Opener::run_mesh_probes() {
  if (!math::arithmetic_is_sound()) return refuse(core::reject(kRuleArithmetic));
  if (mesh_.is_open()) {
    const query::Probes probes =
        query::read_probes(container_.find(mesh::kProbesSection, selection_.mesh));
    if (!is_sensible(probes) || mesh::probe_hash(mesh_, probes.points) != probes.hash) {
      return refuse(core::reject(kRuleMeshProbes));
    }
  }
  start_field();
}

void Opener::start_field() {
  if (!mesh_.is_open()) return set_stage(Stage::kCurveProbes);
  const field::Sections sections = distance_field_sections(container_, selection_.mesh);
  if (sections.head.empty()) return start_hull();
  field_opening_ = field::Opening(sections, mesh_);
  set_stage(Stage::kField);
}

void Opener::start_hull() {
  const hull::Sections sections = hull_sections(container_, selection_.mesh);
  if (sections.head.empty()) return set_stage(Stage::kCurveProbes);
  hull_opening_ = hull::Opening(sections);
  set_stage(Stage::kHull);
}

void Opener::take_hull(uint32_t budget) {
  hull_opening_.work(budget / kBytesAnElement + 1);
  if (!hull_opening_.done()) return;
  if (!hull_opening_.verdict().ok()) return refuse(hull_opening_.verdict());
  hull_ = hull_opening_.view();
  const query::Probes probes =
      query::read_probes(container_.find(hull::kProbesSection, selection_.mesh));
  if (!is_sensible(probes)) return refuse(core::reject(kRuleHullProbes));
  hull_probes_ = hull::ProbeRun(probes);
  set_stage(Stage::kHullProbes);
}

void Opener::run_hull_probe() {
  hull_probes_.work(hull_);
  if (!hull_probes_.done()) return;
  if (!hull_probes_.agrees()) return refuse(core::reject(kRuleHullProbes));
  set_stage(Stage::kCurveProbes);
}

void Opener::run_curve_probes() {
  if (curve_.is_open()) {
    const query::Probes probes =
        query::read_probes(container_.find(curve::kProbesSection, selection_.curve));
    if (!is_sensible(probes) || curve::probe_hash(curve_, probes.points) != probes.hash) {
      return refuse(core::reject(kRuleCurveProbes));
    }
  }
  start_spline_probes(Stage::kSurfaceProbes);
}

void Opener::start_spline_probes(Stage stage) {
  if (stage == Stage::kSurfaceProbes && !spline_surface_.is_open()) stage = Stage::kGuideProbes;
  if (stage == Stage::kGuideProbes && !spline_guide_.is_open()) return set_stage(Stage::kReady);
  const char* name = stage == Stage::kSurfaceProbes ? selection_.mesh : selection_.curve;
  const query::Probes probes = query::read_probes(container_.find(spline::kProbesSection, name));
  if (!is_sensible(probes)) return refuse(core::reject(kRuleSplineProbes));
  spline_probes_ = spline::ProbeRun(probes);
  set_stage(stage);
}

void Opener::run_spline_probe() {
  const bool is_surface = stage_ == Stage::kSurfaceProbes;
  spline_probes_.work(is_surface ? spline_surface_ : spline_guide_.model());
  if (!spline_probes_.done()) return;
  if (!spline_probes_.agrees()) return refuse(core::reject(kRuleSplineProbes));
  if (is_surface) return start_spline_probes(Stage::kGuideProbes);
  set_stage(Stage::kReady);
}

}  // namespace firmtouch
