#include "firmtouch/hull/loader.hpp"

#include "firmtouch/mesh/layout.hpp"

namespace firmtouch::hull {

Sections find_sections(const asset::Container& asset, const char* name) {
  Sections sections;
  sections.head = asset.find(kHeadSection, name);
  sections.vertices = asset.find(kVerticesSection, name);
  sections.origins = asset.find(kOriginsSection, name);
  sections.records = asset.find(kRecordsSection, name);
  sections.record_offsets = asset.find(kRecordOffsetsSection, name);
  sections.star_boxes = asset.find(kStarBoxesSection, name);
  sections.boxes = asset.find(kBoxesSection, name);
  sections.base_hull = asset.find(kBaseHullSection, name);
  sections.mesh_head = asset.find(mesh::kHeadSection, name);
  sections.mesh_vertices = asset.find(mesh::kVerticesSection, name);
  sections.triangles16 = asset.find(mesh::kTriangles16Section, name);
  sections.triangles32 = asset.find(mesh::kTriangles32Section, name);
  return sections;
}

const char* Loader::find(const asset::Container& asset, const char* wanted) {
  return asset::find_name(asset, kHeadSection, wanted);
}

void Loader::begin(const asset::Container& asset, const char* name, State& state) {
  probes_ = asset.find(kProbesSection, name);
  state.begin<Opening>(find_sections(asset, name));
}

asset::Progress Loader::work(State& state, uint32_t budget) {
  if (!view_.is_open()) {
    Opening& proof = state.get<Opening>();
    proof.work(asset::elements_of(budget));
    if (!proof.done()) return {};
    if (!proof.verdict().ok()) return {true, proof.verdict()};
    view_ = proof.view();
    const query::Probes probes = query::read_probes(probes_);
    if (!query::is_sensible(probes)) return {true, core::reject(kRuleHullProbes)};
    state.begin<ProbeRun>(probes);
    return {};
  }
  ProbeRun& run = state.get<ProbeRun>();
  run.work(view_);
  if (!run.done()) return {};
  return {true, run.agrees() ? core::kPassed : core::reject(kRuleHullProbes)};
}

}  // namespace firmtouch::hull
