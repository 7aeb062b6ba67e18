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

// Whether the same three stand in the same turn.
bool is_same_face(const uint32_t (&a)[3], const uint32_t (&b)[3]) {
  for (uint32_t turn = 0; turn < 3; ++turn)
    if (a[0] == b[turn] && a[1] == b[(turn + 1) % 3] && a[2] == b[(turn + 2) % 3]) return true;
  return false;
}

using Stage = query::StageOf<Proof>;

}  // namespace

const query::CheckStage Proof::kStages[6] = {
    {1, Stage::count<&Proof::vertex_count>, Stage::all<&Proof::check_mesh_vertices>},
    {2, Stage::count<&Proof::id_count>, Stage::all<&Proof::check_ids>,
     Stage::finish<&Proof::finish_ids>},
    {80, Stage::count<&Proof::record_count>, Stage::each<&Proof::check_record>,
     Stage::finish<&Proof::finish_records>},
    {30, Stage::count<&Proof::leaf_count>, Stage::each<&Proof::check_leaf>,
     Stage::finish<&Proof::finish_leaves>},
    {5, Stage::count<&Proof::base_vertex_count>, Stage::each<&Proof::check_base_vertex>},
    {80, Stage::count<&Proof::base_face_count>, Stage::each<&Proof::check_base_face>,
     Stage::finish<&Proof::finish_base_hull>}};

Verdict Proof::take_mesh(const Sections& s) {
  const core::Span<const mesh::Head> heads = core::as_whole_array<mesh::Head>(s.mesh_head);
  if (heads.size() != 1) return reject(kRuleMeshHead);
  view.mesh_head_ = &heads[0];
  view.mesh_vertices_ = core::as_whole_array<mesh::Vertex>(s.mesh_vertices);
  if (heads[0].vertex_count == 0 || view.mesh_vertices_.size() != heads[0].vertex_count)
    return reject(kRuleMeshVerticesSize, view.mesh_vertices_.size());
  view.triangles16_ = core::as_whole_array<mesh::Triangle<uint16_t>>(s.triangles16);
  view.triangles32_ = core::as_whole_array<mesh::Triangle<uint32_t>>(s.triangles32);
  const uint32_t triangles =
      s.triangles32.empty() ? view.triangles16_.size() : view.triangles32_.size();
  if (s.triangles16.empty() == s.triangles32.empty() || heads[0].triangle_count == 0 ||
      heads[0].triangle_count > mesh::kMaxTriangles || triangles != heads[0].triangle_count)
    return reject(kRuleMeshTrianglesSize, triangles);
  return kPassed;
}

Verdict Proof::take(const Sections& s) {
  const Verdict of_mesh = take_mesh(s);
  if (!of_mesh.ok()) return of_mesh;
  const mesh::Head& mesh = *view.mesh_head_;
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
  view.head_ = &head;
  view.vertices_ = s.vertices;
  if (s.vertices.size() != head.collapse_count * 3 * head.coordinate_bytes)
    return reject(kRuleVerticesSize, s.vertices.size());
  view.origins_ = s.origins;
  if (s.origins.size() != ids * head.id_bytes) return reject(kRuleOriginsSize, s.origins.size());
  view.records_ = s.records;
  if (s.records.size() != head.record_bytes) return reject(kRuleRecordsSize, s.records.size());
  view.record_offsets_ = core::as_whole_array<uint32_t>(s.record_offsets);
  if (view.record_offsets_.size() != leaves_for(head.collapse_count, kRecordsPerOffset))
    return reject(kRuleRecordOffsetsSize, view.record_offsets_.size());
  view.star_boxes_ = core::as_whole_array<StarBox>(s.star_boxes);
  if (view.star_boxes_.size() != head.collapse_count)
    return reject(kRuleStarBoxesSize, view.star_boxes_.size());
  view.boxes_ = core::as_whole_array<NodeBox>(s.boxes);
  if (view.boxes_.size() != nodes_for(leaves_for(mesh.triangle_count, kLeafTriangles)))
    return reject(kRuleBoxesSize, view.boxes_.size());
  // Its rules come last; a trusted asset has no proof that comes to them.
  base_hull_bytes_ = s.base_hull;
  (void)base_hull_.begin(base_hull_bytes_, view);
  view.base_hull_ = base_hull_.base_hull();
  return kPassed;
}

Verdict Proof::check_head() const {
  const Head& head = view.head();
  const mesh::Head& mesh = view.mesh_head();
  if (!is_box(mesh.low_m, mesh.high_m)) return reject(kRuleMeshBox);
  for (uint32_t k = 0; k < 3; ++k)
    if (!(head.grid_low_m[k] >= -kFarthest_m && head.grid_low_m[k] <= kFarthest_m))
      return reject(kRuleGrid, k);
  if (!query::is_power_of_two(head.cell_m) || !(head.cell_m <= kFarthest_m))
    return reject(kRuleGrid, 3);
  if (!is_box(head.low_m, head.high_m)) return reject(kRuleHeadBox, 0);
  const Box box = box_of(head);
  if (!holds(box, {mesh.low_m[0], mesh.low_m[1], mesh.low_m[2]}) ||
      !holds(box, {mesh.high_m[0], mesh.high_m[1], mesh.high_m[2]}))
    return reject(kRuleHeadBox, 1);
  return kPassed;
}

Verdict Proof::check_mesh_vertices(uint32_t first, uint32_t end) {
  const Box box = box_of(view.mesh_head());
  for (uint32_t i = first; i < end; ++i)
    if (!holds(box, view.mesh_vertex(i))) return reject(kRuleMeshVertex, i);
  return kPassed;
}

Verdict Proof::check_ids(uint32_t first, uint32_t end) {
  for (uint32_t id = first; id < end; ++id) {
    const uint32_t number = view.number_of(id);
    if (number >= view.id_count()) return reject(kRuleOriginRange, id);
    numbers_ += scattered(number) - scattered(id);
  }
  return kPassed;
}

Verdict Proof::finish_ids() { return numbers_ == 0 ? kPassed : reject(kRuleOriginTwice); }

Verdict Proof::check_record(uint32_t collapse) {
  const Head& head = view.head();
  if (collapse % kRecordsPerOffset == 0 &&
      view.record_offsets_[collapse / kRecordsPerOffset] != record_at_)
    return reject(kRuleRecordOffset, collapse);
  const uint32_t left = head.record_bytes - record_at_;
  const uint8_t* record = view.records_.data() + record_at_;
  if (left < 2) return reject(kRuleRecordOffset, collapse);
  const uint32_t word = View::head_of(record), size = record_size(word, head.id_bytes);
  if (size > left) return reject(kRuleRecordOffset, collapse);
  if (link_of(word) < 3 || split_of(word) == 0 || split_of(word) >= link_of(word))
    return reject(kRuleLink, collapse);
  record_at_ += size;
  return check_star(collapse, record);
}

Verdict Proof::finish_records() {
  return record_at_ == view.head().record_bytes ? kPassed : reject(kRuleRecordsEnd, record_at_);
}

Verdict Proof::check_star(uint32_t collapse, const uint8_t* record) {
  const Head& head = view.head();
  const uint32_t mesh_vertices = head.mesh_vertex_count, made = mesh_vertices + collapse;
  const uint32_t new_id = view.id_in(record, 0);
  if (new_id >= view.id_count() || view.number_of(new_id) != made || removed_by(new_id) <= collapse)
    return reject(kRuleNewVertex, collapse);
  for (uint32_t i = 0; i < link_of(View::head_of(record)); ++i) {
    const uint32_t id = view.id_in(record, 1 + i);
    if (id >= view.id_count() || removed_by(id) <= collapse)
      return reject(kRuleLinkCorner, collapse);
  }
  const Star star(view, collapse, record);
  for (uint32_t i = 0; i < 2 + star.link; ++i)
    if (star.number[i] >= made) return reject(kRuleLinkCorner, collapse);
  const Vec3 vertex_m = made_vertex(view, collapse);
  if (!holds(box_of(head), vertex_m)) return reject(kRuleNewVertexOutside, collapse);
  const Box box = star_box_m(vertex_m, head.cell_m, view.star_box(collapse));
  for (uint32_t i = 0; i < 2 + star.link; ++i)
    if (!holds(box, vertex(view, star.number[i]))) return reject(kRuleStarBox, collapse);
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
    const uint32_t triangle = view.id_in(record, 1 + star.link + reported++);
    if (triangle >= head.mesh_triangle_count ||
        !is_same_face(number, view.triangle(triangle).corner))
      return reject(kRuleStarTriangles, collapse);
  }
  for (uint32_t i = 0; i < star.link; ++i)
    faces_ += face_hash(made, star.number[2 + i], star.number[i + 1 == star.link ? 2 : 3 + i]);
  return reported == triangles ? kPassed : reject(kRuleStarTriangles, collapse);
}

uint32_t Proof::leaf_count() const {
  return leaves_for(view.mesh_head().triangle_count, kLeafTriangles);
}

Verdict Proof::check_leaf(uint32_t leaf) {
  const uint32_t first = leaf * kLeafTriangles, left = view.mesh_head().triangle_count - first;
  const FilledTree tree(view.boxes_.size());
  Box box;
  const bool is_box = tree.box_of(view.boxes_, box_of(view.mesh_head()), tree.node(leaf), box);
  for (uint32_t i = first; i < first + (left < kLeafTriangles ? left : kLeafTriangles); ++i) {
    const mesh::Triangle<uint32_t> t = view.triangle(i);
    for (const uint32_t corner : t.corner) {
      if (corner >= view.head().mesh_vertex_count) return reject(kRuleTriangleCorner, i);
      if (!is_box || !holds(box, view.mesh_vertex(corner))) return reject(kRuleLeafBox, i);
    }
    faces_ += face_hash(t.corner[0], t.corner[1], t.corner[2]);
  }
  return kPassed;
}

Verdict Proof::finish_leaves() {
  const Verdict found = base_hull_.begin(base_hull_bytes_, view);
  return found.ok() ? base_hull_.check_head(view) : found;
}

Verdict Proof::check_base_vertex(uint32_t i) { return base_hull_.check_vertex(i, view); }

Verdict Proof::check_base_face(uint32_t i) { return base_hull_.check_face(i, view); }

Verdict Proof::finish_base_hull() {
  const Verdict found = base_hull_.finish();
  if (!found.ok()) return found;
  if (view.base_hull_.head().cut != view.collapse_count()) return reject(kRuleBaseHullCut);
  return faces_ == base_hull_.faces() ? kPassed : reject(kRuleFaces);
}

}  // namespace firmtouch::hull

template class firmtouch::query::Opening<firmtouch::hull::Proof>;
