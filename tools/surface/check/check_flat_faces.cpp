#include <algorithm>

#include "surface/check/mending.hpp"
#include "surface/point.hpp"

// A face without area has no normal, and dropping it would leave a crack. Two cases, after Botsch
// et al. 2010, "Polygon Mesh Processing", section 8: a needle (two corners at one place) goes by
// collapsing that edge, a cap (the middle corner on the longest edge) by flipping the longest edge:
// neither moves the surface.

namespace firmtouch::tools {
namespace {

// |cross product| over the longest edge squared. Float coordinates give exactly 0 for collinear
// corners; rounding in double adds less than this.
constexpr double kFlat = 4e-16;

bool is_flat_in(const Surface& surface, uint32_t f) {
  const auto at = [&](uint32_t k) { return to_point(surface.vertices[surface.faces[f][k]]); };
  const Point a = at(0), ab = at(1) - a, ac = at(2) - a, bc = at(2) - at(1);
  const double longest2 = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
  return !(length(cross(ab, ac)) > kFlat * longest2);
}

class FlatFaces {
 public:
  explicit FlatFaces(Surface& surface) : surface_(surface), around_(surface.vertices.size()) {
    for (uint32_t f = 0; f < surface_.faces.size(); ++f) {
      for (const uint32_t v : surface_.faces[f]) around_[v].push_back(f);
    }
    dropped_.assign(surface_.faces.size(), false);
  }

  bool is_flat(uint32_t f) const { return is_flat_in(surface_, f); }

  // Result: whether the face went.
  bool mend(uint32_t f) {
    const Face face = surface_.faces[f];
    for (uint32_t k = 0; k < 3; ++k) {
      const Point edge = at(f, (k + 1) % 3) - at(f, k);
      if (!(dot(edge, edge) > 0)) return collapse(face[k], face[(k + 1) % 3]);
    }
    uint32_t longest = 0, shortest = 0;
    double most = 0, least = 0;
    for (uint32_t k = 0; k < 3; ++k) {
      const Point edge = at(f, (k + 1) % 3) - at(f, k);
      const double size2 = dot(edge, edge);
      if (k == 0 || size2 > most) most = size2, longest = k;
      if (k == 0 || size2 < least) least = size2, shortest = k;
    }
    return flip(f, longest) || collapse(face[shortest], face[(shortest + 1) % 3]);
  }

  void drop(uint32_t f) {
    dropped_[f] = true;
    for (const uint32_t v : surface_.faces[f]) forget(v, f);
  }
  bool is_dropped(uint32_t f) const { return dropped_[f]; }
  const std::vector<bool>& dropped() const { return dropped_; }
  /// Faces changed since the last call.
  std::vector<uint32_t> take_changed() { return std::move(changed_); }
  uint32_t flips = 0, collapses = 0;

 private:
  Point at(uint32_t f, uint32_t k) const {
    return to_point(surface_.vertices[surface_.faces[f][k]]);
  }

  bool has(uint32_t f, uint32_t v) const {
    const Face& face = surface_.faces[f];
    return face[0] == v || face[1] == v || face[2] == v;
  }

  void forget(uint32_t v, uint32_t f) {
    std::vector<uint32_t>& list = around_[v];
    list.erase(std::remove(list.begin(), list.end(), f), list.end());
  }

  std::vector<uint32_t> faces_with(uint32_t a, uint32_t b) const {
    std::vector<uint32_t> faces;
    for (const uint32_t f : around_[a]) {
      if (has(f, b)) faces.push_back(f);
    }
    return faces;
  }

  bool has_face(uint32_t a, uint32_t b, uint32_t c) const {
    return std::any_of(around_[a].begin(), around_[a].end(),
                       [&](uint32_t f) { return has(f, b) && has(f, c); });
  }

  std::vector<uint32_t> neighbours(uint32_t v) const {
    std::vector<uint32_t> list;
    for (const uint32_t f : around_[v]) {
      for (const uint32_t w : surface_.faces[f]) {
        if (w != v) list.push_back(w);
      }
    }
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
  }

  // Faces (a, b, c) and (c, a, d)... with the longest edge c-a become (a, b, d) and (d, b, c).
  bool flip(uint32_t f, uint32_t longest) {
    const Face face = surface_.faces[f];
    const uint32_t c = face[longest], a = face[(longest + 1) % 3], b = face[(longest + 2) % 3];
    const std::vector<uint32_t> sides = faces_with(a, c);
    if (sides.size() != 2) return false;
    const uint32_t g = sides[0] == f ? sides[1] : sides[0];
    uint32_t d = kNone;
    for (uint32_t k = 0; k < 3; ++k) {
      if (surface_.faces[g][k] == a && surface_.faces[g][(k + 1) % 3] == c)
        d = surface_.faces[g][(k + 2) % 3];
    }
    if (d == kNone || d == b || !faces_with(b, d).empty()) return false;
    surface_.take_material(f, g);
    surface_.faces[f] = {a, b, d};
    surface_.faces[g] = {d, b, c};
    forget(c, f);
    forget(a, g);
    around_[d].push_back(f);
    around_[b].push_back(g);
    changed_.push_back(f);
    changed_.push_back(g);
    ++flips;
    return true;
  }

  // Vertex `from` goes, its faces take `to`, if the surface stays a closed manifold (the link
  // condition: what both vertices share are the two faces between them and nothing else).
  bool collapse(uint32_t u, uint32_t v) {
    const uint32_t to = std::min(u, v), from = std::max(u, v);
    const std::vector<uint32_t> between = faces_with(to, from);
    if (between.size() != 2) return false;
    const std::vector<uint32_t> n_to = neighbours(to), n_from = neighbours(from);
    std::vector<uint32_t> shared;
    std::set_intersection(n_to.begin(), n_to.end(), n_from.begin(), n_from.end(),
                          std::back_inserter(shared));
    if (shared.size() != 2) return false;
    // A face across both on either side would leave two faces on the same three corners.
    if (has_face(to, shared[0], shared[1]) && has_face(from, shared[0], shared[1])) return false;
    for (const uint32_t f : between) drop(f);
    const std::vector<uint32_t> moved = around_[from];
    for (const uint32_t f : moved) {
      for (uint32_t& w : surface_.faces[f]) {
        if (w == from) w = to;
      }
      around_[to].push_back(f);
      changed_.push_back(f);
    }
    around_[from].clear();
    ++collapses;
    return true;
  }

  Surface& surface_;
  std::vector<std::vector<uint32_t>> around_;  // of each vertex: its faces
  std::vector<bool> dropped_;
  std::vector<uint32_t> changed_;
};

bool any_flat(const Surface& surface) {
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    if (is_flat_in(surface, f)) return true;
  }
  return false;
}

}  // namespace

void remove_flat_faces(Surface& surface, const CheckOptions& options, CheckReport& report) {
  if (!any_flat(surface)) return;
  FlatFaces flat(surface);
  const Surface before = surface;
  std::vector<uint32_t> queue, left;
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    if (flat.is_flat(f)) queue.push_back(f);
  }
  const uint32_t found = static_cast<uint32_t>(queue.size()), first = queue[0];
  const size_t limit =
      16 * queue.size() + 64;  // a flip may make another flat face, but only so often
  for (size_t at = 0; at < queue.size(); ++at) {
    const uint32_t f = queue[at];
    if (flat.is_dropped(f) || !flat.is_flat(f)) continue;
    if (at >= limit || !flat.mend(f)) {
      left.push_back(f);
      continue;
    }
    for (const uint32_t changed : flat.take_changed()) {
      if (!flat.is_dropped(changed) && flat.is_flat(changed)) queue.push_back(changed);
    }
  }
  uint32_t still = 0, first_still = kNone;
  for (const uint32_t f : left) {
    if (flat.is_dropped(f) || !flat.is_flat(f)) continue;
    ++still;
    first_still = std::min(first_still, f);
    if (options.allow_unsigned)
      flat.drop(f);  // it covers nothing that its neighbours' edges do not
  }
  if (still != 0 && !options.allow_unsigned) {
    report.refused.push_back("has " + counted(still, "face", "faces") +
                             " without area that cannot be removed without a crack, first " +
                             named_face(before, first_still) +
                             ": remove degenerate faces in a modelling program");
  }
  if (found > still || options.allow_unsigned) {
    report.mended.push_back("removed " + counted(found, "face", "faces") + " without area, first " +
                            named_face(before, first) + ", by " +
                            counted(flat.flips, "flip", "flips") + " and " +
                            counted(flat.collapses, "collapse", "collapses") +
                            (still != 0 ? ", " + std::to_string(still) + " by dropping" : ""));
  }
  drop_faces(surface, flat.dropped());
}

}  // namespace firmtouch::tools
