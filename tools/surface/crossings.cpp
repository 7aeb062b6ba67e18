#include "surface/crossings.hpp"

#include <algorithm>

#include "surface/edges.hpp"
#include "surface/near_faces.hpp"
#include "surface/point.hpp"
#include "surface/winding_number.hpp"

namespace firmtouch::tools {
namespace {

// Six times the volume of a, b, c, d; 0 where rounding leaves the sign open.
// Source: Shewchuk 1997, "Adaptive precision floating-point arithmetic", section 4.4, error bound
//         of orient3d.
double side_of_plane(Point a, Point b, Point c, Point d) {
  const Point p = a - d, q = b - d, r = c - d;
  const double value =
      p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) + p.z * (q.x * r.y - q.y * r.x);
  const double size = std::fabs(p.x) * (std::fabs(q.y * r.z) + std::fabs(q.z * r.y)) +
                      std::fabs(p.y) * (std::fabs(q.z * r.x) + std::fabs(q.x * r.z)) +
                      std::fabs(p.z) * (std::fabs(q.x * r.y) + std::fabs(q.y * r.x));
  return std::fabs(value) > 8e-16 * size ? value : 0;
}

// Faces on a common edge cannot pass through each other; those at a common vertex can, where the
// surface folds over there.
bool share_an_edge(const Face& a, const Face& b) {
  uint32_t shared = 0;
  for (const uint32_t v : a) shared += v == b[0] || v == b[1] || v == b[2] ? 1u : 0u;
  return shared >= 2;
}

enum class Pierced { kNot, kOnBorder, kInside };

// The geometry of one surface.
class Search {
 public:
  explicit Search(const Surface& surface) : surface_(surface) {
    for (const math::Vec3& v : surface.vertices) at_.push_back(to_point(v));
  }

  /// All pairs that cross or, where an edge meets an edge, may only touch: those are not `is_sure`.
  void find_pairs(Crossings& found, std::vector<bool>& is_sure) const {
    const NearFaces near_faces(surface_);
    std::vector<uint32_t> near;
    std::vector<std::pair<uint32_t, Pierced>> met;
    for (uint32_t f = 0; f < surface_.faces.size(); ++f) {
      met.clear();
      near_faces.above(f, near);
      for (const uint32_t g : near) {
        if (share_an_edge(surface_.faces[f], surface_.faces[g])) continue;
        const Pierced how = meet(surface_.faces[f], surface_.faces[g]);
        if (how != Pierced::kNot) met.push_back({g, how});
      }
      std::sort(met.begin(), met.end());
      for (const auto& [g, how] : met) {
        if (found.pairs.size() == kMaxCrossings) {
          found.has_more_pairs = true;
          return;
        }
        found.pairs.push_back({f, g});
        is_sure.push_back(how == Pierced::kInside);
      }
    }
  }

  // How the edge from a to b passes through the face.
  Pierced pierced(uint32_t a, uint32_t b, const Face& face) const {
    return pierced(a, b, face, side(face, a), side(face, b));
  }
  Pierced pierced(uint32_t a, uint32_t b, const Face& face, double above, double below) const {
    if (!((above > 0 && below < 0) || (above < 0 && below > 0))) return Pierced::kNot;
    const Point p = at_[a], q = at_[b], u = at_[face[0]], v = at_[face[1]], w = at_[face[2]];
    const double s = side_of_plane(p, q, u, v), t = side_of_plane(p, q, v, w),
                 r = side_of_plane(p, q, w, u);
    if ((s > 0 && t > 0 && r > 0) || (s < 0 && t < 0 && r < 0)) return Pierced::kInside;
    return (s >= 0 && t >= 0 && r >= 0) || (s <= 0 && t <= 0 && r <= 0) ? Pierced::kOnBorder
                                                                        : Pierced::kNot;
  }

  // Whether the surface lies as often around this corner as its winding says: 1 just under the
  // face, 0 just above it.
  bool corner_is_wrong(const WindingNumber& winding, uint32_t f, uint32_t k) const {
    const Face& face = surface_.faces[f];
    const Point a = at_[face[0]], b = at_[face[1]], c = at_[face[2]];
    const Point normal = cross(b - a, c - a);
    const double shortest =
        std::sqrt(std::min({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)}));
    const double size = length(normal);
    if (!(size > 0)) return false;
    const Point corner = at_[face[k]];
    const Point spot = corner + ((a + b + c) * (1.0 / 3) - corner) * kIntoFace;
    const Point lift = normal * (kLift * shortest / size);
    return winding.at(spot + lift) != 0 || winding.at(spot - lift) != 1;
  }

 private:
  static constexpr double kIntoFace = 1e-3;  // of the way to the centroid
  static constexpr double kLift =
      1e-7;  // of the shortest edge: far above rounding, far below the next sheet

  double side(const Face& face, uint32_t v) const {
    return side_of_plane(at_[face[0]], at_[face[1]], at_[face[2]], at_[v]);
  }

  Pierced meet(const Face& a, const Face& b) const {
    const double s[3] = {side(b, a[0]), side(b, a[1]), side(b, a[2])};
    const double t[3] = {side(a, b[0]), side(a, b[1]), side(a, b[2])};
    Pierced how = Pierced::kNot;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t next = (k + 1) % 3;
      how = std::max({how, pierced(a[k], a[next], b, s[k], s[next]),
                      pierced(b[k], b[next], a, t[k], t[next])});
    }
    return how;
  }

  const Surface& surface_;
  std::vector<Point> at_;
};

// Faces around each vertex, one list after another.
struct Stars {
  std::vector<uint32_t> start, face;
  explicit Stars(const Surface& surface)
      : start(surface.vertices.size() + 1, 0), face(surface.faces.size() * 3) {
    for (const Face& f : surface.faces) {
      for (const uint32_t v : f) ++start[v + 1];
    }
    for (size_t v = 0; v + 1 < start.size(); ++v) start[v + 1] += start[v];
    std::vector<uint32_t> at(start.begin(), start.end() - 1);
    for (uint32_t f = 0; f < surface.faces.size(); ++f) {
      for (const uint32_t v : surface.faces[f]) face[at[v]++] = f;
    }
  }
};

struct Wrong {
  std::vector<bool> vertex;
  std::vector<uint32_t> faces;
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  void add_edge(uint32_t a, uint32_t b) { edges.push_back({std::min(a, b), std::max(a, b)}); }
};

template <class T>
void put_in_order(std::vector<T>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

// From the crossing faces outwards: where a corner of a face at a vertex is wrong, so are the
// vertex, the face and its two edges there, and the other faces of that vertex are looked at next.
void spread(const Surface& surface, const Search& search, const Crossings& found, Wrong& wrong) {
  const WindingNumber winding(surface, {});
  const Stars stars(surface);
  std::vector<bool> is_queued(surface.vertices.size(), false);
  std::vector<uint32_t> queue;
  const auto enqueue = [&](uint32_t f) {
    for (const uint32_t v : surface.faces[f]) {
      if (!is_queued[v]) queue.push_back(v);
      is_queued[v] = true;
    }
  };
  for (const auto& [f, g] : found.pairs) enqueue(f), enqueue(g);
  for (size_t i = 0; i < queue.size(); ++i) {
    const uint32_t v = queue[i];
    for (uint32_t s = stars.start[v]; s < stars.start[v + 1]; ++s) {
      const uint32_t f = stars.face[s];
      const Face& face = surface.faces[f];
      const uint32_t k = v == face[0] ? 0 : v == face[1] ? 1 : 2;
      if (!search.corner_is_wrong(winding, f, k)) continue;
      wrong.vertex[v] = true;
      wrong.faces.push_back(f);
      wrong.add_edge(v, face[(k + 1) % 3]);
      wrong.add_edge(v, face[(k + 2) % 3]);
      enqueue(f);
    }
  }
}

// Pairs that meet at their edges cross where a vertex of theirs is wrong, else they only touch and
// go.
void drop_touching(const Surface& surface, const std::vector<bool>& is_sure, const Wrong& wrong,
                   Crossings& found) {
  const auto is_wrong = [&](uint32_t f) {
    const Face& face = surface.faces[f];
    return wrong.vertex[face[0]] || wrong.vertex[face[1]] || wrong.vertex[face[2]];
  };
  size_t to = 0;
  for (size_t i = 0; i < found.pairs.size(); ++i) {
    if (is_sure[i] || is_wrong(found.pairs[i].first) || is_wrong(found.pairs[i].second))
      found.pairs[to++] = found.pairs[i];
  }
  found.pairs.resize(to);
}

void add_crossing_features(const Surface& surface, const Search& search, const Crossings& found,
                           Wrong& wrong) {
  for (const auto& [f, g] : found.pairs) {
    wrong.faces.insert(wrong.faces.end(), {f, g});
    const Face &a = surface.faces[f], &b = surface.faces[g];
    for (uint32_t k = 0; k < 3; ++k) {
      if (search.pierced(a[k], a[(k + 1) % 3], b) != Pierced::kNot)
        wrong.add_edge(a[k], a[(k + 1) % 3]);
      if (search.pierced(b[k], b[(k + 1) % 3], a) != Pierced::kNot)
        wrong.add_edge(b[k], b[(k + 1) % 3]);
    }
  }
  put_in_order(wrong.faces);
  put_in_order(wrong.edges);
}

std::string some(const std::vector<uint32_t>& indices, const std::vector<uint32_t>& source) {
  constexpr size_t kShown = 40;
  std::string text;
  for (size_t i = 0; i < indices.size() && i < kShown; ++i) {
    text += (i == 0 ? "" : ", ") +
            std::to_string(indices[i] < source.size() ? source[indices[i]] : indices[i]);
  }
  if (indices.size() > kShown) text += " and " + std::to_string(indices.size() - kShown) + " more";
  return indices.empty() ? "none" : text;
}

}  // namespace

Crossings find_crossings(const Surface& surface) {
  Crossings found;
  if (surface.faces.empty()) return found;
  const Search search(surface);
  std::vector<bool> is_sure;
  search.find_pairs(found, is_sure);
  if (found.pairs.empty()) return found;
  Wrong wrong{std::vector<bool>(surface.vertices.size(), false), {}, {}};
  spread(surface, search, found, wrong);
  drop_touching(surface, is_sure, wrong, found);
  add_crossing_features(surface, search, found, wrong);

  Sets sets(surface.vertices.size());
  for (const uint32_t f : wrong.faces) {
    sets.join(surface.faces[f][0], surface.faces[f][1]);
    sets.join(surface.faces[f][0], surface.faces[f][2]);
  }
  for (const auto& [f, g] : found.pairs) sets.join(surface.faces[f][0], surface.faces[g][0]);
  std::vector<uint32_t> place_of(surface.vertices.size(), kNone);
  for (const uint32_t f : wrong.faces) {
    uint32_t& place = place_of[sets.find(surface.faces[f][0])];
    if (place == kNone) {
      place = static_cast<uint32_t>(found.places.size());
      found.places.push_back({});
    }
    found.places[place].faces.push_back(f);
  }
  for (uint32_t v = 0; v < wrong.vertex.size(); ++v) {
    if (wrong.vertex[v]) found.places[place_of[sets.find(v)]].vertices.push_back(v);
  }
  for (const auto& edge : wrong.edges)
    found.places[place_of[sets.find(edge.first)]].edges.push_back(edge);
  return found;
}

std::vector<std::string> describe(const Crossings& crossings, const Surface& surface,
                                  const std::vector<uint32_t>& vertex_source) {
  std::vector<std::string> lines;
  if (crossings.pairs.empty()) return lines;
  lines.push_back("crosses itself in " + std::to_string(crossings.pairs.size()) +
                  (crossings.has_more_pairs ? " and more" : "") + " pairs of faces, first faces " +
                  some({crossings.pairs[0].first}, surface.source) + " and " +
                  some({crossings.pairs[0].second}, surface.source));
  for (size_t p = 0; p < crossings.places.size(); ++p) {
    const Crossings::Place& place = crossings.places[p];
    std::string line =
        "place " + std::to_string(p + 1) + " of " + std::to_string(crossings.places.size()) +
        ": the sign may be either one near vertices " + some(place.vertices, vertex_source) +
        "; faces " + some(place.faces, surface.source) + "; edges ";
    for (size_t e = 0; e < place.edges.size() && e < 40; ++e) {
      line += (e == 0 ? "" : ", ") + some({place.edges[e].first}, vertex_source) + "-" +
              some({place.edges[e].second}, vertex_source);
    }
    lines.push_back(line + (place.edges.size() > 40
                                ? " and " + std::to_string(place.edges.size() - 40) + " more"
                                : ""));
  }
  return lines;
}

}  // namespace firmtouch::tools
