#pragma once
// What open() says of a mesh, as one number, so that a test states rule and element at once.
#include "cube.hpp"
#include "harness/test.hpp"

namespace firmtouch::mesh_test {

/// Rule * 1000 + element: 106'004 is element 4 of R106; 0 is a mesh that passes.
inline uint32_t refusal_of(const mesh::Sections& sections) {
  mesh::View view;
  const core::Verdict verdict = mesh::open(sections, view);
  CHECK_EQ(verdict.ok(), view.is_open());
  return verdict.rule * 1000u + verdict.element;
}
inline uint32_t refusal_of(const Cube& cube) { return refusal_of(cube.sections()); }

inline core::Bytes shorter(core::Bytes bytes, uint32_t by) {
  return {bytes.data(), bytes.size() - by};
}

inline float quiet_nan() {
  const uint32_t bits = 0x7FC00000;
  float value;
  __builtin_memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace firmtouch::mesh_test
