#include "firmtouch/spline/surface/loader.hpp"

namespace firmtouch::spline {

const char* SurfaceLoader::find(const asset::Container& asset, const char* wanted) {
  return find_kind(asset, wanted, true);
}

void SurfaceLoader::begin(const asset::Container& asset, const char* name, State& state) {
  probes_ = asset.find(kProbesSection, name);
  state.begin<Opening>(find_sections(asset, name));
}

asset::Progress SurfaceLoader::work(State& state, uint32_t budget) {
  if (view_.is_open()) return work_probe(state.get<SurfaceProbeRun>(), view_);
  Opening& proof = state.get<Opening>();
  proof.work(asset::elements_of(budget));
  if (!proof.done()) return {};
  if (!proof.verdict().ok()) return {true, proof.verdict()};
  view_ = proof.view();
  const query::Probes probes = query::read_probes(probes_);
  if (!query::is_sensible(probes)) return {true, core::reject(kRuleSplineProbes)};
  state.begin<SurfaceProbeRun>(probes);
  return {};
}

}  // namespace firmtouch::spline
