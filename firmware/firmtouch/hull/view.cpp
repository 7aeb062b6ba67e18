#include "firmtouch/hull/view.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/hull/box_descent.hpp"
#include "firmtouch/hull/face_hash.hpp"
#include "firmtouch/query/seen_box.hpp"

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

uint32_t levels_of(uint32_t at) {
  return at == 0 ? 0 : 32 - static_cast<uint32_t>(__builtin_clz(at));
}

// Continues the boxes on the way down to node `at`, counted from 1, from those to `before`, or 0.
// Result: the last; nullptr where one is inverted.
const Box* narrow(core::Span<const NodeBox> boxes, uint32_t before, uint32_t at, Box* path) {
  const uint32_t levels = levels_of(at);
  uint32_t to_do = levels_of(before) == levels ? levels_of(before ^ at) : levels;
  while (to_do-- > 0) {
    Box& box = path[levels - to_do];
    box = child_box((&box)[-1], boxes[(at >> to_do) - 1]);
    for (uint32_t k = 0; k < 3; ++k)
      if (!(box.low_m[k] <= box.high_m[k])) return nullptr;
  }
  return path + levels;
}

using Stage = query::StageOf<Proof>;

}  // namespace

const query::CheckStage Proof::kStages[6] = {
    Stage::of<&Proof::vertex_count, &Proof::check_mesh_vertices>(1),
    Stage::of<&Proof::id_count, &Proof::check_ids, &Proof::finish_ids>(2),
    Stage::of<&Proof::record_count, &Proof::check_record, &Proof::finish_records>(80),
    Stage::of<&Proof::leaf_count, &Proof::check_leaves, &Proof::finish_leaves>(15),
    Stage::of<&Proof::base_vertex_count, &Proof::check_base_vertex>(5),
    Stage::of<&Proof::base_face_count, &Proof::check_base_face, &Proof::finish_base_hull>(80)};

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
  const mesh::Head& head = view.mesh_head();
  const uint32_t inside =
      query::SeenBox().take(&view.mesh_vertices_[first].x_m, end - first, head.low_m, head.high_m);
  return inside == end - first ? kPassed : reject(kRuleMeshVertex, first + inside);
}

Verdict Proof::check_ids(uint32_t first, uint32_t end) {
  for (uint32_t id = first; id < end; ++id) {
    const uint32_t number = view.number_of(id);
    if (number >= view.id_count()) return reject(kRuleOriginRange, id);
    numbers_ += number_hash(number) - number_hash(id);
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

// Flattened: called, what reads a corner takes twice as long.
[[gnu::flatten]] Verdict Proof::check_star(uint32_t collapse, const uint8_t* record) {
  const Head& head = view.head();
  const uint32_t made = head.mesh_vertex_count + collapse, link = link_of(View::head_of(record));
  const uint32_t new_id = view.id_in(record, 0);
  if (new_id >= view.id_count() || view.number_of(new_id) != made || removed_by(new_id) <= collapse)
    return reject(kRuleNewVertex, collapse);
  HashedNumber corners[kMaxLink + 4];
  math::Extents seen;
  for (uint32_t i = 0; i < link + 2; ++i) {
    const uint32_t id = i < link ? view.id_in(record, 1 + i) : 2 * collapse + (i - link);
    if (i < link && (id >= view.id_count() || removed_by(id) <= collapse))
      return reject(kRuleLinkCorner, collapse);
    const uint32_t number = view.number_of(id);
    if (number >= made) return reject(kRuleLinkCorner, collapse);
    const Vec3 at_m = vertex(view, number);
    seen.take(at_m.x, at_m.y, at_m.z);
    corners[i < link ? i : i + 1] = HashedNumber(number);
  }
  corners[link] = corners[0];
  corners[link + 3] = corners[link + 1];
  const Vec3 vertex_m = made_vertex(view, collapse);
  if (!holds(box_of(head), vertex_m)) return reject(kRuleNewVertexOutside, collapse);
  const Box box = star_box_m(vertex_m, head.cell_m, view.star_box(collapse));
  if (!holds(box, seen)) return reject(kRuleStarBox, collapse);
  return check_faces(collapse, record, corners);
}

// Those that the collapse replaces and makes. Corners: the link, its first again; vertices 2 k, 2 k
// + 1 and 2 k again. So each face has two corners next to each other, and a third.
[[gnu::noinline]] Verdict Proof::check_faces(uint32_t collapse, const uint8_t* record,
                                             const HashedNumber* corners) {
  const uint32_t mesh_vertices = view.head().mesh_vertex_count;
  const uint32_t word = View::head_of(record), link = link_of(word), split = split_of(word);
  uint32_t reported = 0;
  uint64_t replaced = 0, made = 0;
  for (uint32_t i = 0; i < link + 3; ++i) {
    if (i == link) continue;
    const HashedNumber &b = corners[i], &c = corners[i + 1];
    const HashedNumber& a = i < split  ? corners[link + 1]
                            : i < link ? corners[link + 2]
                                       : corners[i == link + 1 ? 0 : split];
    if (i < link) made += pair_hash(b, c);
    if (a.number >= mesh_vertices || b.number >= mesh_vertices || c.number >= mesh_vertices) {
      replaced += face_hash(a, b, c);
      continue;
    }
    if (reported == triangles_of(word)) return reject(kRuleStarTriangles, collapse);
    const uint32_t triangle = view.id_in(record, 1 + link + reported++);
    const uint32_t corner[3] = {a.number, b.number, c.number};
    if (triangle >= view.head().mesh_triangle_count ||
        !is_same_face(corner, view.triangle(triangle).corner))
      return reject(kRuleStarTriangles, collapse);
    replaced += number_hash(triangle);
  }
  faces_ += HashedNumber(mesh_vertices + collapse).first * made - replaced;
  return reported == triangles_of(word) ? kPassed : reject(kRuleStarTriangles, collapse);
}

uint32_t Proof::leaf_count() const {
  return leaves_for(view.mesh_head().triangle_count, kLeafTriangles);
}

// Of the boxes above a leaf, those that the leaf before had too are kept.
[[gnu::flatten]] Verdict Proof::check_leaves(uint32_t first, uint32_t end) {
  const FilledTree tree(view.boxes_.size());
  Box path[kMaxTreeDepth + 1] = {box_of(view.mesh_head())};
  uint32_t before = 0;
  for (uint32_t leaf = first; leaf < end; ++leaf) {
    const uint32_t begin = leaf * kLeafTriangles, left = view.mesh_head().triangle_count - begin;
    const uint32_t at = tree.node(leaf) + 1;  // counted from 1, a node's parent is its half
    const Box* const box = narrow(view.boxes_, before, at, path);
    before = at;
    if (box == nullptr) return reject(kRuleLeafBox, begin);
    math::Extents seen;
    for (uint32_t i = begin; i < begin + (left < kLeafTriangles ? left : kLeafTriangles); ++i) {
      const mesh::Triangle<uint32_t> t = view.triangle(i);
#pragma GCC unroll 3
      for (const uint32_t corner : t.corner) {
        if (corner >= view.head().mesh_vertex_count) return reject(kRuleTriangleCorner, i);
        const mesh::Vertex& p = view.mesh_vertices_[corner];
        seen.take(p.x_m, p.y_m, p.z_m);
      }
      faces_ += number_hash(i);
    }
    if (!holds(*box, seen)) return reject(kRuleLeafBox, begin);
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
