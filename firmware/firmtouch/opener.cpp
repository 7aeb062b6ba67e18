#include "firmtouch/opener.hpp"

#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/math/arithmetic_check.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/query/probe.hpp"

namespace firmtouch {
namespace {

// The probes of one section are one slice, because their hash is one. The baker writes 64.
constexpr uint32_t kMostProbes = 256;
// To check a vertex, node or triangle costs up to this many times what a byte of a CRC does.
constexpr uint32_t kBytesAnElement = 16;
// And a cell of a map, which takes a query from its seed.
constexpr uint32_t kBytesACell = 512;

const char* choose(const asset::Container& container, uint32_t head_type, const char* wanted) {
  if (wanted != nullptr) return container.find(head_type, wanted).empty() ? nullptr : wanted;
  const uint32_t first = container.next_of_type(head_type);
  return first == asset::kNoSection ? nullptr : container.name(first);
}

mesh::Sections mesh_sections(const asset::Container& container, const char* name) {
  mesh::Sections sections;
  sections.head = container.find(mesh::kHeadSection, name);
  sections.vertices = container.find(mesh::kVerticesSection, name);
  sections.triangles16 = container.find(mesh::kTriangles16Section, name);
  sections.triangles32 = container.find(mesh::kTriangles32Section, name);
  sections.nodes = container.find(mesh::kNodesSection, name);
  sections.parents = container.find(mesh::kParentsSection, name);
  sections.vertex_normals = container.find(mesh::kVertexNormalsSection, name);
  sections.edge_folds = container.find(mesh::kEdgeFoldsSection, name);
  return sections;
}

field::Sections map_sections(const asset::Container& container, const char* name) {
  field::Sections sections;
  sections.head = container.find(field::kHeadSection, name);
  sections.distances = container.find(field::kDistancesSection, name);
  sections.seeds = container.find(field::kSeedsSection, name);
  return sections;
}

curve::Sections curve_sections(const asset::Container& container, const char* name) {
  curve::Sections sections;
  sections.head = container.find(curve::kHeadSection, name);
  sections.samples = container.find(curve::kSamplesSection, name);
  sections.arcs = container.find(curve::kArcsSection, name);
  sections.places = container.find(curve::kPlacesSection, name);
  sections.boxes = container.find(curve::kBoxesSection, name);
  sections.runs = container.find(curve::kRunsSection, name);
  return sections;
}

bool is_sensible(const query::Probes& probes) {
  return !probes.points.empty() && probes.points.size() <= kMostProbes;
}

}  // namespace

void Opener::begin(core::Bytes asset, Selection selection) {
  set_stage(Stage::kAsset);
  verdict_ = core::kPassed;
  selection_ = selection;
  container_ = {};
  mesh_ = {};
  curve_ = {};
  map_ = {};
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
  } else if (stage_ == Stage::kMeshProbes) {
    run_mesh_probes();
  } else if (stage_ == Stage::kMap) {
    map_opening_.work(budget / kBytesACell + 1);
    if (!map_opening_.done()) return false;
    map_ = map_opening_.view();
    if (map_opening_.verdict().ok()) {
      set_stage(Stage::kCurveProbes);
    } else {
      refuse(map_opening_.verdict());
    }
  } else if (stage_ == Stage::kCurveProbes) {
    run_curve_probes();
  }
  return stage_ == Stage::kReady || stage_ == Stage::kRefused || stage_ == Stage::kIdle;
}

void Opener::start_mesh() {
  const char* name = choose(container_, mesh::kHeadSection, selection_.mesh);
  if (name == nullptr && selection_.mesh != nullptr) return refuse(core::reject(kRuleNoSuchMesh));
  selection_.mesh = name;
  if (name == nullptr) return start_curve();
  mesh_opening_ = mesh::Opening(mesh_sections(container_, name));
  set_stage(Stage::kMesh);
}

void Opener::start_curve() {
  const char* name = choose(container_, curve::kHeadSection, selection_.curve);
  if (name == nullptr && selection_.curve != nullptr) return refuse(core::reject(kRuleNoSuchCurve));
  selection_.curve = name;
  if (name == nullptr && selection_.mesh == nullptr)
    return refuse(core::reject(kRuleNothingToFeel));
  if (name == nullptr) return set_stage(Stage::kMeshProbes);
  curve_opening_ = curve::Opening(curve_sections(container_, name));
  set_stage(Stage::kCurve);
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
  start_map();
}

void Opener::start_map() {
  if (!mesh_.is_open()) return set_stage(Stage::kCurveProbes);
  const field::Sections sections = map_sections(container_, selection_.mesh);
  if (sections.head.empty()) return set_stage(Stage::kCurveProbes);
  map_opening_ = field::Opening(sections, mesh_);
  set_stage(Stage::kMap);
}

void Opener::run_curve_probes() {
  if (curve_.is_open()) {
    const query::Probes probes =
        query::read_probes(container_.find(curve::kProbesSection, selection_.curve));
    if (!is_sensible(probes) || curve::probe_hash(curve_, probes.points) != probes.hash) {
      return refuse(core::reject(kRuleCurveProbes));
    }
  }
  set_stage(Stage::kReady);
}

}  // namespace firmtouch
