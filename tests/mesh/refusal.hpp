#pragma once
// What open() says of a mesh, as one number, so that a test states rule and element at once.
#include "cube.hpp"
#include "harness/float_bits.hpp"
#include "harness/rules.hpp"

namespace firmtouch::mesh_test {

using test::nan_value;
using test::shorter;

inline uint32_t refusal_of(const mesh::Sections& sections) {
  return test::refusal(test::verdict_of<mesh::View>(sections));
}
inline uint32_t refusal_of(const Cube& cube) { return refusal_of(cube.sections()); }
/// The same of a cube in which something is changed.
template <class Change>
uint32_t cube_with(Change change) {
  Cube cube;
  change(cube);
  return refusal_of(cube);
}

}  // namespace firmtouch::mesh_test
