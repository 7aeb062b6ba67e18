#pragma once
#include <vector>

#include "bake/mesh/pseudonormals.hpp"
#include "bake/mesh/sign_margin.hpp"

namespace firmtouch::tools {

/// The edges that leave each vertex, with their own pseudonormals.
class Stars {
 public:
  Stars(const Surface& surface, const ExactNormals& exact) : surface_(surface), exact_(exact) {
    start_.assign(surface.vertices.size() + 1, 0);
    for (const Face& face : surface.faces)
      for (const uint32_t v : face) ++start_[v + 1];
    for (size_t v = 0; v + 1 < start_.size(); ++v) start_[v + 1] += start_[v];
    halves_.resize(surface.faces.size() * 3);
    std::vector<uint32_t> at(start_.begin(), start_.end() - 1);
    for (uint32_t h = 0; h < halves_.size(); ++h) halves_[at[surface.faces[h / 3][h % 3]]++] = h;
  }

  std::vector<StarEdge> around(uint32_t vertex) const {
    std::vector<StarEdge> star;
    for (uint32_t i = start_[vertex]; i < start_[vertex + 1]; ++i) {
      const uint32_t h = halves_[i];
      const Face& face = surface_.faces[h / 3];
      const Point edge =
          to_point(surface_.vertices[face[(h % 3 + 1) % 3]]) - to_point(surface_.vertices[vertex]);
      star.push_back({edge * (1 / length(edge)), exact_.of_edge(h)});
    }
    return star;
  }

 private:
  const Surface& surface_;
  const ExactNormals& exact_;
  std::vector<uint32_t> start_, halves_;
};

}  // namespace firmtouch::tools
