#include "bake/mesh/refine.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <unordered_set>
#include <vector>

#include "bake/mesh/box_frame.hpp"
#include "bake/mesh/flat_regions.hpp"
#include "bake/mesh/sign_proof.hpp"
#include "bake/mesh/turn_slivers.hpp"
#include "firmtouch/mesh/layout.hpp"
#include "surface/edges.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

// Boxes that are smaller by less than this part are as good either way: nearly equal choices must
// not be flipped to and fro.
constexpr double kMinGain = 1e-6;
// A fan of n triangles over a rim of n more takes n^2 / 4 flips: this bounds the time.
constexpr uint32_t kMaxFlipsPerFace = 32;
constexpr size_t kNarrow = 65536;  // vertices
// Longest edge of a refined surface, in diagonals, unless the growth ends it first.
constexpr double kRefinedEdge = 0.05;
// Surfaces of fewer faces, and those of shorter edges, stay as they are. From such edges on,
// float32 alone does not keep the promised error (mesh/loss.hpp).
constexpr uint32_t kMinRefinedFaces = 256;
constexpr double kLongEdge = 0.08;

class Refiner {
 public:
  Refiner(Surface& surface, double max_move_m, double max_growth, const Frame& boxes)
      : surface_(surface),
        boxes_(boxes),
        margin_m_(kBoxMargin * diagonal_m(surface.vertices)),
        faces_(surface.faces),
        mates_(Edges(surface.faces).mates()),
        moved_m_(faces_.size(), 0.0),
        max_move_m_(max_move_m),
        min_height_m_(confusion_m(surface)),
        max_faces_(std::min(static_cast<size_t>(max_growth * static_cast<double>(faces_.size())),
                            size_t{mesh::kMaxTriangles})),
        // Where indices have 16 bits they keep them.
        max_vertices_(surface.vertices.size() <= kNarrow ? kNarrow : SIZE_MAX) {
    surface_.source.resize(std::min(surface_.source.size(), faces_.size()));
    for (size_t f = surface_.source.size(); f < faces_.size(); ++f)
      surface_.source.push_back(static_cast<uint32_t>(f));
    for (const math::Vec3& v : surface.vertices) framed_.push_back(along(boxes_, to_point(v)));
    for (uint32_t h = 0; h < mates_.size(); ++h) {
      if (mates_[h] != kNone && start_of(faces_, h) == start_of(faces_, mates_[h]))
        mates_[h] = kNone;
      edges_.insert(key(start_of(faces_, h), end_of(faces_, h)));
    }
    regions_ = flat_regions(surface, mates_, max_move_m);
  }

  // First to the shorter diagonals, which takes fans apart, then to the smaller boxes.
  void flip_all() {
    flip_each(true);
    flip_each(false);
  }
  // Last: among splits it makes worse triangles.
  void flip_by_reach() {
    is_by_reach_ = true;
    flip_each(false);
  }
  void flip_each(bool is_by_length) {
    is_by_length_ = is_by_length;
    for (uint32_t h = 0; h < mates_.size(); ++h) touched_.push_back(h);
    flip_touched();
  }

  // Result: the longest edge that is left, except for those that must stay.
  double split_longer_than(double length_m) {
    for (uint32_t h = 0; h < mates_.size(); ++h) push(h);
    while (!longest_.empty() && faces_.size() + 2 <= max_faces_ &&
           surface_.vertices.size() < max_vertices_) {
      const Entry entry = longest_.top();
      if (entry.length2_m2 <= length_m * length_m) break;
      longest_.pop();
      // Flipped or split since.
      if (mates_[entry.half] == kNone || entry.length2_m2 > length2(entry.half) ||
          entry.length2_m2 < length2(entry.half))
        continue;
      split(entry.half);
      flip_touched();
    }
    return longest_.empty() ? 0 : std::sqrt(longest_.top().length2_m2);
  }

  Refined result() const {
    Refined refined = refined_;
    for (uint32_t f = 0; f < faces_.size(); ++f)
      refined.moved_m = std::max(refined.moved_m, moved_m_[f] + thickness_m(f));
    return refined;
  }

 private:
  struct Entry {
    double length2_m2;
    uint32_t half;
    bool operator<(const Entry& other) const {
      return length2_m2 < other.length2_m2 ||
             (!(other.length2_m2 < length2_m2) && half > other.half);
    }
  };

  static uint64_t key(uint32_t a, uint32_t b) {
    return uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }
  Point at(uint32_t vertex) const { return to_point(surface_.vertices[vertex]); }
  double length2(uint32_t half) const {
    const Point edge = at(end_of(faces_, half)) - at(start_of(faces_, half));
    return dot(edge, edge);
  }
  void push(uint32_t half) {
    if (mates_[half] != kNone && half < mates_[half]) longest_.push({length2(half), half});
  }
  void join(uint32_t half, uint32_t mate) {
    mates_[half] = mate;
    if (mate != kNone) mates_[mate] = half;
  }
  // Of a changed face.
  void touch(uint32_t face) {
    for (uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
      touched_.push_back(h);
      if (mates_[h] != kNone) push(std::min(h, mates_[h]));
    }
  }

  double thickness_m(uint32_t face) const {
    const uint32_t region = regions_.of_face[face];
    return region == kNone ? 0 : regions_.thickness_m[region];
  }

  // The two faces about an edge a b: a b c and b a d.
  struct Pair {
    uint32_t half, bc, ca, mate, ad, db;  // half-edges
    uint32_t a, b, c, d;                  // corners
  };
  Pair about(uint32_t half) const {
    Pair p{};
    p.half = half, p.bc = next_half(half), p.ca = next_half(p.bc);
    p.mate = mates_[half], p.ad = next_half(p.mate), p.db = next_half(p.ad);
    p.a = start_of(faces_, half), p.b = start_of(faces_, p.bc), p.c = start_of(faces_, p.ca);
    p.d = start_of(faces_, p.db);
    return p;
  }

  // How far the points of a triangle lie, on average and by area, from where its longest edge
  // begins: what float32 loses of a distance grows with it (mesh/loss.hpp, own_m()).
  static double reach(Point a, Point b, Point c) {
    const double ab = length(b - a), bc = length(c - b), ca = length(a - c);
    const Point from = ab >= bc && ab >= ca ? a : bc >= ca ? b : c;
    return length(cross(b - a, c - a)) * length((a + b + c) * (1.0 / 3) - from);
  }

  // Whether the other diagonal has the smaller boxes; of equal ones, the smaller reach.
  bool is_worth_flipping(const Pair& p) const {
    const Point a = framed_[p.a], b = framed_[p.b], c = framed_[p.c], d = framed_[p.d];
    if (is_by_length_) return length(d - c) < length(b - a) * (1 - kMinGain);
    const auto area = [this](Point u, Point v, Point w) {
      return half_box_area(u, v, w, margin_m_);
    };
    const double before = area(a, b, c) + area(a, b, d), after = area(c, d, a) + area(c, d, b);
    if (after < before * (1 - kMinGain)) return true;
    return is_by_reach_ && after <= before * (1 + kMinGain) &&
           reach(a, d, c) + reach(d, b, c) < (reach(a, b, c) + reach(b, a, d)) * 0.9;
  }

  void flip(const Pair& p) {
    const uint32_t f = p.half / 3, g = p.mate / 3;
    if (p.c == p.d || edges_.count(key(p.c, p.d)) != 0) return;
    if (surface_.material_of(f) != surface_.material_of(g)) return;
    if (!is_worth_flipping(p)) return;
    const Point a = at(p.a), b = at(p.b), c = at(p.c), d = at(p.d);
    const double by_flip_m = moved_by_flip_m(a, b, c, d) * (1 + 0x1p-20);
    if (!(by_flip_m <= max_move_m_)) return;
    const bool is_flat = regions_.of_face[f] != kNone && regions_.of_face[f] == regions_.of_face[g];
    const double moved_m = std::max(moved_m_[f], moved_m_[g]) + (is_flat ? 0 : by_flip_m);
    if (!(moved_m + std::max(thickness_m(f), thickness_m(g)) <= max_move_m_)) return;
    if (!(height_m(a, d, c) > min_height_m_ && height_m(d, b, c) > min_height_m_)) return;
    const uint32_t bc = mates_[p.bc], ca = mates_[p.ca], ad = mates_[p.ad], db = mates_[p.db];
    edges_.erase(key(p.a, p.b));
    edges_.insert(key(p.c, p.d));
    faces_[f] = {p.a, p.d, p.c};
    faces_[g] = {p.d, p.b, p.c};
    join(3 * f, ad);
    join(3 * f + 1, 3 * g + 2);
    join(3 * f + 2, ca);
    join(3 * g, db);
    join(3 * g + 1, bc);
    moved_m_[f] = moved_m_[g] = moved_m;
    ++refined_.flips;
    touch(f);
    touch(g);
  }

  void flip_touched() {
    const uint64_t most = uint64_t{kMaxFlipsPerFace} * max_faces_;
    while (!touched_.empty()) {
      const uint32_t half = touched_.back();
      touched_.pop_back();
      if (mates_[half] != kNone && refined_.flips < most) flip(about(half));
    }
  }

  // The point that float32 moves off the edge the least, of some near its middle.
  static math::Vec3 middle_of(Point a, Point b, double& off_m) {
    const Point edge = b - a;
    math::Vec3 best{};
    off_m = HUGE_VAL;
    for (int k = 0; k <= 16; ++k) {
      const math::Vec3 stored = to_vec3(a + edge * (0.5 + 0x1p-7 * (k - 8)));
      const double off = length(cross(to_point(stored) - a, edge)) / length(edge);
      if (off < off_m) off_m = off, best = stored;
    }
    off_m *= 1 + 0x1p-20;
    return best;
  }

  void split(uint32_t half) {
    const Pair p = about(half);
    double off_m = 0;
    const math::Vec3 middle_m = middle_of(at(p.a), at(p.b), off_m);
    const uint32_t f = half / 3, g = p.mate / 3;
    if (!(std::max(moved_m_[f] + thickness_m(f), moved_m_[g] + thickness_m(g)) + off_m <=
          max_move_m_))
      return;
    const double least_m = 2 * min_height_m_;  // halved at most
    if (p.c == p.d) return;
    if (!(height_m(at(p.a), at(p.b), at(p.c)) > least_m)) return;
    if (!(height_m(at(p.b), at(p.a), at(p.d)) > least_m)) return;
    const auto m = static_cast<uint32_t>(surface_.vertices.size());
    surface_.vertices.push_back(middle_m);
    framed_.push_back(along(boxes_, to_point(middle_m)));
    const uint32_t new_f = add_face(f, off_m), new_g = add_face(g, off_m);
    const uint32_t bc = mates_[p.bc], ca = mates_[p.ca], ad = mates_[p.ad], db = mates_[p.db];
    faces_[f] = {p.a, m, p.c};
    faces_[new_f] = {m, p.b, p.c};
    faces_[g] = {p.b, m, p.d};
    faces_[new_g] = {m, p.a, p.d};
    join(3 * f, 3 * new_g);
    join(3 * f + 1, 3 * new_f + 2);
    join(3 * f + 2, ca);
    join(3 * new_f, 3 * g);
    join(3 * new_f + 1, bc);
    join(3 * g + 1, 3 * new_g + 2);
    join(3 * g + 2, db);
    join(3 * new_g + 1, ad);
    edges_.erase(key(p.a, p.b));
    for (const uint32_t v : {p.a, p.b, p.c, p.d}) edges_.insert(key(m, v));
    ++refined_.splits;
    for (const uint32_t face : {f, new_f, g, new_g}) touch(face);
  }
  // Adds the other half of `face`, whose points are `off_m` farther off than they were.
  uint32_t add_face(uint32_t face, double off_m) {
    const auto added = static_cast<uint32_t>(faces_.size());
    moved_m_[face] += off_m;
    moved_m_.push_back(moved_m_[face]);
    regions_.of_face.push_back(regions_.of_face[face]);
    surface_.source.push_back(surface_.source[face]);
    faces_.push_back({});
    mates_.resize(mates_.size() + 3, kNone);
    return added;
  }

  Surface& surface_;
  Frame boxes_;
  double margin_m_;
  bool is_by_length_ = false, is_by_reach_ = false;
  std::vector<Point> framed_;  // the vertices along the axes of the boxes
  std::vector<Face>& faces_;
  std::vector<uint32_t> mates_;
  std::unordered_set<uint64_t> edges_;
  FlatRegions regions_;
  // Of each face: how far its points may be from the surface given, beyond its region's thickness.
  std::vector<double> moved_m_;
  double max_move_m_, min_height_m_;
  size_t max_faces_, max_vertices_;
  std::vector<uint32_t> touched_;
  std::priority_queue<Entry> longest_;
  Refined refined_;
};

}  // namespace

bool has_long_edges(const Surface& surface) {
  return surface.faces.size() >= kMinRefinedFaces &&
         longest_edge_m(surface) >= kLongEdge * diagonal_m(surface.vertices);
}

Refined refine(Surface& surface, double max_move_m, double max_growth, const Frame& boxes) {
  if (!has_long_edges(surface)) return {};
  const double longest_m = longest_edge_m(surface), all_m = diagonal_m(surface.vertices);
  const Surface given = surface;
  Refiner refiner(surface, max_move_m, max_growth, boxes);
  refiner.flip_all();
  const double left_m = refiner.split_longer_than(kRefinedEdge * all_m);
  if (left_m <= longest_m / 2) {
    refiner.flip_by_reach();
    return refiner.result();
  }
  surface = given;
  Refiner flipper(surface, max_move_m, max_growth, boxes);
  flipper.flip_all();
  flipper.flip_by_reach();
  return flipper.result();
}

}  // namespace firmtouch::tools
