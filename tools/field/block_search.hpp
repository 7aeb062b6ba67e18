#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "field/lanes.hpp"
#include "field/triangle_tree.hpp"

namespace firmtouch::tools {

/// Triangles with the first `kWords` words of their rows, those of kLanes triangles beside each
/// other.
template <uint32_t kWords>
struct LaneList {
  std::vector<float> words;  // of group g: kWords times kLanes floats from g * kWords * kLanes on
  std::vector<uint32_t> triangle;
  uint32_t count = 0;

  const float* group(uint32_t first) const { return words.data() + size_t{first} * kWords; }
  /// Room for so many triangles and a group more.
  void reserve(uint32_t triangles) {
    if (triangles + kLanes <= triangle.size()) return;
    triangle.resize((size_t{triangles} / kLanes + 2) * kLanes);
    words.resize(triangle.size() * kWords);
  }
  /// Sets the words of the triangles that are listed.
  void fill(const std::vector<TriangleTree::Row>& rows) {
    if (count == 0) return;
    for (uint32_t i = count; i % kLanes != 0; ++i) triangle[i] = triangle[count - 1];
    for (uint32_t at = 0; at < count; at += kLanes) {
      const float* row[kLanes];
      for (uint32_t i = 0; i < kLanes; ++i) row[i] = rows[triangle[at + i]].word;
      Lanes columns[kLanes];
      turn(row, columns);
      float* const to = words.data() + size_t{at} * kWords;
      for (uint32_t k = 0; k < kWords; ++k) columns[k].store(to + k * kLanes);
    }
  }
};

using BoxList = LaneList<6>;   // low x y z, high x y z
using DiskList = LaneList<7>;  // centre, unit normal, radius

/// The nearest triangles of points that lie together in cubes: what a cube cannot have nearest is
/// left out for all of its points at once. Each point begins with the triangle of the one before
/// it.
class BlockSearch {
 public:
  using Point3 = std::array<float, 3>;  // in the tree's frame

  explicit BlockSearch(const TriangleTree& tree) : tree_(tree) {}

  /// From the whole tree: what may be nearest to a point between low and high.
  void open_block(const Point3& low, const Point3& high, BoxList& found);
  /// The same from the list of a cube around it.
  void narrow(const BoxList& from, const Point3& low, const Point3& high, BoxList& found);
  void narrow(const BoxList& from, const Point3& low, const Point3& high, DiskList& found);
  /// The nearest of those on a cube's list to a point of that cube.
  uint32_t nearest(const DiskList& from, const Point3& p);

  /// Where the next point begins: a triangle, or kNoFace.
  uint32_t seed = kNoFace;

 private:
  class Best;
  template <class List>
  void list_within(const BoxList& from, const Point3& low, const Point3& high, List& found);
  float reach2(const Point3& low, const Point3& high);

  const TriangleTree& tree_;
  std::vector<uint32_t> stack_;
};

}  // namespace firmtouch::tools
