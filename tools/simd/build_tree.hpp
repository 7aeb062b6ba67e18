#pragma once
#include <memory>

#include "firmtouch/mesh/view.hpp"
#include "simd/wide_tree.hpp"

namespace firmtouch::simd {

/// A WideTree and its memory: 256 bytes a node and 232 a triangle.
class OwnedTree {
 public:
  /// Pre: the mesh is open and has at most kMaxWideTriangles triangles. Cost: O(triangles).
  explicit OwnedTree(const mesh::View& mesh);
  OwnedTree(OwnedTree&&) noexcept;
  OwnedTree& operator=(OwnedTree&&) noexcept;
  ~OwnedTree();

  const WideTree& tree() const;

 private:
  struct Arrays;
  std::unique_ptr<const Arrays> arrays_;
};

}  // namespace firmtouch::simd
