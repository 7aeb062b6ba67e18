#include "firmtouch/hull/base_hull.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/hull/box_descent.hpp"
#include "firmtouch/hull/face_hash.hpp"

namespace firmtouch::hull {
namespace {

using core::kPassed;
using core::reject;
using core::Verdict;

// The rest of a block, read from its first byte on.
class Rest {
 public:
  explicit Rest(core::Bytes bytes) : bytes_(bytes) {}
  /// Empty, and no more whole, where there are too few.
  core::Bytes take(uint64_t bytes) {
    const uint64_t whole = (bytes + 3) & ~uint64_t{3};
    if (whole > bytes_.size()) {
      is_whole_ = false;
      return {};
    }
    const core::Bytes taken(bytes_.data(), static_cast<uint32_t>(bytes));
    bytes_ = {bytes_.data() + whole, bytes_.size() - static_cast<uint32_t>(whole)};
    return taken;
  }
  template <class T>
  core::Span<const T> take_array(uint64_t count) {
    const core::Bytes bytes = take(count * sizeof(T));
    return core::as_array<T>(bytes, static_cast<uint32_t>(bytes.size() / sizeof(T)));
  }
  bool is_whole() const { return is_whole_; }
  bool is_used_up() const { return is_whole_ && bytes_.empty(); }

 private:
  core::Bytes bytes_;
  bool is_whole_ = true;
};

}  // namespace

// Everything but what ties it to the hull. Result: false where the bytes do not hold it.
bool BaseHull::point_into(core::Bytes resident, uint32_t coordinate_bytes) {
  const core::Span<const BaseHullHead> heads = core::as_array<BaseHullHead>(resident, 1);
  if (heads.empty()) return false;
  head_ = &heads[0];
  coordinate_bytes_ = coordinate_bytes;
  const uint32_t leaves = leaves_for(head_->face_count, kLeafFaces);
  Rest rest(resident);
  (void)rest.take(sizeof(BaseHullHead));
  boxes_ = rest.take_array<NodeBox>(nodes_for(leaves));
  corner_offsets_ = rest.take_array<uint32_t>(corner_offsets_for(leaves));
  faces_ = rest.take_array<BaseHullFace>(head_->face_count);
  corners_ = rest.take_array<uint16_t>(head_->corner_count);
  coordinates_ = rest.take(uint64_t{head_->made_count} * 3 * coordinate_bytes);
  kept_ = rest.take_array<BaseHullVertex>(head_->kept_count);
  return rest.is_whole();
}

uint32_t BaseHull::resident_bytes() const {
  const uint8_t* end = reinterpret_cast<const uint8_t*>(kept_.data() + kept_.size());
  if (kept_.empty()) end = coordinates_.data() + padded(coordinates_.size());
  return static_cast<uint32_t>(end - reinterpret_cast<const uint8_t*>(head_));
}

BaseHull BaseHull::resident(core::Bytes copy) const {
  if (!is_open() || copy.size() < resident_bytes()) return {};
  const uint8_t* own = reinterpret_cast<const uint8_t*>(head_);
  for (uint32_t i = 0; i < resident_bytes(); ++i)
    if (copy[i] != own[i]) return {};
  BaseHull base_hull = *this;
  return base_hull.point_into(copy, coordinate_bytes_) ? base_hull : BaseHull{};
}

Verdict BaseHullProof::begin(core::Bytes bytes, const View& hull) {
  const core::Span<const BaseHullHead> heads = core::as_array<BaseHullHead>(bytes, 1);
  if (heads.empty() || heads[0].bytes != bytes.size()) return reject(kRuleBaseHullSize);
  const BaseHullHead& head = heads[0];
  const Head& of = hull.head();
  if (head.cut > of.collapse_count) return reject(kRuleBaseHullCounts, 0);
  if (head.face_count == 0 || head.face_count != of.mesh_triangle_count - 2 * head.cut)
    return reject(kRuleBaseHullCounts, 1);
  if (head.made_count > kMaxBaseHullVertices || head.kept_count > kMaxBaseHullVertices ||
      head.made_count + head.kept_count > kMaxBaseHullVertices)
    return reject(kRuleBaseHullCounts, 2);
  if (head.triangle_count > head.face_count) return reject(kRuleBaseHullCounts, 3);
  if (!base_hull_.point_into(bytes, of.coordinate_bytes)) return reject(kRuleBaseHullSize, 1);
  const uint32_t resident = base_hull_.resident_bytes();
  Rest rest({bytes.data() + resident, bytes.size() - resident});
  base_hull_.ids_ = rest.take(uint64_t{head.made_count} * of.id_bytes);
  base_hull_.triangles_ = rest.take_array<BaseHullTriangle>(head.triangle_count);
  if (!rest.is_used_up()) return reject(kRuleBaseHullSize, 1);
  base_hull_.id_bytes_ = of.id_bytes;
  for (uint32_t k = 0; k < 3; ++k) base_hull_.grid_low_m_[k] = of.grid_low_m[k];
  base_hull_.cell_m_ = of.cell_m;
  return kPassed;
}

Verdict BaseHullProof::check_head(const View& hull) const {
  const BaseHullHead& head = base_hull_.head();
  for (uint32_t k = 0; k < 3; ++k)
    if (!(head.low_m[k] >= hull.head().low_m[k] && head.low_m[k] <= head.high_m[k] &&
          head.high_m[k] <= hull.head().high_m[k]))
      return reject(kRuleBaseHullBox, k);
  return kPassed;
}

uint32_t BaseHullProof::vertex_count() const {
  return base_hull_.head_->made_count + base_hull_.head_->kept_count;
}

Verdict BaseHullProof::finish() const {
  const BaseHullHead& head = *base_hull_.head_;
  if (next_triangle_ != head.triangle_count) return reject(kRuleBaseHullTriangles, next_triangle_);
  if (next_corner_ != head.corner_count) return reject(kRuleBaseHullCorners, head.face_count);
  return edges_ == 0 ? kPassed : reject(kRuleBaseHullOpen);
}

Verdict BaseHullProof::check_vertex(uint32_t i, const View& hull) const {
  const uint32_t id = base_hull_.id_of(i), mesh_vertices = hull.head().mesh_vertex_count;
  if (id >= hull.id_count() || (removed_by(id) < base_hull_.head_->cut))
    return reject(kRuleBaseHullVertex, i);
  const uint32_t number = hull.number_of(id);
  if (base_hull_.is_made(i) != (number >= mesh_vertices) ||
      number >= mesh_vertices + base_hull_.head_->cut)
    return reject(kRuleBaseHullVertex, i);
  const math::Vec3 here_m = vertex(base_hull_, i), there_m = hull::vertex(hull, number);
  if (math::bits_of(here_m.x) != math::bits_of(there_m.x) ||
      math::bits_of(here_m.y) != math::bits_of(there_m.y) ||
      math::bits_of(here_m.z) != math::bits_of(there_m.z))
    return reject(kRuleBaseHullPosition, i);
  return kPassed;
}

// Its corners follow those of the leaf before, and all are there.
Verdict BaseHullProof::check_leaf(uint32_t leaf) {
  const uint32_t face = leaf * kLeafFaces, count = corners_of(base_hull_.faces_[face]);
  if (leaf % 2 == 0 && base_hull_.corner_offsets_[leaf / 2] != next_corner_)
    return reject(kRuleBaseHullCorners, face);
  if (count > kMaxLeafCorners || count > base_hull_.head_->corner_count - next_corner_)
    return reject(kRuleBaseHullCorners, face);
  next_corner_ += count;
  for (const uint16_t vertex : base_hull_.leaf(leaf).corners)
    if (vertex >= vertex_count()) return reject(kRuleBaseHullCorners, face);
  return kPassed;
}

Verdict BaseHullProof::check_face(uint32_t i, const View& hull) {
  if (i % kLeafFaces == 0) {
    const Verdict found = check_leaf(i / kLeafFaces);
    if (!found.ok()) return found;
  }
  const BaseHullFace face = base_hull_.faces_[i];
  const BaseHull::Leaf leaf = base_hull_.leaf(i / kLeafFaces);
  if (corners_of(face) != leaf.corners.size()) return reject(kRuleBaseHullCorners, i);
  HashedNumber corner[3];
  uint32_t number[3];
  bool is_triangle = true;
  for (uint32_t k = 0; k < 3; ++k) {
    if (corner_at(face, k) >= leaf.corners.size()) return reject(kRuleBaseHullCorners, i);
    const uint32_t vertex = leaf.corners[corner_at(face, k)];
    number[k] = hull.number_of(base_hull_.id_of(vertex));
    corner[k] = HashedNumber(number[k]);
    is_triangle = is_triangle && !base_hull_.is_made(vertex);
  }
  for (uint32_t k = 0; k < 3; ++k) {
    const HashedNumber &from = corner[k], &to = corner[k == 2 ? 0 : k + 1];
    edges_ += pair_hash(from, to) - pair_hash(to, from);
  }
  const Verdict boxed = check_box(i);
  if (!boxed.ok()) return boxed;
  if (!is_triangle) {
    faces_ += face_hash(corner[0], corner[1], corner[2]);
    return kPassed;
  }
  if (next_triangle_ == base_hull_.head_->triangle_count) return reject(kRuleBaseHullTriangles, i);
  const BaseHullTriangle& reported = base_hull_.triangles_[next_triangle_++];
  if (reported.face != i || reported.triangle >= hull.head().mesh_triangle_count ||
      !is_same_face(number, hull.triangle(reported.triangle).corner))
    return reject(kRuleBaseHullTriangles, i);
  faces_ += number_hash(reported.triangle);
  return kPassed;
}

Verdict BaseHullProof::check_box(uint32_t face) const {
  const FilledTree tree(base_hull_.boxes_.size());
  const Box whole = box_of(*base_hull_.head_);
  math::Extents seen;
  for (uint32_t k = 0; k < 3; ++k) {
    const math::Vec3 at_m = vertex(base_hull_, base_hull_.vertex_of(face, k));
    seen.take(at_m.x, at_m.y, at_m.z);
  }
  uint32_t node = tree.node(face / kLeafFaces) + 1;  // counted from 1, a node's parent is its half
  for (; node != 0; node /= 2) {
    const Box box = child_box(whole, base_hull_.boxes_[node - 1]);
    if (!holds(box, seen)) return reject(kRuleBaseHullLeafBox, face);
  }
  return kPassed;
}

Verdict open_base_hull(core::Bytes bytes, const View& hull, BaseHull& base_hull) {
  base_hull = {};
  BaseHullProof proof;
  Verdict found = proof.begin(bytes, hull);
  if (found.ok()) found = proof.check_head(hull);
  for (uint32_t i = 0; found.ok() && i < proof.vertex_count(); ++i)
    found = proof.check_vertex(i, hull);
  for (uint32_t i = 0; found.ok() && i < proof.face_count(); ++i) found = proof.check_face(i, hull);
  if (found.ok()) found = proof.finish();
  if (found.ok()) base_hull = proof.base_hull();
  return found;
}

}  // namespace firmtouch::hull
