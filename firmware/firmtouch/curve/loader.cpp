#include "firmtouch/curve/loader.hpp"

#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/query/probe.hpp"

namespace firmtouch::curve {

Sections find_sections(const asset::Container& asset, const char* name) {
  Sections sections;
  sections.head = asset.find(kHeadSection, name);
  sections.samples = asset.find(kSamplesSection, name);
  sections.arcs = asset.find(kArcsSection, name);
  sections.tree = asset.find(kTreeSection, name);
  sections.boxes = asset.find(kBoxesSection, name);
  sections.runs = asset.find(kRunsSection, name);
  sections.radii = asset.find(kRadiiSection, name);
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
    return {true, core::reject(kRuleCurveProbes)};
  view_ = proof.view();
  return {true, core::kPassed};
}

}  // namespace firmtouch::curve
