#include "bake/hull/bake_base_hull.hpp"

#include <algorithm>
#include <cstring>

#include "bake/hull/filled_boxes.hpp"
#include "surface/edges.hpp"

namespace firmtouch::tools {
namespace {

class Encoder {
 public:
  explicit Encoder(const BaseHullSource& source)
      : source_(source), mesh_vertices_(source.head.mesh_vertex_count) {}

  std::vector<uint8_t> run() {
    order_faces();
    number_vertices();
    if (ids_.size() > hull::kMaxBaseHullVertices) return {};
    hull::BaseHullHead head{};
    head.cut = source_.cut;
    head.face_count = static_cast<uint32_t>(source_.faces.size());
    head.made_count = made_;
    head.kept_count = static_cast<uint32_t>(ids_.size()) - made_;
    hull::Box whole = box_of_point(at(ids_[0]));
    for (const uint32_t id : ids_) grow(whole, box_of_point(at(id)));
    std::copy(whole.low_m, whole.low_m + 3, head.low_m);
    std::copy(whole.high_m, whole.high_m + 3, head.high_m);
    bytes_.resize(sizeof head);
    put(filled_boxes(head.face_count, hull::kLeafFaces, BoxesWithin::kWhole, whole,
                     [&](uint32_t i) { return boxes_[order_[i]]; }));
    put_faces(head);
    put(coordinates_of_made());
    std::vector<hull::BaseHullVertex> kept;
    for (size_t i = made_; i < ids_.size(); ++i) {
      const math::Vec3 v = at(ids_[i]);
      kept.push_back({ids_[i], v.x, v.y, v.z});
    }
    put(kept);
    put(ids_of_made());
    std::vector<hull::BaseHullTriangle> triangles;
    for (uint32_t i = 0; i < order_.size(); ++i)
      if (source_.triangles[order_[i]] != kNone)
        triangles.push_back({i, source_.triangles[order_[i]]});
    put(triangles);
    head.triangle_count = static_cast<uint32_t>(triangles.size());
    head.bytes = static_cast<uint32_t>(bytes_.size());
    std::memcpy(bytes_.data(), &head, sizeof head);
    return bytes_;
  }

 private:
  math::Vec3 at(uint32_t id) const { return source_.vertices_m[source_.numbers[id]]; }
  bool is_kept(uint32_t id) const { return source_.numbers[id] < mesh_vertices_; }

  // Those made by a collapse first, each kind as the faces meet it: a leaf's corners have numbers
  // that lie together.
  void number_vertices() {
    local_.assign(source_.numbers.size(), kNone);
    for (const bool is_kept_turn : {false, true}) {
      for (const uint32_t from : order_) {
        for (const uint32_t id : source_.faces[from]) {
          if (is_kept(id) != is_kept_turn || local_[id] != kNone) continue;
          local_[id] = static_cast<uint32_t>(ids_.size());
          ids_.push_back(id);
        }
      }
      if (!is_kept_turn) made_ = static_cast<uint32_t>(ids_.size());
    }
  }
  uint16_t local(uint32_t id) const { return static_cast<uint16_t>(local_[id]); }

  void order_faces() {
    for (const auto& f : source_.faces) {
      hull::Box box = box_of_point(at(f[0]));
      for (const uint32_t id : f) grow(box, box_of_point(at(id)));
      boxes_.push_back(box);
    }
    order_ = filled_order(boxes_, hull::kLeafFaces);
  }

  // Each leaf's corners as its faces meet them.
  void put_faces(hull::BaseHullHead& head) {
    std::vector<uint32_t> places;
    std::vector<uint16_t> corners;
    std::vector<hull::BaseHullFace> faces;
    for (uint32_t first = 0; first < order_.size(); first += hull::kLeafFaces) {
      const size_t begin = corners.size(),
                   end = std::min<size_t>(first + hull::kLeafFaces, order_.size());
      if (first / hull::kLeafFaces % 2 == 0) places.push_back(static_cast<uint32_t>(begin));
      for (size_t i = first; i < end; ++i) {
        uint32_t face = 0;
        for (uint32_t k = 0; k < 3; ++k) {
          const uint16_t vertex = local(source_.faces[order_[i]][k]);
          const auto from = corners.begin() + static_cast<std::ptrdiff_t>(begin);
          const auto found = std::find(from, corners.end(), vertex);
          face |= static_cast<uint32_t>(found - from) << (4 * k);
          if (found == corners.end()) corners.push_back(vertex);
        }
        faces.push_back(static_cast<hull::BaseHullFace>(face));
      }
      for (size_t i = first; i < end; ++i)
        faces[i] = static_cast<hull::BaseHullFace>(faces[i] | (corners.size() - begin) << 12);
    }
    head.corner_count = static_cast<uint32_t>(corners.size());
    put(places);
    put(faces);
    put(corners);
  }

  std::vector<uint8_t> coordinates_of_made() const {
    const uint32_t one = 3 * source_.head.coordinate_bytes;
    std::vector<uint8_t> coordinates;
    for (uint32_t i = 0; i < made_; ++i) {
      const uint8_t* from =
          source_.coordinates + size_t{source_.numbers[ids_[i]] - mesh_vertices_} * one;
      coordinates.insert(coordinates.end(), from, from + one);
    }
    return coordinates;
  }
  std::vector<uint8_t> ids_of_made() const {
    std::vector<uint8_t> ids;
    for (uint32_t i = 0; i < made_; ++i)
      for (uint32_t k = 0; k < source_.head.id_bytes; ++k)
        ids.push_back(static_cast<uint8_t>(ids_[i] >> (8 * k)));
    return ids;
  }

  template <class T>
  void put(const std::vector<T>& items) {
    const size_t at = bytes_.size(), size = items.size() * sizeof(T);
    bytes_.resize(at + hull::padded(static_cast<uint32_t>(size)));
    if (size != 0) std::memcpy(bytes_.data() + at, items.data(), size);
  }

  const BaseHullSource& source_;
  const uint32_t mesh_vertices_;
  std::vector<hull::Box> boxes_;  // of the faces as they came
  std::vector<uint32_t> ids_, local_, order_;
  uint32_t made_ = 0;
  std::vector<uint8_t> bytes_;
};

}  // namespace

std::vector<uint8_t> encode_base_hull(const BaseHullSource& source) {
  return Encoder(source).run();
}

std::vector<uint32_t> cut_base_hull(const hull::View& view, uint32_t faces) {
  const hull::Head& head = view.head();
  BaseHullSource source;
  source.head = head;
  const uint32_t all = head.mesh_triangle_count;
  source.cut = std::min(faces >= all ? 0 : (all - faces + 1) / 2, head.collapse_count);
  for (uint32_t id = 0; id < view.id_count(); ++id) source.numbers.push_back(view.number_of(id));
  for (uint32_t n = 0; n < view.id_count(); ++n) source.vertices_m.push_back(hull::vertex(view, n));
  source.coordinates = view.collapse_count() == 0 ? nullptr : view.coordinates(0);
  const uint32_t newer = head.mesh_vertex_count + source.cut;
  const auto add = [&](const std::array<uint32_t, 3>& face, uint32_t triangle) {
    uint32_t youngest = 0;
    for (const uint32_t id : face) youngest = std::max(youngest, source.numbers[id]);
    if (youngest >= newer) return;
    source.faces.push_back(face);
    source.triangles.push_back(youngest < head.mesh_vertex_count ? triangle : kNone);
  };
  for (uint32_t k = source.cut; k < head.collapse_count; ++k) {
    const uint8_t* record = view.record(k);
    const hull::Star star(view, k, record);
    uint32_t triangle = 1 + star.link;
    for (uint32_t i = 0; i < star.face_count(); ++i) {
      uint32_t corner[3];
      star.face(i, corner);
      const bool is_of_mesh = star.youngest(corner) < head.mesh_vertex_count;
      add({star.id[corner[0]], star.id[corner[1]], star.id[corner[2]]},
          is_of_mesh ? view.id_in(record, triangle++) : kNone);
    }
  }
  const hull::BaseHull& base_hull = view.base_hull();
  for (uint32_t i = 0, reported = 0; i < base_hull.face_count(); ++i) {
    uint32_t triangle = kNone;
    if (reported < base_hull.triangles().size() && base_hull.triangles()[reported].face == i)
      triangle = base_hull.triangles()[reported++].triangle;
    add({base_hull.id_of(base_hull.vertex_of(i, 0)), base_hull.id_of(base_hull.vertex_of(i, 1)),
         base_hull.id_of(base_hull.vertex_of(i, 2))},
        triangle);
  }
  const std::vector<uint8_t> bytes = encode_base_hull(source);
  std::vector<uint32_t> words(bytes.size() / 4);
  if (!bytes.empty()) std::memcpy(words.data(), bytes.data(), bytes.size());
  return words;
}

}  // namespace firmtouch::tools
