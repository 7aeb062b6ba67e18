#include "firmtouch/mesh/loader.hpp"

#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/query/probe.hpp"

namespace firmtouch::mesh {

Sections find_sections(const asset::Container& asset, const char* name) {
  Sections sections;
  sections.head = asset.find(kHeadSection, name);
  sections.vertices = asset.find(kVerticesSection, name);
  sections.triangles16 = asset.find(kTriangles16Section, name);
  sections.triangles32 = asset.find(kTriangles32Section, name);
  sections.nodes = asset.find(kNodesSection, name);
  sections.parents = asset.find(kParentsSection, name);
  sections.vertex_normals = asset.find(kVertexNormalsSection, name);
  sections.edge_folds = asset.find(kEdgeFoldsSection, name);
  sections.leaf_boxes = asset.find(kLeafBoxesSection, name);
  sections.shapes = asset.find(kShapesSection, name);
  return sections;
}

const char* Loader::find(const asset::Container& asset, const char* wanted) {
  return asset::find_name(asset, kHeadSection, wanted);
}

void Loader::begin(const asset::Container& asset, const char* name, State& state) {
  probes_ = asset.find(kProbesSection, name);
  is_proven_ = false;
  state.begin<Opening>(find_sections(asset, name));
}

asset::Progress Loader::work(State& state, uint32_t budget) {
  Opening& proof = state.get<Opening>();
  if (!is_proven_) {
    proof.work(asset::elements_of(budget));
    is_proven_ = proof.done();
    if (!is_proven_ || proof.verdict().ok()) return {};
    return {true, proof.verdict()};
  }
  const query::Probes probes = query::read_probes(probes_);
  if (!query::is_sensible(probes) || probe_hash(proof.view(), probes.points) != probes.hash)
    return {true, core::reject(kRuleMeshProbes)};
  view_ = proof.view();
  return {true, core::kPassed};
}

}  // namespace firmtouch::mesh
