#pragma once
// A distance field of the cube of tests/mesh, made by hand without the baker and without heap.
#include "firmtouch/field/centre.hpp"
#include "firmtouch/field/view.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "harness/rules.hpp"
#include "mesh/cube.hpp"

namespace firmtouch::field_test {

using test::bytes;

struct CubeField {
  static constexpr uint32_t kSide = 8, kCells = kSide * kSide * kSide;
  mesh_test::Cube cube;
  field::Head head{};
  int16_t words[kCells];
  uint32_t seeds[kCells];

  CubeField() {
    for (uint32_t k = 0; k < 3; ++k) head.count[k] = kSide;
    for (float& low_m : head.low_m) low_m = -1.375f;
    head.is_signed = 1;
    head.cell_m = 0.34375f;
    head.quantum_m = 0x1p-12f;
    const mesh::View view = cube.view();
    mesh::Hint hint;
    for (uint32_t i = 0; i < kCells; ++i) {
      const mesh::Closest c = mesh::closest_point(view, centre_of(i), query::kUnlimited, hint);
      const int32_t quanta = static_cast<int32_t>(c.certificate.lower_m / head.quantum_m);
      words[i] = static_cast<int16_t>(c.certificate.sign < 0 ? -1 - quanta : quanta);
      seeds[i] = hint.leaf_slot;
    }
  }
  math::Vec3 centre_of(uint32_t i) const {
    return field::centre_of(head, i % kSide, i / kSide % kSide, i / kSide / kSide);
  }
  field::Sections sections() const {
    return {bytes(&head, sizeof head), bytes(words, sizeof words), bytes(seeds, sizeof seeds)};
  }
};

struct Opened {
  CubeField distance_field;
  mesh::View mesh = distance_field.cube.view();
  field::View view;
  Opened() { CHECK(field::open(distance_field.sections(), mesh, view).ok()); }
};

/// Pseudo-random, of at most `reach` in size.
inline float coordinate(uint32_t& state, float reach) {
  state = state * 1664525u + 1013904223u;
  return (static_cast<float>(static_cast<int32_t>(state >> 8)) * 0x1p-23f - 1.0f) * reach;
}

}  // namespace firmtouch::field_test
