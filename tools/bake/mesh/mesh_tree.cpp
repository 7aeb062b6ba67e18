#include "bake/mesh/mesh_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "surface/edges.hpp"

namespace firmtouch::tools {
namespace {

struct WideBox {
  std::array<double, 3> low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

  void add(const WideBox& other) {
    for (size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }
  // Of the box with `more` added to each side.
  double half_area(double more) const {
    const double x = high[0] - low[0] + more, y = high[1] - low[1] + more,
                 z = high[2] - low[2] + more;
    return high[0] < low[0] ? 0 : x * y + y * z + z * x;
  }
};

std::array<double, 3> coordinates(math::Vec3 v) { return {double{v.x}, double{v.y}, double{v.z}}; }

std::vector<WideBox> face_boxes(const Surface& surface) {
  std::vector<WideBox> boxes(surface.faces.size());
  for (size_t f = 0; f < boxes.size(); ++f)
    for (const uint32_t corner : surface.faces[f]) {
      const std::array<double, 3> p = coordinates(surface.vertices[corner]);
      boxes[f].add(WideBox{p, p});
    }
  return boxes;
}

// A closest-point query reads the boxes within its distance of the surface, not those that a line
// crosses: with boxes widened by this many mean edges the heuristic prefers what is compact.
// Of 0, 2, 4, 6, 10, 20 and 40, 10 served the touching paths best (up to 6 % fewer instructions
// than 0).
constexpr double kMarginEdges = 10;

// The same where a leaf is split that could stay whole: far less, for such boxes hardly differ
// beside the other margin. 0.5 and 1 do alike at equal bytes.
constexpr double kLeafMarginEdges = 0.5;

// What reaching a leaf costs the controller beside 1 for a face of it.
constexpr double kLeafCost = 0.53;

// Grid coordinates of a box, rounded outward; 1/128 cell more than the rounding that the firmware's
// check allows.
void store_box(const WideBox& box, const Grid& grid, uint32_t* words) {
  const double slack = 0x1p-7 + double{grid.slack_cells};
  for (size_t k = 0; k < 3; ++k) {
    const double low =
        std::floor((box.low[k] - double{grid.low_m[k]}) / double{grid.cell_m} - slack);
    const double high =
        std::ceil((box.high[k] - double{grid.low_m[k]}) / double{grid.cell_m} + slack);
    words[k] = static_cast<uint32_t>(low) | ((mesh::kGridMax - static_cast<uint32_t>(high)) << 16);
  }
}

class Builder {
 public:
  Builder(const Surface& surface, const Grid& grid, const TreeShape& shape)
      : boxes_(face_boxes(surface)),
        grid_(grid),
        shape_(shape),
        mean_edge_(mean_edge_m(surface)),
        margin_(kMarginEdges * mean_edge_) {
    for (size_t axis = 0; axis < 3; ++axis) {
      std::vector<std::pair<double, uint32_t>> centres;  // twice as far from the origin
      centres.reserve(boxes_.size());
      for (const WideBox& box : boxes_)
        centres.push_back({box.low[axis] + box.high[axis], static_cast<uint32_t>(centres.size())});
      std::sort(centres.begin(), centres.end());
      for (const auto& [centre, face] : centres) faces_[axis].push_back(face);
    }
    is_first_.resize(boxes_.size());
  }

  MeshTree build() {
    struct Task {
      uint32_t begin, end, parent, which, depth;
    };
    std::vector<Task> tasks{{0, static_cast<uint32_t>(boxes_.size()), 0, 2, 0}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      const uint32_t index = static_cast<uint32_t>(tree_.nodes.size());
      tree_.nodes.push_back({});
      ranges_.push_back({});
      tree_.parents.push_back(
          task.which == 2 ? 0 : mesh::make_parent(task.parent, task.which, task.depth));
      if (task.which != 2) tree_.nodes[task.parent].side[task.which].child = index;
      tree_.depth = std::max(tree_.depth, task.depth + 1);
      const Cut cut = best_cut(task.begin, task.end);
      part(task.begin, task.end, cut);
      const uint32_t ends[3] = {task.begin, cut.middle, task.end};
      for (uint32_t which = 2;
           which-- > 0;) {  // the first child is taken off the stack first: depth-first numbering
        store_box(box_of(ends[which], ends[which + 1]), grid_, tree_.nodes[index].side[which].box);
        if (is_best_whole(ends[which], ends[which + 1]))
          ranges_[index][which] = {ends[which], ends[which + 1]};
        else
          tasks.push_back({ends[which], ends[which + 1], index, which, task.depth + 1});
      }
    }
    number_leaves();
    return std::move(tree_);
  }

 private:
  struct Range {
    uint32_t begin = 0, end = std::numeric_limits<uint32_t>::max();  // the default: not a leaf
  };

  struct Cut {
    size_t axis;
    uint32_t middle;  // the first of the second half, in the order along the axis
  };

  WideBox box_of(uint32_t begin, uint32_t end, size_t axis = 0) const {
    WideBox box;
    if (begin == end) return boxes_[faces_[axis][begin - 1]];  // the second leaf of a single face
    for (uint32_t i = begin; i < end; ++i) box.add(boxes_[faces_[axis][i]]);
    return box;
  }

  Cut best_cut(uint32_t begin, uint32_t end) {
    if (end - begin == 1) return {0, end};
    double best_cost = std::numeric_limits<double>::infinity();
    Cut best{0, begin + (end - begin) / 2};
    area_before_.resize(boxes_.size());
    for (size_t axis = 0; axis < 3; ++axis) {
      const std::vector<uint32_t>& faces = faces_[axis];
      WideBox box;
      for (uint32_t i = begin; i < end; ++i) {
        box.add(boxes_[faces[i]]);
        area_before_[i] = box.half_area(margin_);
      }
      box = {};
      for (uint32_t i = end - 1; i > begin; --i) {
        box.add(boxes_[faces[i]]);
        const double cost =
            area_before_[i - 1] * price(i - begin) + box.half_area(margin_) * price(end - i);
        if (cost < best_cost) best_cost = cost, best = {axis, i};
      }
    }
    return best;
  }

  // Brings the first half to the front of the range in all three orders, each half still in order.
  void part(uint32_t begin, uint32_t end, Cut cut) {
    for (uint32_t i = begin; i < end; ++i) is_first_[faces_[cut.axis][i]] = i < cut.middle;
    for (std::vector<uint32_t>& faces : faces_)
      std::stable_partition(faces.begin() + begin, faces.begin() + end,
                            [&](uint32_t face) { return is_first_[face] != 0; });
  }

  // Whether a range becomes a leaf.
  bool is_best_whole(uint32_t begin, uint32_t end) {
    if (end - begin > shape_.leaf_faces) return false;
    if (end - begin == 1 || shape_.node_cost <= 0) return true;
    const Cut cut = best_cut(begin, end);
    return leaf_cost(begin, end, cut.axis) <=
           leaf_cost(begin, cut.middle, cut.axis) + leaf_cost(cut.middle, end, cut.axis) +
               shape_.node_cost * leaf_area(begin, end, cut.axis);
  }
  double leaf_area(uint32_t begin, uint32_t end, size_t axis) const {
    return box_of(begin, end, axis).half_area(kLeafMarginEdges * mean_edge_);
  }
  double leaf_cost(uint32_t begin, uint32_t end, size_t axis) const {
    return leaf_area(begin, end, axis) * (kLeafCost + static_cast<double>(end - begin));
  }

  // What a subtree costs: its faces, and `empty_cost` for each by which its leaves would not be
  // full.
  double price(uint32_t faces) const {
    const uint32_t rest = faces % shape_.leaf_faces;
    const uint32_t missing = rest == 0 ? 0 : shape_.leaf_faces - rest;
    return static_cast<double>(faces) + shape_.empty_cost * static_cast<double>(missing);
  }

  void number_leaves() {
    for (size_t n = 0; n < tree_.nodes.size(); ++n)
      for (uint32_t which = 0; which < 2; ++which) {
        const Range range = ranges_[n][which];
        if (range.end == std::numeric_limits<uint32_t>::max()) continue;
        const uint32_t first = static_cast<uint32_t>(tree_.order.size());
        tree_.nodes[n].side[which].child = mesh::make_leaf(first, range.end - range.begin);
        std::vector<uint32_t> leaf(faces_[0].begin() + range.begin, faces_[0].begin() + range.end);
        std::sort(leaf.begin(), leaf.end());
        tree_.order.insert(tree_.order.end(), leaf.begin(), leaf.end());
      }
    // Inner boxes are the unions of the stored boxes below them, so that the firmware's check holds
    // to the bit.
    for (size_t n = tree_.nodes.size(); n-- > 1;) {
      const mesh::Node& node = tree_.nodes[n];
      const uint32_t word = tree_.parents[n];
      uint32_t* box = tree_.nodes[mesh::parent_of(word)].side[mesh::which_of(word)].box;
      for (size_t k = 0; k < 3; ++k)
        box[k] = std::min(node.side[0].box[k] & 0xFFFFu, node.side[1].box[k] & 0xFFFFu) |
                 std::min(node.side[0].box[k] >> 16, node.side[1].box[k] >> 16) << 16;
    }
  }

  std::vector<WideBox> boxes_;
  Grid grid_;
  TreeShape shape_;
  double mean_edge_;
  double margin_;
  std::array<std::vector<uint32_t>, 3> faces_;  // of each range by centre along x, y and z
  std::vector<uint8_t> is_first_;               // of each face, in the range that is parted last
  std::vector<double> area_before_;             // of the range that is looked at
  std::vector<std::array<Range, 2>> ranges_;
  MeshTree tree_;
};

}  // namespace

Grid make_grid(const Surface& surface) {
  WideBox box;
  for (const math::Vec3& v : surface.vertices) box.add(WideBox{coordinates(v), coordinates(v)});
  double extent = 0;
  for (size_t k = 0; k < 3; ++k) extent = std::max(extent, box.high[k] - box.low[k]);
  Grid grid;
  grid.cell_m = 0x1p-60f;
  while (double{grid.cell_m} * (mesh::kGridMax - 8) < 1.25 * extent) grid.cell_m *= 2;
  for (size_t k = 0; k < 3; ++k)
    grid.low_m[k] =
        static_cast<float>((box.low[k] + box.high[k] - double{grid.cell_m} * mesh::kGridMax) / 2);
  return grid;
}

MeshTree build_mesh_tree(const Surface& surface, const Grid& grid, const TreeShape& shape) {
  return Builder(surface, grid, shape).build();
}

}  // namespace firmtouch::tools
