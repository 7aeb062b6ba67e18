#pragma once
#include "firmtouch/asset/loader.hpp"
#include "firmtouch/field/view.hpp"

namespace firmtouch::field {

/// Proves the distance field of a mesh (asset/loading.hpp). It has no probes: its proof queries the
/// mesh at every cell.
class Loader : public asset::Prover<Proof> {
 public:
  using State = core::OneOf<Opening>;
  static const char* find(const asset::Container& asset, const char* wanted) {
    return asset::find_name(asset, kHeadSection, wanted);
  }
  /// Before begin(). `mesh` outlives the loader.
  void prove_against(const mesh::View& mesh) { mesh_ = &mesh; }
  template <class Trust>
  void begin(const asset::Container& asset, const char* name, State& state) {
    state.begin<typename Trust::template Opening<Proof>>(
        asset::find_sections<Sections>(asset, name), *mesh_);
  }
  template <class Trust>
  asset::Progress work(State& state, uint32_t units) {
    return work_proof<Trust>(state, units);
  }

 private:
  const mesh::View* mesh_ = nullptr;
};

}  // namespace firmtouch::field
