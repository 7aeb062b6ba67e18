#pragma once
#include <cstdint>
#include <vector>

#include "surface/surface.hpp"

namespace firmtouch::tools {

constexpr uint32_t kNone = 0xFFFFFFFFu;

// Half-edge h = 3 * face + k runs from corner k of the face to corner k + 1.
constexpr uint32_t next_half(uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline uint32_t start_of(const std::vector<Face>& faces, uint32_t h) { return faces[h / 3][h % 3]; }
inline uint32_t end_of(const std::vector<Face>& faces, uint32_t h) {
  return start_of(faces, next_half(h));
}

/// Of the edges of all faces. Pre of the mean: there is a face.
double mean_edge_m(const Surface& surface);
double longest_edge_m(const Surface& surface);

/// The edges of a mesh: every half-edge sorted by its two vertices, so that those of one edge are
/// neighbours.
class Edges {
 public:
  explicit Edges(const std::vector<Face>& faces);

  /// One edge: `count` half-edges from `first`, in the order of their faces.
  struct Edge {
    uint32_t low, high;  // vertices
    const uint32_t* half;
    uint32_t count;
  };
  const std::vector<Edge>& all() const { return edges_; }

  /// Of each half-edge: the other one of its edge where there are exactly two, else kNone.
  std::vector<uint32_t> mates() const;
  uint32_t open_count() const;     // edges of one face
  uint32_t crowded_count() const;  // edges of more than two

 private:
  std::vector<uint32_t> halves_;
  std::vector<Edge> edges_;
};

/// Sets that grow together: each item's set is named by its lowest item.
class Sets {
 public:
  explicit Sets(size_t count);
  uint32_t find(uint32_t item);
  void join(uint32_t a, uint32_t b);

 private:
  std::vector<uint32_t> parent_;
};

/// The fans of a mesh: corners (3 * face + k) of one vertex joined across edges of two faces have
/// the same fan.
Sets corner_fans(const std::vector<Face>& faces, const std::vector<uint32_t>& mates);

}  // namespace firmtouch::tools
