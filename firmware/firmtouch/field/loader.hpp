#pragma once
#include <stdint.h>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/asset/loading.hpp"
#include "firmtouch/core/one_of.hpp"
#include "firmtouch/field/view.hpp"

namespace firmtouch::field {

/// The sections of the distance field of the mesh `name`, as Opening takes them. One that the asset
/// lacks is empty.
/// Bounds: a search of the section table each; no memory is copied.
Sections find_sections(const asset::Container& asset, const char* name);

/// Proves the distance field of a mesh (asset/loading.hpp). It has no probes: its proof queries the
/// mesh at every cell.
class Loader {
 public:
  using State = core::OneOf<Opening>;
  static const char* find(const asset::Container& asset, const char* wanted);
  /// Before begin(). `mesh` outlives the loader.
  void prove_against(const mesh::View& mesh) { mesh_ = &mesh; }
  void close() { view_ = {}; }
  void begin(const asset::Container& asset, const char* name, State& state);
  asset::Progress work(State& state, uint32_t budget);
  /// Open once loaded.
  const View& view() const { return view_; }

 private:
  const mesh::View* mesh_ = nullptr;
  View view_;
};

}  // namespace firmtouch::field
