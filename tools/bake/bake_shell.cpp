#include "bake/bake_shell.hpp"

#include <algorithm>
#include <cstring>

#include "bake/filled_boxes.hpp"
#include "surface/edges.hpp"

namespace firmtouch::tools {
namespace {

class Encoder {
 public:
  explicit Encoder(const ShellSource& source)
      : source_(source), mesh_vertices_(source.head.mesh_vertex_count) {}

  std::vector<uint8_t> run() {
    number_vertices();
    if (ids_.size() > hull::kMostShellVertices) return {};
    order_faces();
    hull::ShellHead head{};
    head.cut = source_.cut;
    head.face_count = static_cast<uint32_t>(source_.faces.size());
    head.made_count = made_;
    head.kept_count = static_cast<uint32_t>(ids_.size()) - made_;
    hull::Box whole = box_of_point(at(ids_[0]));
    for (const uint32_t id : ids_) grow(whole, box_of_point(at(id)));
    std::copy(whole.low_m, whole.low_m + 3, head.low_m);
    std::copy(whole.high_m, whole.high_m + 3, head.high_m);
    bytes_.resize(sizeof head);
    put(filled_boxes(head.face_count, hull::kLeafFaces, whole, [&](uint32_t i) {
      hull::Box box = box_of_point(at(source_.faces[order_[i]][0]));
      for (const uint32_t id : source_.faces[order_[i]]) grow(box, box_of_point(at(id)));
      return box;
    }));
    std::vector<hull::ShellTriangle> triangles;
    std::vector<hull::ShellFace> faces;
    for (const uint32_t from : order_) {
      const auto& f = source_.faces[from];
      if (source_.triangles[from] != kNone)
        triangles.push_back({static_cast<uint32_t>(faces.size()), source_.triangles[from]});
      faces.push_back({{local(f[0]), local(f[1]), local(f[2])}});
    }
    put(faces);
    put_made();
    std::vector<hull::ShellVertex> kept;
    for (size_t i = made_; i < ids_.size(); ++i) {
      const math::Vec3 v = at(ids_[i]);
      kept.push_back({ids_[i], v.x, v.y, v.z});
    }
    put(kept);
    put(triangles);
    head.triangle_count = static_cast<uint32_t>(triangles.size());
    head.bytes = static_cast<uint32_t>(bytes_.size());
    std::memcpy(bytes_.data(), &head, sizeof head);
    return bytes_;
  }

 private:
  math::Vec3 at(uint32_t id) const { return source_.vertices_m[source_.numbers[id]]; }
  bool is_kept(uint32_t id) const { return source_.numbers[id] < mesh_vertices_; }

  // Those made by a collapse first.
  void number_vertices() {
    for (const auto& face : source_.faces) ids_.insert(ids_.end(), face.begin(), face.end());
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
    const auto kept = std::stable_partition(ids_.begin(), ids_.end(),
                                            [this](uint32_t id) { return !is_kept(id); });
    made_ = static_cast<uint32_t>(kept - ids_.begin());
    local_.assign(source_.numbers.size(), kNone);
    for (uint32_t i = 0; i < ids_.size(); ++i) local_[ids_[i]] = i;
  }
  uint16_t local(uint32_t id) const { return static_cast<uint16_t>(local_[id]); }

  void order_faces() {
    std::vector<math::Vec3> middles_m;
    for (const auto& f : source_.faces) {
      const math::Vec3 a = at(f[0]), b = at(f[1]), c = at(f[2]);
      middles_m.push_back({a.x + b.x + c.x, a.y + b.y + c.y, a.z + b.z + c.z});
    }
    order_ = filled_order(middles_m, hull::kLeafFaces);
  }

  void put_made() {
    const uint32_t one = 3 * source_.head.coordinate_bytes;
    std::vector<uint8_t> coordinates, ids;
    for (uint32_t i = 0; i < made_; ++i) {
      const uint8_t* from =
          source_.coordinates + size_t{source_.numbers[ids_[i]] - mesh_vertices_} * one;
      coordinates.insert(coordinates.end(), from, from + one);
      for (uint32_t k = 0; k < source_.head.id_bytes; ++k)
        ids.push_back(static_cast<uint8_t>(ids_[i] >> (8 * k)));
    }
    put(coordinates);
    put(ids);
  }

  template <class T>
  void put(const std::vector<T>& items) {
    const size_t at = bytes_.size(), size = items.size() * sizeof(T);
    bytes_.resize(at + hull::padded(static_cast<uint32_t>(size)));
    if (size != 0) std::memcpy(bytes_.data() + at, items.data(), size);
  }

  const ShellSource& source_;
  const uint32_t mesh_vertices_;
  std::vector<uint32_t> ids_, local_, order_;
  uint32_t made_ = 0;
  std::vector<uint8_t> bytes_;
};

}  // namespace

std::vector<uint8_t> encode_shell(const ShellSource& source) { return Encoder(source).run(); }

std::vector<uint32_t> cut_shell(const hull::View& view, uint32_t faces) {
  const hull::Head& head = view.head();
  ShellSource source;
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
  const hull::Shell& shell = view.shell();
  for (uint32_t i = 0, told = 0; i < shell.face_count(); ++i) {
    uint32_t triangle = kNone;
    if (told < shell.triangles().size() && shell.triangles()[told].face == i)
      triangle = shell.triangles()[told++].triangle;
    const hull::ShellFace& f = shell.face(i);
    add({shell.id_of(f.corner[0]), shell.id_of(f.corner[1]), shell.id_of(f.corner[2])}, triangle);
  }
  const std::vector<uint8_t> bytes = encode_shell(source);
  std::vector<uint32_t> words(bytes.size() / 4);
  if (!bytes.empty()) std::memcpy(words.data(), bytes.data(), bytes.size());
  return words;
}

}  // namespace firmtouch::tools
