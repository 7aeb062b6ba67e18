#pragma once
#include <stdint.h>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/asset/loading.hpp"
#include "firmtouch/core/one_of.hpp"
#include "firmtouch/mesh/view.hpp"

namespace firmtouch::mesh {

/// The sections of the mesh `name`, as Opening takes them. One that the asset lacks is empty.
/// Bounds: a search of the section table each; no memory is copied.
Sections find_sections(const asset::Container& asset, const char* name);

/// Proves the mesh of an asset and runs its probe queries (asset/loading.hpp).
class Loader {
 public:
  using State = core::OneOf<Opening>;
  static const char* find(const asset::Container& asset, const char* wanted);
  void close() { view_ = {}; }
  void begin(const asset::Container& asset, const char* name, State& state);
  /// Bounds: all probes, at most 256 queries, are one slice.
  asset::Progress work(State& state, uint32_t budget);
  /// Open once loaded.
  const View& view() const { return view_; }

 private:
  View view_;
  core::Bytes probes_;
  bool is_proven_ = false;
};

}  // namespace firmtouch::mesh
