#include "hull/collapse_mesh.hpp"

#include <algorithm>

#include "surface/edges.hpp"

namespace firmtouch::tools {
namespace {

uint32_t corner_of(const Face& face, uint32_t vertex) {
  return face[0] == vertex ? 0 : face[1] == vertex ? 1 : 2;
}

bool has(const Face& face, uint32_t vertex) {
  return face[0] == vertex || face[1] == vertex || face[2] == vertex;
}

void erase(std::vector<uint32_t>& items, uint32_t item) {
  items.erase(std::find(items.begin(), items.end(), item));
}

}  // namespace

Face Star::face(uint32_t i) const {
  const uint32_t count = static_cast<uint32_t>(link.size());
  if (i < count) return {i < split ? u : v, link[i], link[(i + 1) % count]};
  return i == count ? Face{u, v, link[0]} : Face{v, u, link[split]};
}

CollapseMesh::CollapseMesh(const Surface& surface)
    : vertices_(surface.vertices),
      faces_(surface.faces),
      faces_of_(surface.vertices.size()),
      edges_of_(surface.vertices.size()),
      face_count_(static_cast<uint32_t>(surface.faces.size())) {
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    for (const uint32_t vertex : faces_[f]) faces_of_[vertex].push_back(f);
  }
  const Edges edges(faces_);
  for (const Edges::Edge& edge : edges.all()) {
    const uint32_t number = edge_count();
    ends_.push_back({edge.low, edge.high});
    edges_of_[edge.low].push_back(number);
    edges_of_[edge.high].push_back(number);
  }
  is_edge_.assign(ends_.size(), true);
}

uint32_t CollapseMesh::crowd_of(uint32_t edge) const {
  return static_cast<uint32_t>(faces_of_[ends_[edge].a].size() + faces_of_[ends_[edge].b].size());
}

// The neighbours of `around` counter-clockwise, from the one after `other` to the one before it.
void CollapseMesh::chain(uint32_t around, uint32_t other, std::vector<uint32_t>& link) const {
  const std::vector<uint32_t>& faces = faces_of_[around];
  uint32_t at = other;
  for (size_t step = 0; step + 1 < faces.size(); ++step) {
    for (const uint32_t f : faces) {
      const uint32_t k = corner_of(faces_[f], around);
      if (faces_[f][(k + 1) % 3] != at) continue;
      at = faces_[f][(k + 2) % 3];
      break;
    }
    link.push_back(at);
  }
}

bool CollapseMesh::star_of(uint32_t edge, Star& star) const {
  star.u = ends_[edge].a;
  star.v = ends_[edge].b;
  star.link.clear();
  chain(star.u, star.v, star.link);
  star.split = static_cast<uint32_t>(star.link.size()) - 1;
  star.link.pop_back();  // the last of u's chain is the first of v's
  chain(star.v, star.u, star.link);
  star.link.pop_back();
  const uint32_t left = star.link[0], right = star.link[star.split];
  if (faces_of_[left].size() < 4 || faces_of_[right].size() < 4 || star.link.size() < 3)
    return false;
  for (size_t i = 0; i < star.link.size(); ++i) {
    for (size_t j = i + 1; j < star.link.size(); ++j) {
      if (star.link[i] == star.link[j]) return false;
    }
  }
  return true;
}

void CollapseMesh::take_over(uint32_t from, uint32_t other, uint32_t to) {
  for (const uint32_t f : faces_of_[from]) {
    if (has(faces_[f], other)) continue;
    faces_[f][corner_of(faces_[f], from)] = to;
    faces_of_[to].push_back(f);
  }
}

void CollapseMesh::take_over_edges(const Star& star, uint32_t to, std::vector<uint32_t>& gone) {
  for (const uint32_t from : {star.u, star.v}) {
    for (const uint32_t edge : edges_of_[from]) {
      if (!is_edge_[edge]) continue;
      const uint32_t other = other_end(edge, from);
      const bool is_double =
          from == star.v && (other == star.link[0] || other == star.link[star.split]);
      if (other == star.u || other == star.v || is_double) {
        is_edge_[edge] = false;
        gone.push_back(edge);
        if (is_double) erase(edges_of_[other], edge);
        continue;
      }
      ends_[edge] = {to, other};
      edges_of_[to].push_back(edge);
    }
  }
}

void CollapseMesh::collapse(const Star& star, math::Vec3 to_m, std::vector<uint32_t>& gone) {
  const uint32_t to = static_cast<uint32_t>(vertices_.size());
  vertices_.push_back(to_m);
  faces_of_.emplace_back();
  edges_of_.emplace_back();
  for (const uint32_t f : faces_of_[star.u]) {
    if (!has(faces_[f], star.v)) continue;
    for (const uint32_t opposite : {star.link[0], star.link[star.split]}) {
      if (has(faces_[f], opposite)) erase(faces_of_[opposite], f);
    }
  }
  take_over(star.u, star.v, to);
  take_over(star.v, star.u, to);
  take_over_edges(star, to, gone);
  for (const uint32_t from : {star.u, star.v}) {
    faces_of_[from] = {};
    edges_of_[from] = {};
  }
  face_count_ -= 2;
}

}  // namespace firmtouch::tools
