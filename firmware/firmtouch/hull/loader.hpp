#pragma once
#include <stdint.h>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/asset/loading.hpp"
#include "firmtouch/core/one_of.hpp"
#include "firmtouch/hull/probes.hpp"
#include "firmtouch/hull/view.hpp"

namespace firmtouch::hull {

/// The sections of the hull of the mesh `name`, as Opening takes them. One that the asset lacks is
/// empty.
/// Bounds: a search of the section table each; no memory is copied.
Sections find_sections(const asset::Container& asset, const char* name);

/// Proves the hull of a mesh and runs its probe queries (asset/loading.hpp).
class Loader {
 public:
  using State = core::OneOf<Opening, ProbeRun>;
  static const char* find(const asset::Container& asset, const char* wanted);
  void close() { view_ = {}; }
  void begin(const asset::Container& asset, const char* name, State& state);
  /// Bounds: a probe query is one slice.
  asset::Progress work(State& state, uint32_t budget);
  /// Open once proven.
  const View& view() const { return view_; }

 private:
  View view_;
  core::Bytes probes_;
};

}  // namespace firmtouch::hull
