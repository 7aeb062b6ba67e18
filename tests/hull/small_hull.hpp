#pragma once
// A baked hull in memory that a test may change, without heap: one copy, made anew each time.
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/hull/view.hpp"
#include "harness/rules.hpp"
#include "small_hull_words.hpp"

namespace firmtouch::hull_test {

constexpr const char* kName = "model";

struct SmallHull {
  alignas(16) static inline uint8_t bytes[sizeof kWords];
  hull::Sections sections;

  SmallHull() {
    __builtin_memcpy(bytes, kWords, sizeof kWords);
    asset::Container all;
    CHECK(asset::open({bytes, sizeof bytes}, all).ok());
    sections = {
        all.find(hull::kHeadSection, kName),          all.find(hull::kVerticesSection, kName),
        all.find(hull::kOriginsSection, kName),       all.find(hull::kRecordsSection, kName),
        all.find(hull::kRecordOffsetsSection, kName), all.find(hull::kStarBoxesSection, kName),
        all.find(hull::kBoxesSection, kName),         all.find(hull::kBaseHullSection, kName),
        all.find(mesh::kHeadSection, kName),          all.find(mesh::kVerticesSection, kName),
        all.find(mesh::kTriangles16Section, kName),   {}};
  }
  /// The same bytes, to be changed.
  static uint8_t* open_up(core::Bytes bytes_of) { return bytes + (bytes_of.data() - bytes); }
  hull::Head& head() { return *reinterpret_cast<hull::Head*>(open_up(sections.head)); }
  mesh::Head& mesh_head() { return *reinterpret_cast<mesh::Head*>(open_up(sections.mesh_head)); }
  hull::BaseHullHead& base_hull_head() {
    return *reinterpret_cast<hull::BaseHullHead*>(open_up(sections.base_hull));
  }
  float& mesh_coordinate(uint32_t i) {
    return reinterpret_cast<float*>(open_up(sections.mesh_vertices))[i];
  }
  uint16_t& mesh_corner(uint32_t i) {
    return reinterpret_cast<uint16_t*>(open_up(sections.triangles16))[i];
  }
  uint8_t* record(uint32_t collapse) {
    uint8_t* at = open_up(sections.records);
    for (; collapse > 0; --collapse) at += hull::record_size(hull::View::head_of(at), 2);
    return at;
  }
  /// Of a record, as hull::View::id_in().
  static void set_id(uint8_t* record, uint32_t i, uint32_t id) {
    record[2 + 2 * i] = static_cast<uint8_t>(id);
    record[3 + 2 * i] = static_cast<uint8_t>(id >> 8);
  }
  static uint32_t get_id(const uint8_t* record, uint32_t i) {
    return record[2 + 2 * i] | static_cast<uint32_t>(record[3 + 2 * i]) << 8;
  }

  /// Puts a copy of what `id` reads behind the last id: a number that would do there.
  /// Result: the id behind the last one.
  uint32_t add_origin(uint32_t id) {
    static uint8_t memory[1024];
    return add_copy(sections.origins, memory, 2, id);
  }
  /// The same of the mesh's triangles.
  uint32_t add_triangle(uint32_t triangle) {
    alignas(4) static uint8_t memory[4096];
    return add_copy(sections.triangles16, memory, 6, triangle);
  }
  template <class Section, uint32_t kBytes>
  static uint32_t add_copy(Section& section, uint8_t (&memory)[kBytes], uint32_t each,
                           uint32_t copied) {
    const uint32_t bytes_of = section.size();
    CHECK(bytes_of + each <= kBytes);
    __builtin_memcpy(memory, section.data(), bytes_of);
    __builtin_memcpy(memory + bytes_of, memory + each * copied, each);
    section = {memory, bytes_of};
    return bytes_of / each;
  }

  // Parts of the base hull, in the layout's order.
  uint8_t* base_hull_boxes() { return open_up(sections.base_hull) + sizeof(hull::BaseHullHead); }
  uint32_t base_hull_leaves() {
    return hull::leaves_for(base_hull_head().face_count, hull::kLeafFaces);
  }
  uint32_t* base_hull_corner_offsets() {
    return reinterpret_cast<uint32_t*>(base_hull_boxes() +
                                       hull::padded(6 * hull::nodes_for(base_hull_leaves())));
  }
  hull::BaseHullFace* base_hull_faces() {
    return reinterpret_cast<hull::BaseHullFace*>(base_hull_corner_offsets() +
                                                 hull::corner_offsets_for(base_hull_leaves()));
  }
  uint16_t* base_hull_corners() {
    return reinterpret_cast<uint16_t*>(reinterpret_cast<uint8_t*>(base_hull_faces()) +
                                       hull::padded(2 * base_hull_head().face_count));
  }
  uint8_t* base_hull_coordinates() {
    return reinterpret_cast<uint8_t*>(base_hull_corners()) +
           hull::padded(2 * base_hull_head().corner_count);
  }
  hull::BaseHullVertex* base_hull_kept() {
    return reinterpret_cast<hull::BaseHullVertex*>(base_hull_coordinates() +
                                                   hull::padded(6 * base_hull_head().made_count));
  }
  uint8_t* base_hull_ids() {
    return reinterpret_cast<uint8_t*>(base_hull_kept() + base_hull_head().kept_count);
  }
  hull::BaseHullTriangle* base_hull_triangles() {
    return reinterpret_cast<hull::BaseHullTriangle*>(base_hull_ids() +
                                                     hull::padded(2 * base_hull_head().made_count));
  }
};

/// What open() says of a hull in which something is changed.
template <class Change>
core::Verdict verdict_with(Change change) {
  SmallHull small;
  change(small);
  return test::verdict_of<hull::View>(small.sections);
}
template <class Change>
uint32_t refusal_with(Change change) {
  return test::refusal(verdict_with(change));
}
template <class Change>
uint32_t rule_with(Change change) {
  return verdict_with(change).rule;
}

}  // namespace firmtouch::hull_test
