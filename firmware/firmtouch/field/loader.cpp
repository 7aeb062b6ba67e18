#include "firmtouch/field/loader.hpp"

namespace firmtouch::field {
namespace {

// A cell takes a query of the mesh: as long as a CRC of so many bytes.
constexpr uint32_t kBytesPerCell = 512;

}  // namespace

Sections find_sections(const asset::Container& asset, const char* name) {
  Sections sections;
  sections.head = asset.find(kHeadSection, name);
  sections.distances = asset.find(kDistancesSection, name);
  sections.seeds = asset.find(kSeedsSection, name);
  return sections;
}

const char* Loader::find(const asset::Container& asset, const char* wanted) {
  return asset::find_name(asset, kHeadSection, wanted);
}

void Loader::begin(const asset::Container& asset, const char* name, State& state) {
  state.begin<Opening>(find_sections(asset, name), *mesh_);
}

asset::Progress Loader::work(State& state, uint32_t budget) {
  Opening& proof = state.get<Opening>();
  proof.work(budget / kBytesPerCell + 1);
  if (!proof.done()) return {};
  view_ = proof.view();
  return {true, proof.verdict()};
}

}  // namespace firmtouch::field
