#pragma once
#include <memory>

#include "firmtouch/mesh/view.hpp"

namespace firmtouch::tools {

/// What a processor with vector instructions reads in place of a mesh's tree and triangles
/// (mesh/ahead.hpp): 140 bytes a node and 232 a triangle. Others read none of it.
class MeshAhead {
 public:
  MeshAhead();
  /// Pre: the mesh is open and has at most mesh::kMaxAhead triangles. Cost: O(triangles).
  explicit MeshAhead(const mesh::View& mesh);
  MeshAhead(MeshAhead&&) noexcept;
  MeshAhead& operator=(MeshAhead&&) noexcept;
  ~MeshAhead();

  /// The mesh that it was made of, read so. Pre: this, or what it is moved to, is there as long.
  mesh::View view() const;

 private:
  struct Stored;
  std::unique_ptr<const Stored> stored_;
};

/// The same mesh as this processor reads it in the least time; `ahead` is made where it gains by it.
mesh::View read_ahead(const mesh::View& mesh, MeshAhead& ahead);

}  // namespace firmtouch::tools
