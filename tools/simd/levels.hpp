#pragma once
#include <stdint.h>

#include <string>
#include <vector>

// Outside of `firmtouch`, the namespace that each level renames.
namespace firmtouch_simd {

/// The wide search, compiled for one instruction-set level (level.cpp). A level has a copy of the
/// library's inline functions under a namespace of its own: the linker must not take one that this
/// processor cannot run. So the library's types cross here by address; they have one layout at
/// every level.
struct Searches {
  // mesh::View, simd::WideTree, three floats, query::Budget, mesh::Hint, mesh::Closest.
  void (*closest_point)(const void* mesh, const void* tree, const float* p_m, const void* budget,
                        void* hint, void* closest);
  // ..., query::Budget, mesh::Hit.
  void (*cast_segment)(const void* mesh, const void* tree, const float* a_m, const float* b_m,
                       const void* budget, void* hit);
  void (*any_crossing)(const void* mesh, const void* tree, const float* a_m, const float* b_m,
                       const void* budget, void* hit);
  // ..., mesh::SurfaceCrossing[size], mesh::Crossings.
  void (*all_crossings)(const void* mesh, const void* tree, const float* a_m, const float* b_m,
                        const void* budget, void* buffer, uint32_t size, void* crossings);
};

struct Level {
  const char* name;          // as `--isa` has it
  const Searches* searches;  // null: the scalar search
};

/// The levels that this processor runs, the highest last; the first is "scalar".
const std::vector<Level>& levels();

/// The level of new WideMesh objects: the fastest, unless use_level() chose another.
const Level& level();

/// Result: empty, or why there is no such level here.
std::string use_level(const std::string& name);

}  // namespace firmtouch_simd
