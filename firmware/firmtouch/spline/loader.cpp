#include "firmtouch/spline/loader.hpp"

#include "firmtouch/core/bytes.hpp"

namespace firmtouch::spline {
namespace {

// What the head says, not yet proven. Curves without lengths make no guide.
bool is_of_kind(const asset::Container& asset, const char* name, bool is_surface) {
  const core::Span<const Head> head = core::as_whole_array<Head>(asset.find(kHeadSection, name));
  if (head.size() != 1 || (head[0].is_surface != 0) != is_surface) return false;
  return is_surface || !asset.find(kArcsSection, name).empty();
}

const char* find_kind(const asset::Container& asset, const char* wanted, bool is_surface) {
  if (wanted != nullptr) return is_of_kind(asset, wanted, is_surface) ? wanted : nullptr;
  for (uint32_t at = asset.next_of_type(kHeadSection); at != asset::kNoSection;
       at = asset.next_of_type(kHeadSection, at + 1))
    if (is_of_kind(asset, asset.name(at), is_surface)) return asset.name(at);
  return nullptr;
}

asset::Progress work_probe(ProbeRun& run, const View& model) {
  run.work(model);
  if (!run.done()) return {};
  return {true, run.agrees() ? core::kPassed : core::reject(kRuleSplineProbes)};
}

}  // namespace

Sections find_sections(const asset::Container& asset, const char* name) {
  Sections sections;
  sections.head = asset.find(kHeadSection, name);
  sections.pieces = asset.find(kPiecesSection, name);
  sections.coefficients = asset.find(kCoefficientsSection, name);
  sections.leaves = asset.find(kLeavesSection, name);
  sections.bends = asset.find(kBendsSection, name);
  sections.nodes = asset.find(kNodesSection, name);
  sections.points = asset.find(kPointsSection, name);
  sections.grids = asset.find(kGridsSection, name);
  sections.radii = asset.find(kRadiiSection, name);
  return sections;
}

GuideSections find_guide_sections(const asset::Container& asset, const char* name) {
  return {asset.find(kArcsSection, name), asset.find(kChainsSection, name)};
}

const char* SurfaceLoader::find(const asset::Container& asset, const char* wanted) {
  return find_kind(asset, wanted, true);
}

void SurfaceLoader::begin(const asset::Container& asset, const char* name, State& state) {
  probes_ = asset.find(kProbesSection, name);
  state.begin<Opening>(find_sections(asset, name));
}

asset::Progress SurfaceLoader::work(State& state, uint32_t budget) {
  if (view_.is_open()) return work_probe(state.get<ProbeRun>(), view_);
  Opening& proof = state.get<Opening>();
  proof.work(asset::elements_of(budget));
  if (!proof.done()) return {};
  if (!proof.verdict().ok()) return {true, proof.verdict()};
  view_ = proof.view();
  const query::Probes probes = query::read_probes(probes_);
  if (!query::is_sensible(probes)) return {true, core::reject(kRuleSplineProbes)};
  state.begin<ProbeRun>(probes);
  return {};
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
  state.begin<ProbeRun>(probes);
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
  return work_probe(state.get<ProbeRun>(), view_.model());
}

}  // namespace firmtouch::spline
