#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "surface/check/check.hpp"
#include "surface/near_faces.hpp"
#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// What float32 does not resolve, of the diagonal: two distances that are each off by 2e-7 of it,
/// up to a quarter more away.
constexpr double kUnresolved = 5e-7;

/// Finds sheets of opposite orientation that are nearer than float32 resolves: a query cannot
/// resolve which of them is nearer, and they give opposite signs, at any depth. Two walls with a
/// gap, or the two sides of a thin sheet. Faces with a common edge, and those that slivers
/// part from one, are left to the proof of the signs: their gap opens with the distance from it.
class NearSheets {
 public:
  /// `mates`: Edges(surface.faces).mates(). All of them live as long as this.
  NearSheets(const Surface& surface, const NearFaces& near_faces,
             const std::vector<uint32_t>& mates);

  /// How near.
  double unresolved_m() const { return unresolved_m_; }
  /// Compares a face with those above it, of which `near` has all that are so near.
  void look_at(uint32_t f, const std::vector<uint32_t>& near);
  void refuse(CheckReport& report) const;

 private:
  Point point(uint32_t f, uint32_t k) const {
    return to_point(surface_.vertices[surface_.faces[f][k % 3]]);
  }
  double height(uint32_t f, Point p) const { return dot(normals_[f], p - point(f, 0)); }
  uint32_t common_vertices(uint32_t f, uint32_t g) const;
  bool is_clear_of_plane(uint32_t f, uint32_t g) const;
  bool is_convex_edge(uint32_t f, uint32_t k) const;
  bool goes_on(uint32_t f, uint32_t k, Point normal) const;
  std::vector<uint32_t> place_of(uint32_t f) const;
  bool crosses(uint32_t f, uint32_t g) const;
  bool crosses_any(uint32_t f) const;
  bool lies_on(uint32_t f, uint32_t g, double along_m) const;

  struct Polygon;
  Polygon beside(uint32_t f, uint32_t g, double margin_m) const;
  bool is_beside_common_edge(uint32_t f, uint32_t g, const Polygon& polygon) const;

  const Surface& surface_;
  const NearFaces& near_faces_;
  const std::vector<uint32_t>& mates_;
  std::vector<Point> normals_;
  // So thin that rounding turns it: a needle beside a face of a flat place only seems to look away.
  std::vector<bool> is_needle_;
  double unresolved_m_ = 0;
  std::vector<std::pair<uint32_t, uint32_t>> found_;  // both ways
};

}  // namespace firmtouch::tools
