#include "firmtouch/mesh/view.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/math/extents.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/box_frame.hpp"
#include "firmtouch/mesh/leaf_box.hpp"
#include "firmtouch/mesh/loss.hpp"

namespace firmtouch::mesh {
namespace {

using core::kPassed;
using core::reject;
using core::Verdict;
using math::Vec3;

// A model is at most 1e6 m large and its origin not much farther off: closest_point() counts on it
// for queries beyond the range where squares fit.
constexpr float kFarthest_m = 1e7f;

bool is_box(const uint32_t* box) { return query::are_axes(box[0], box[1], box[2]); }

// Whether both boxes of the node lie in another.
[[gnu::noinline]] bool holds(const uint32_t* outer, const Node& inner) {
  uint32_t held = query::kHeld;
  for (uint32_t k = 0; k < 3; ++k)
    held &=
        query::held(outer[k], inner.side[0].box[k]) & query::held(outer[k], inner.side[1].box[k]);
  return held == query::kHeld;
}

// Whether turned() shortens every vector, by 2^-16 to 2^-14. By Gershgorin's circles the square of
// a length is off by 3 * 2^-18 at most, and a product in float32 errs by 2^-22.
bool is_sound(const BoxFrame& frame) {
  for (uint32_t i = 0; i < 3; ++i) {
    const Vec3 products = along(frame, axis_of(frame, i));
    const float* const product = &products.x;
    for (uint32_t k = 0; k < 3; ++k) {
      const float wanted = i == k ? kAxisLength2 : 0.0f;
      if (!(__builtin_fabsf(product[k] - wanted) <= 0x1p-18f)) return false;
    }
    if (!(__builtin_fabsf(frame.centre_m[i]) <= kFarthest_m)) return false;
  }
  return true;
}

bool excludes_nothing(const uint32_t* words) {
  return words[0] == kNoLeafBox && words[1] == kNoLeafBox;
}

// Of all triangles' corners, one after the other.
[[gnu::always_inline]] inline uint32_t corner_at(const View& mesh, uint32_t n) {
  if (!mesh.triangles16().empty())
    return reinterpret_cast<const uint16_t*>(mesh.triangles16().data())[n];
  return reinterpret_cast<const uint32_t*>(mesh.triangles32().data())[n];
}

Vec3 position_of(const Vertex& v) { return {v.x_m, v.y_m, v.z_m}; }

// The n-th corner of all triangles, where the grid has it.
[[gnu::noinline]] Vec3 on_grid(const View& mesh, uint32_t n) {
  return in_box_frame(mesh, mesh.vertex(corner_at(mesh, n)));
}

// Whether a triangle is thinner than 1e-10 of its longest edge, or lower than 1e-18 m.
// Pre: ab is its longest edge, of 1e-12 m at least.
bool is_thin_measured(Vec3 ab, Vec3 ac, float ab2) {
  const float per_ab2 = 1.0f / ab2;
  const Vec3 normal = cross(ab * per_ab2, ac);
  const Vec3 height = ac - ab * (dot(ab, ac) * per_ab2);  // as the solver has it
  return !(dot(normal, normal) >= 1e-20f && dot(height, height) >= 1e-36f);
}
// Most are by far not, which needs no division. Where the squares are denormal it is measured.
[[gnu::always_inline]] inline bool is_thin(Vec3 ab, Vec3 ac, float ab2) {
  const Vec3 normal = cross(ab, ac);
  return !(dot(normal, normal) > 1e-8f * ab2 * ab2) && is_thin_measured(ab, ac, ab2);
}

using Stage = query::StageOf<Proof>;

}  // namespace

const query::CheckStage Proof::kStages[4] = {
    Stage::of<&Proof::vertex_count, &Proof::check_vertices, &Proof::finish_vertices>(1),
    Stage::of<&Proof::fold_words, &Proof::check_folds, &Proof::finish_folds>(1),
    Stage::of<&Proof::plain_node_count, &Proof::check_nodes>(25),
    Stage::of<&Proof::other_node_count, &Proof::check_nodes, &Proof::finish_nodes>(50)};

Verdict Proof::check_head() {
  const Head& head = view.head();
  if (!query::is_power_of_two(head.cell_m)) return reject(kRuleHead, 1);
  const float reach_m = static_cast<float>(kGridMax) * head.cell_m;
  float extent_m = 0;
  for (int k = 0; k < 3; ++k) {
    if (!(head.low_m[k] <= head.high_m[k]) ||
        !(head.low_m[k] >= -kFarthest_m && head.high_m[k] <= kFarthest_m))
      return reject(kRuleHead, 2);
    const float side_m = head.high_m[k] - head.low_m[k];
    if (side_m > extent_m) extent_m = side_m;
  }
  const Verdict grid = check_grid(reach_m, extent_m);
  if (!grid.ok()) return grid;
  const Vec3 sides{head.high_m[0] - head.low_m[0], head.high_m[1] - head.low_m[1],
                   head.high_m[2] - head.low_m[2]};
  const float diagonal_m = math::length(sides);
  if (!(head.diagonal_m <= diagonal_m && head.diagonal_m >= diagonal_m * (1.0f - 0x1p-20f)))
    return reject(kRuleHead, 5);
  if (!(head.longest_edge_m > 0.0f && head.longest_edge_m <= 1.001f * diagonal_m))
    return reject(kRuleHead, 6);
  if (!(head.rounding_m >= 0.0f && head.rounding_m <= kMaxRounding * head.diagonal_m))
    return reject(kRuleHead, 0);
  view.has_rivals_ = !Loss(head).is_within_promise(head.diagonal_m);
  return head.depth == 0 || head.depth > kMaxDepth ? reject(kRuleDepth, 0) : kPassed;
}

Verdict Proof::check_grid(float reach_m, float extent_m) const {
  const Head& head = view.head();
  if (const BoxFrame* const frame = view.box_frame_) {
    if (!(extent_m >= 1e-9f && is_sound(*frame))) return reject(kRuleHead, 7);
    // A tenth of the grid free about the root's boxes: FarBound relies on it.
    for (const Side& side : view.nodes_[0].side)
      for (const uint32_t axis : side.box)
        if ((axis & 0xFFFFu) < kTurnedFreeCells || axis >> 16 < kTurnedFreeCells)
          return reject(kRuleHead, 3);
    return kPassed;
  }
  for (int k = 0; k < 3; ++k) {  // an eighth of the extent free on each side: FarBound relies on it
    const float below_m = head.low_m[k] - head.grid_low_m[k];
    const float above_m = head.grid_low_m[k] + reach_m - head.high_m[k];
    if (!(below_m >= 0.124f * extent_m && above_m >= 0.124f * extent_m))
      return reject(kRuleHead, 3);
  }
  return extent_m >= 1e-9f && reach_m <= 2.6f * extent_m ? kPassed : reject(kRuleHead, 4);
}

Verdict Proof::take(const Sections& s) {
  const core::Span<const Head> heads = core::as_whole_array<Head>(s.head);
  if (heads.size() != 1) return reject(kRuleHeadSize, 0);
  const Head& head = heads[0];
  view.vertices_ = core::as_whole_array<Vertex>(s.vertices);
  if (head.vertex_count == 0 || view.vertices_.size() != head.vertex_count)
    return reject(kRuleVertices, 0);
  view.triangles16_ = core::as_whole_array<Triangle<uint16_t>>(s.triangles16);
  view.triangles32_ = core::as_whole_array<Triangle<uint32_t>>(s.triangles32);
  if (s.triangles16.empty() == s.triangles32.empty()) return reject(kRuleTriangles, 0);
  const uint32_t triangles =
      s.triangles32.empty() ? view.triangles16_.size() : view.triangles32_.size();
  if (head.triangle_count == 0 || head.triangle_count > kMaxTriangles ||
      triangles != head.triangle_count)
    return reject(kRuleTriangles, 1);
  view.nodes_ = core::as_whole_array<Node>(s.nodes);
  view.parents_ = core::as_whole_array<uint32_t>(s.parents);
  if (head.node_count == 0 || head.node_count > kMaxNodes ||
      view.nodes_.size() != head.node_count || view.parents_.size() != head.node_count)
    return reject(kRuleNodes, 0);
  view.vertex_normals_ = core::as_whole_array<uint32_t>(s.vertex_normals);
  view.folds_ = core::as_whole_array<EdgeFolds>(s.edge_folds);
  const bool with_sign = head.is_signed == 1;
  if (head.is_signed > 1 || view.vertex_normals_.size() != (with_sign ? head.vertex_count : 0) ||
      view.folds_.size() != (with_sign ? head.triangle_count : 0) ||
      s.vertex_normals.empty() == with_sign || s.edge_folds.empty() == with_sign)
    return reject(kRuleSigned, 0);
  view.head_ = &head;
  const core::Span<const BoxFrame> frames = core::as_whole_array<BoxFrame>(s.box_frame);
  if (frames.size() != (s.box_frame.empty() ? 0 : 1)) return reject(kRuleHeadSize, 0);
  view.box_frame_ = frames.data();
  return take_leaf_boxes(s);
}

// The box that a search reads behind the last leaf's excludes nothing.
Verdict Proof::take_leaf_boxes(const Sections& s) {
  if (s.leaf_boxes.empty()) return kPassed;
  const uint32_t triangles = view.triangles16_.size() + view.triangles32_.size();
  const uint32_t words = kLeafBoxStride * triangles;
  const core::Span<const uint32_t> boxes = core::as_whole_array<uint32_t>(s.leaf_boxes);
  if (boxes.size() != words + kLeafBoxesEnd) return reject(kRuleLeafBoxesSize, 0);
  if (!excludes_nothing(boxes.data() + words)) return reject(kRuleLeafBoxesSize, 1);
  for (uint32_t i = 2; i < kLeafBoxesEnd; ++i)
    if (boxes[words + i] != 0) return reject(kRuleLeafBoxesSize, 1);
  view.leaf_boxes_ = boxes.data();
  return kPassed;
}

Verdict Proof::check_vertices(uint32_t first, uint32_t end) {
  const Head& head = view.head();
  const uint32_t inside =
      seen_.take(&view.vertices_[first].x_m, end - first, head.low_m, head.high_m);
  if (inside != end - first) return reject(kRuleVertexOutsideBox, first + inside);
  if (!view.is_signed()) return kPassed;
  for (uint32_t i = first; i < end; ++i) {
    const uint32_t code = view.vertex_normals_[i];
    if ((code & 0xFFFFu) == 0xFFFFu || code >> 16 == 0xFFFFu) return reject(kRuleVertexNormal, i);
  }
  return kPassed;
}

Verdict Proof::finish_vertices() {
  const Head& head = view.head();
  const uint32_t side = seen_.untouched_side(head.low_m, head.high_m);
  return side < 6 ? reject(kRuleBoxNotTouched, side) : kPassed;
}

// Four folds at a time: one of -128 makes a zero byte of `word`, and the lowest of these is the
// lowest that borrows.
Verdict Proof::check_folds(uint32_t first, uint32_t end) {
  const uint8_t* const folds = reinterpret_cast<const uint8_t*>(view.folds_.data());
  for (uint32_t i = first; i < end; ++i) {
    uint32_t word;
    __builtin_memcpy(&word, folds + 4 * i, sizeof word);
    word ^= 0x80808080u;
    const uint32_t zeros = (word - 0x01010101u) & ~word & 0x80808080u;
    if (zeros != 0)
      return reject(kRuleFold, (4 * i + static_cast<uint32_t>(__builtin_ctz(zeros)) / 8) / 3);
  }
  return kPassed;
}

// Of the last, which fill no word.
Verdict Proof::finish_folds() {
  const uint32_t triangles = view.folds_.size();
  for (uint32_t i = triangles - (triangles < 2 ? triangles : 2); i < triangles; ++i)
    for (const int8_t fold : view.folds_[i].fold)
      if (fold < -kMaxFold) return reject(kRuleFold, i);
  return kPassed;
}

// A child's word names its parent, so no child is counted twice.
Verdict Proof::finish_nodes() {
  if (children_ + 1 != view.nodes_.size()) return reject(kRuleParent, children_);
  if (next_triangle_ != view.head().triangle_count)
    return reject(kRuleTrianglesLeft, next_triangle_);
  return deepest_ + 1 == view.head().depth ? kPassed : reject(kRuleDepth, deepest_);
}

// Of a triangle. Takes its corners into the box seen, in the frame of the boxes.
[[gnu::always_inline]] inline uint16_t Proof::broken_rule(uint32_t i, math::Extents& seen) const {
  const uint32_t vertices = view.vertices_.size();
  const uint32_t at_a = corner_at(view, 3 * i), at_b = corner_at(view, 3 * i + 1),
                 at_c = corner_at(view, 3 * i + 2);
  if (at_a >= vertices || at_b >= vertices || at_c >= vertices) return kRuleCorner;
  const Vertex &a = view.vertices_[at_a], &b = view.vertices_[at_b], &c = view.vertices_[at_c];
  const Vec3 ab{b.x_m - a.x_m, b.y_m - a.y_m, b.z_m - a.z_m};
  const Vec3 bc{c.x_m - b.x_m, c.y_m - b.y_m, c.z_m - b.z_m};
  const Vec3 ac{c.x_m - a.x_m, c.y_m - a.y_m, c.z_m - a.z_m};
  const float ab2 = dot(ab, ab);
  if (!(ab2 >= 1e-24f && ab2 >= dot(bc, bc) && ab2 >= dot(ac, ac))) return kRuleLongestEdgeFirst;
  if (!(math::square_root(ab2) <= view.head_->longest_edge_m)) return kRuleEdgeAboveLongest;
  if (is_thin(ab, ac, ab2)) return kRuleThinTriangle;
  Vec3 at_a_m = position_of(a), at_b_m = position_of(b), at_c_m = position_of(c);
  if (view.box_frame_ != nullptr) {
    at_a_m = on_grid(view, 3 * i);
    at_b_m = on_grid(view, 3 * i + 1);
    at_c_m = on_grid(view, 3 * i + 2);
  }
  seen.take(at_a_m.x, at_a_m.y, at_a_m.z);
  seen.take(at_b_m.x, at_b_m.y, at_b_m.z);
  seen.take(at_c_m.x, at_c_m.y, at_c_m.z);
  return 0;
}

// Whether what was seen along an axis is within a box. Cells are a power of two, so this is the box
// with the rounding that NearBound allows for.
[[gnu::always_inline]] inline bool Proof::is_along(uint32_t k, uint32_t axis, float low_m,
                                                   float high_m) const {
  const Head& head = *view.head_;
  const float slack_cells = view.box_frame_ != nullptr ? kTurnedSlackCells : 0.0f;
  const float from_m = (static_cast<float>(query::low_of(axis)) + slack_cells) * head.cell_m;
  const float to_m = (static_cast<float>(query::high_of(axis)) - slack_cells) * head.cell_m;
  return from_m <= low_m - head.grid_low_m[k] && high_m - head.grid_low_m[k] <= to_m;
}

[[gnu::noinline]] Verdict Proof::check_leaf(uint32_t i, uint32_t which) {
  const Node& node = view.nodes_[i];
  const uint32_t first = leaf_first(node.side[which].child),
                 count = leaf_count(node.side[which].child);
  // Only the second child of the one node of a mesh of one leaf may be empty.
  if (first != next_triangle_ || (count == 0 && !(which == 1 && view.nodes_.size() == 1)))
    return reject(kRuleLeaf, i);
  if (count > view.head_->triangle_count - first) return reject(kRuleLeaf, i);
  math::Extents seen;
  for (uint32_t n = first; n < first + count; ++n) {
    const uint16_t rule = broken_rule(n, seen);
    if (rule != 0) return reject(rule, n);
  }
  const uint32_t(&box)[3] = node.side[which].box;
  if (!is_along(0, box[0], seen.low_x, seen.high_x) ||
      !is_along(1, box[1], seen.low_y, seen.high_y) ||
      !is_along(2, box[2], seen.low_z, seen.high_z))
    return reject(kRuleTriangleOutsideLeaf, first);
  next_triangle_ += count;
  return view.leaf_boxes_ == nullptr || count == 0 ? kPassed : check_leaf_box(first, count);
}

Verdict Proof::check_nodes(uint32_t first, uint32_t end) {
  for (uint32_t i = first; i < end; ++i) {
    const Node& node = view.nodes_[i];
    const uint32_t word = view.parents_[i];
    if (i == 0 && word != 0) return reject(kRuleParent, 0);
    if (depth_of(word) > deepest_) deepest_ = depth_of(word);
    if (deepest_ >= kMaxDepth) return reject(kRuleDepth, i);
    for (uint32_t which = 0; which < 2; ++which) {
      const uint32_t child = node.side[which].child;
      if (!is_box(node.side[which].box)) return reject(kRuleNodeBox, i);
      if (is_leaf(child)) {
        const Verdict leaf = check_leaf(i, which);
        if (!leaf.ok()) return leaf;
        continue;
      }
      if (child <= i || child >= view.nodes_.size() ||
          view.parents_[child] != make_parent(i, which, depth_of(word) + 1))
        return reject(kRuleChild, i);
      if (!holds(node.side[which].box, view.nodes_[child]))
        return reject(kRuleBoxOutsideParent, child);
      ++children_;
    }
  }
  return kPassed;
}

// Pre: the leaf's corners are vertices within the grid.
Verdict Proof::check_leaf_box(uint32_t first, uint32_t count) const {
  const uint32_t* const words = view.leaf_boxes_ + size_t{kLeafBoxStride} * first;
  const bool is_there = count > 1;
  if (!is_there && !excludes_nothing(words)) return reject(kRuleLeafBoxWords, first);
  for (uint32_t i = is_there ? kLeafBoxWords : 2; i < kLeafBoxStride * count; ++i)
    if (words[i] != 0) return reject(kRuleLeafBoxWords, first);
  if (!is_there) return kPassed;
  const LeafBox box(words);
  if ((words[1] & 0xFFFFu) != 0xFFFFu) return reject(kRuleLeafBoxWords, first);
  if (!box.are_axes_sound()) return reject(kRuleLeafBoxAxes, first);
  const Head& head = *view.head_;
  const float per_cell = 1.0f / head.cell_m;
  const Vec3 low_m{head.grid_low_m[0], head.grid_low_m[1], head.grid_low_m[2]};
  const float error = view.box_frame_ != nullptr ? kTurnedErrorHalfCells : kErrorHalfCells;
  for (uint32_t n = 3 * first; n < 3 * (first + count); ++n)
    if (!box.holds((on_grid(view, n) - low_m) * per_cell, error))
      return reject(kRuleTriangleOutsideLeafBox, n / 3);
  return kPassed;
}

}  // namespace firmtouch::mesh

template class firmtouch::query::Opening<firmtouch::mesh::Proof>;
