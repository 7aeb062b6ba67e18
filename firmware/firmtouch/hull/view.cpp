#include "firmtouch/hull/view.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/hull/box_descent.hpp"

namespace firmtouch::hull {
namespace {

using core::kPassed;
using core::reject;
using core::Verdict;
using math::Vec3;

constexpr float kFarthest_m = 1e8f;  // a model ends at 1e7 m, its hull not much later

bool is_box(const float* low_m, const float* high_m) {
  for (uint32_t k = 0; k < 3; ++k)
    if (!(low_m[k] >= -kFarthest_m && low_m[k] <= high_m[k] && high_m[k] <= kFarthest_m))
      return false;
  return true;
}

Box box_of(const float (&low_m)[3], const float (&high_m)[3]) {
  return {{low_m[0], low_m[1], low_m[2]}, {high_m[0], high_m[1], high_m[2]}};
}

// Whether the same three stand in the same turn.
bool is_same_face(const uint32_t (&a)[3], const uint32_t (&b)[3]) {
  for (uint32_t turn = 0; turn < 3; ++turn)
    if (a[0] == b[turn] && a[1] == b[(turn + 1) % 3] && a[2] == b[(turn + 2) % 3]) return true;
  return false;
}

}  // namespace

const query::CheckStage<Opening> Opening::kStages[6] = {
    {&Opening::vertex_count, &Opening::check_mesh_vertex},
    {&Opening::id_count, &Opening::check_id, &Opening::finish_ids},
    {&Opening::record_count, &Opening::check_record, &Opening::finish_records},
    {&Opening::triangle_count, &Opening::check_triangle, &Opening::finish_triangles},
    {&Opening::base_vertex_count, &Opening::check_base_vertex},
    {&Opening::base_face_count, &Opening::check_base_face, &Opening::finish_base_hull}};

Opening::Opening(const Sections& sections) { check_.begin(open_head(sections)); }

void Opening::work(uint32_t elements) { check_.work(*this, kStages, elements); }

Verdict Opening::open_mesh(const Sections& s) {
  const core::Span<const mesh::Head> heads = core::as_whole_array<mesh::Head>(s.mesh_head);
  if (heads.size() != 1) return reject(kRuleMeshHead);
  view_.mesh_head_ = &heads[0];
  view_.mesh_vertices_ = core::as_whole_array<mesh::Vertex>(s.mesh_vertices);
  if (heads[0].vertex_count == 0 || view_.mesh_vertices_.size() != heads[0].vertex_count)
    return reject(kRuleMeshVerticesSize, view_.mesh_vertices_.size());
  view_.triangles16_ = core::as_whole_array<mesh::Triangle<uint16_t>>(s.triangles16);
  view_.triangles32_ = core::as_whole_array<mesh::Triangle<uint32_t>>(s.triangles32);
  const uint32_t triangles =
      s.triangles32.empty() ? view_.triangles16_.size() : view_.triangles32_.size();
  if (s.triangles16.empty() == s.triangles32.empty() || heads[0].triangle_count == 0 ||
      heads[0].triangle_count > mesh::kMaxTriangles || triangles != heads[0].triangle_count)
    return reject(kRuleMeshTrianglesSize, triangles);
  return is_box(heads[0].low_m, heads[0].high_m) ? kPassed : reject(kRuleMeshBox);
}

Verdict Opening::open_head(const Sections& s) {
  const Verdict of_mesh = open_mesh(s);
  if (!of_mesh.ok()) return of_mesh;
  const mesh::Head& mesh = *view_.mesh_head_;
  const core::Span<const Head> heads = core::as_whole_array<Head>(s.head);
  if (heads.size() != 1) return reject(kRuleHeadSize);
  const Head& head = heads[0];
  if (head.mesh_vertex_count != mesh.vertex_count) return reject(kRuleCounts, 0);
  if (head.mesh_triangle_count != mesh.triangle_count) return reject(kRuleCounts, 1);
  if (head.collapse_count > mesh.triangle_count / 2 ||
      2 * head.collapse_count > mesh.vertex_count + head.collapse_count)
    return reject(kRuleCounts, 2);
  if (head.id_bytes != 2 && head.id_bytes != 3) return reject(kRuleWidths, 0);
  if (head.coordinate_bytes != 2 && head.coordinate_bytes != 3) return reject(kRuleWidths, 1);
  const uint32_t ids = mesh.vertex_count + head.collapse_count;
  const uint32_t most = head.id_bytes == 2 ? 65536u : kMaxIds;
  if (ids > most || mesh.triangle_count > most) return reject(kRuleCounts, 3);
  view_.head_ = &head;
  view_.vertices_ = s.vertices;
  if (s.vertices.size() != head.collapse_count * 3 * head.coordinate_bytes)
    return reject(kRuleVerticesSize, s.vertices.size());
  view_.origins_ = s.origins;
  if (s.origins.size() != ids * head.id_bytes) return reject(kRuleOriginsSize, s.origins.size());
  view_.records_ = s.records;
  if (s.records.size() != head.record_bytes) return reject(kRuleRecordsSize, s.records.size());
  view_.record_offsets_ = core::as_whole_array<uint32_t>(s.record_offsets);
  if (view_.record_offsets_.size() != leaves_for(head.collapse_count, kRecordsPerOffset))
    return reject(kRuleRecordOffsetsSize, view_.record_offsets_.size());
  view_.star_boxes_ = core::as_whole_array<StarBox>(s.star_boxes);
  if (view_.star_boxes_.size() != head.collapse_count)
    return reject(kRuleStarBoxesSize, view_.star_boxes_.size());
  view_.boxes_ = core::as_whole_array<NodeBox>(s.boxes);
  if (view_.boxes_.size() != nodes_for(leaves_for(mesh.triangle_count, kLeafTriangles)))
    return reject(kRuleBoxesSize, view_.boxes_.size());
  for (uint32_t k = 0; k < 3; ++k)
    if (!(head.grid_low_m[k] >= -kFarthest_m && head.grid_low_m[k] <= kFarthest_m))
      return reject(kRuleGrid, k);
  if (!query::is_power_of_two(head.cell_m) || !(head.cell_m <= kFarthest_m))
    return reject(kRuleGrid, 3);
  if (!is_box(head.low_m, head.high_m)) return reject(kRuleHeadBox, 0);
  const Box box = box_of(head.low_m, head.high_m);
  if (!holds(box, {mesh.low_m[0], mesh.low_m[1], mesh.low_m[2]}) ||
      !holds(box, {mesh.high_m[0], mesh.high_m[1], mesh.high_m[2]}))
    return reject(kRuleHeadBox, 1);
  base_hull_bytes_ = s.base_hull;
  return kPassed;
}

Verdict Opening::check_mesh_vertex(uint32_t i) {
  const Vec3 v = view_.mesh_vertex(i);
  return holds(box_of(view_.mesh_head().low_m, view_.mesh_head().high_m), v)
             ? kPassed
             : reject(kRuleMeshVertex, i);
}

Verdict Opening::check_id(uint32_t id) {
  const uint32_t number = view_.number_of(id);
  if (number >= view_.id_count()) return reject(kRuleOriginRange, id);
  numbers_ += scattered(number) - scattered(id);
  return kPassed;
}

Verdict Opening::finish_ids() { return numbers_ == 0 ? kPassed : reject(kRuleOriginTwice); }

Verdict Opening::check_record(uint32_t collapse) {
  const Head& head = view_.head();
  if (collapse % kRecordsPerOffset == 0 &&
      view_.record_offsets_[collapse / kRecordsPerOffset] != record_at_)
    return reject(kRuleRecordOffset, collapse);
  const uint32_t left = head.record_bytes - record_at_;
  const uint8_t* record = view_.records_.data() + record_at_;
  if (left < 2) return reject(kRuleRecordOffset, collapse);
  const uint32_t word = View::head_of(record), size = record_size(word, head.id_bytes);
  if (size > left) return reject(kRuleRecordOffset, collapse);
  if (link_of(word) < 3 || split_of(word) == 0 || split_of(word) >= link_of(word))
    return reject(kRuleLink, collapse);
  record_at_ += size;
  return check_star(collapse, record);
}

Verdict Opening::finish_records() {
  return record_at_ == view_.head().record_bytes ? kPassed : reject(kRuleRecordsEnd, record_at_);
}

Verdict Opening::check_star(uint32_t collapse, const uint8_t* record) {
  const Head& head = view_.head();
  const uint32_t mesh_vertices = head.mesh_vertex_count, made = mesh_vertices + collapse;
  const uint32_t new_id = view_.id_in(record, 0);
  if (new_id >= view_.id_count() || view_.number_of(new_id) != made ||
      removed_by(new_id) <= collapse)
    return reject(kRuleNewVertex, collapse);
  for (uint32_t i = 0; i < link_of(View::head_of(record)); ++i) {
    const uint32_t id = view_.id_in(record, 1 + i);
    if (id >= view_.id_count() || removed_by(id) <= collapse)
      return reject(kRuleLinkCorner, collapse);
  }
  const Star star(view_, collapse, record);
  for (uint32_t i = 0; i < 2 + star.link; ++i)
    if (star.number[i] >= made) return reject(kRuleLinkCorner, collapse);
  const Vec3 vertex_m = made_vertex(view_, collapse);
  if (!holds(box_of(head.low_m, head.high_m), vertex_m))
    return reject(kRuleNewVertexOutside, collapse);
  const Box box = star_box_m(vertex_m, head.cell_m, view_.star_box(collapse));
  for (uint32_t i = 0; i < 2 + star.link; ++i)
    if (!holds(box, vertex(view_, star.number[i]))) return reject(kRuleStarBox, collapse);
  const uint32_t triangles = triangles_of(View::head_of(record));
  uint32_t reported = 0;
  for (uint32_t i = 0; i < star.face_count(); ++i) {
    uint32_t corner[3];
    star.face(i, corner);
    const uint32_t number[3] = {star.number[corner[0]], star.number[corner[1]],
                                star.number[corner[2]]};
    faces_ -= face_hash(number[0], number[1], number[2]);
    if (star.youngest(corner) >= mesh_vertices) continue;
    if (reported == triangles) return reject(kRuleStarTriangles, collapse);
    const uint32_t triangle = view_.id_in(record, 1 + star.link + reported++);
    if (triangle >= head.mesh_triangle_count ||
        !is_same_face(number, view_.triangle(triangle).corner))
      return reject(kRuleStarTriangles, collapse);
  }
  for (uint32_t i = 0; i < star.link; ++i)
    faces_ += face_hash(made, star.number[2 + i], star.number[i + 1 == star.link ? 2 : 3 + i]);
  return reported == triangles ? kPassed : reject(kRuleStarTriangles, collapse);
}

Verdict Opening::check_triangle(uint32_t i) {
  const mesh::Triangle<uint32_t> t = view_.triangle(i);
  for (const uint32_t corner : t.corner)
    if (corner >= view_.head().mesh_vertex_count) return reject(kRuleTriangleCorner, i);
  const FilledTree tree(view_.boxes_.size());
  Box box;
  if (!tree.box_of(view_.boxes_, box_of(view_.mesh_head().low_m, view_.mesh_head().high_m),
                   tree.node(i / kLeafTriangles), box))
    return reject(kRuleLeafBox, i);
  for (const uint32_t corner : t.corner)
    if (!holds(box, view_.mesh_vertex(corner))) return reject(kRuleLeafBox, i);
  faces_ += face_hash(t.corner[0], t.corner[1], t.corner[2]);
  return kPassed;
}

Verdict Opening::finish_triangles() { return base_hull_.begin(base_hull_bytes_, view_); }

Verdict Opening::check_base_vertex(uint32_t i) { return base_hull_.check_vertex(i, view_); }

Verdict Opening::check_base_face(uint32_t i) { return base_hull_.check_face(i, view_); }

Verdict Opening::finish_base_hull() {
  const Verdict found = base_hull_.finish();
  if (!found.ok()) return found;
  view_.base_hull_ = base_hull_.base_hull();
  if (view_.base_hull_.head().cut != view_.collapse_count()) return reject(kRuleBaseHullCut);
  return faces_ == base_hull_.faces() ? kPassed : reject(kRuleFaces);
}

Verdict open(const Sections& sections, View& view) {
  Opening opening(sections);
  return query::open_at_once(opening, view);
}

}  // namespace firmtouch::hull
