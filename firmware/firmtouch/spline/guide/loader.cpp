#include "firmtouch/spline/guide/loader.hpp"

namespace firmtouch::spline {

GuideSections find_guide_sections(const asset::Container& asset, const char* name) {
  return {asset.find(kArcsSection, name), asset.find(kChainsSection, name)};
}

const char* GuideLoader::find(const asset::Container& asset, const char* wanted) {
  return find_kind(asset, wanted, false);
}

void GuideLoader::begin(const asset::Container& asset, const char* name, State& state) {
  probes_ = asset.find(kProbesSection, name);
  sections_ = find_guide_sections(asset, name);
  stage_ = Stage::kModel;
  state.begin<Opening>(find_sections(asset, name));
}

asset::Progress GuideLoader::start_lengths(State& state) {
  const Opening& proof = state.get<Opening>();
  if (!proof.verdict().ok()) return {true, proof.verdict()};
  const View model = proof.view();
  state.begin<GuideOpening>(model, sections_);
  stage_ = Stage::kLengths;
  return {};
}

asset::Progress GuideLoader::start_probes(State& state) {
  const GuideOpening& proof = state.get<GuideOpening>();
  if (!proof.verdict().ok()) return {true, proof.verdict()};
  view_ = proof.view();
  const query::Probes probes = query::read_probes(probes_);
  if (!query::is_sensible(probes)) return {true, core::reject(kRuleSplineProbes)};
  state.begin<CurveProbeRun>(probes);
  stage_ = Stage::kProbes;
  return {};
}

asset::Progress GuideLoader::work(State& state, uint32_t budget) {
  if (stage_ == Stage::kModel) {
    Opening& proof = state.get<Opening>();
    proof.work(asset::elements_of(budget));
    return proof.done() ? start_lengths(state) : asset::Progress{};
  }
  if (stage_ == Stage::kLengths) {
    GuideOpening& proof = state.get<GuideOpening>();
    proof.work(asset::elements_of(budget));
    return proof.done() ? start_probes(state) : asset::Progress{};
  }
  return work_probe(state.get<CurveProbeRun>(), view_.model());
}

}  // namespace firmtouch::spline
