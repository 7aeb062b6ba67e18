#include "bake/mesh/leaf_boxes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/tree/principal_axes.hpp"
#include "firmtouch/mesh/leaf_box.hpp"

namespace firmtouch::tools {
namespace {

// The length of an axis: 2^15 less what its rounding to integers, and the others', may add by
// Gershgorin's circles.
constexpr double kAxisLength = 32768 * (1 - 1.2e-4);

// What the widths of a box are taken to be wider, in half cells, so that no width of 0 hides the
// others. Of 20 to 2,000 none changed a band query by more than 1 %.
constexpr double kMargin = 200;

// No corner may be farther from the centre on any axis, in half cells.
constexpr double kReach = 32765;

struct Candidate {
  std::array<Point, 3> axis;
  Point centre;
  double room = 0;
};

Candidate about(const std::array<Point, 3>& axis, const std::vector<Point>& corners) {
  Candidate found{axis, {}, 1};
  for (const Point& a : axis) {
    double low = dot(a, corners[0]), high = low;
    for (const Point& p : corners) {
      low = std::min(low, dot(a, p));
      high = std::max(high, dot(a, p));
    }
    found.centre = found.centre + a * ((low + high) / 2);
    found.room *= high - low + kMargin;
  }
  return found;
}

bool is_in_reach(const Candidate& box, const std::vector<Point>& corners) {
  return std::all_of(corners.begin(), corners.end(), [&](const Point& p) {
    const Point from = p - box.centre;
    return std::max({std::fabs(from.x), std::fabs(from.y), std::fabs(from.z)}) <= kReach;
  });
}

// Vectors across the leaf: of each triangle, of all together, and across their principal plane.
std::vector<Point> normals_of(const std::vector<Point>& corners, const Frame& principal) {
  std::vector<Point> normals{principal.axis[2]};
  Point sum;
  for (size_t i = 0; i < corners.size(); i += 3) {
    normals.push_back(cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]));
    sum = sum + normals.back();
  }
  normals.push_back(sum);
  return normals;
}

// Pre: two triangles or more.
Candidate smallest_box(const std::vector<Point>& corners) {
  const Frame principal = principal_axes(corners);
  Candidate best = about({Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}}, corners);
  const auto consider = [&](Point along, Point normal) {
    if (!(length(normal) > 1e-9)) return;
    normal = normal * (1 / length(normal));
    along = along - normal * dot(along, normal);
    if (!(length(along) > 1e-9)) return;
    along = along * (1 / length(along));
    const Candidate box = about({along, cross(normal, along), normal}, corners);
    if (box.room < best.room && is_in_reach(box, corners)) best = box;
  };
  for (const Point& normal : normals_of(corners, principal)) {
    consider(principal.axis[0], normal);
    for (size_t i = 0; i < corners.size(); ++i)
      for (size_t j = 0; j < i; ++j) consider(corners[i] - corners[j], normal);
  }
  return best;
}

struct Rounded {
  double x, y, z;

  Rounded(Point p, double scale)
      : x(std::round(p.x * scale)), y(std::round(p.y * scale)), z(std::round(p.z * scale)) {}
};

uint32_t pair_of(double low, double high) {
  return (static_cast<uint32_t>(static_cast<int32_t>(low)) & 0xFFFFu) |
         static_cast<uint32_t>(static_cast<int32_t>(high)) << 16;
}

// Half the length along an axis, in cells, with the margins that open() requires and 0.02 more.
double half_length(const Rounded& axis, const Rounded& centre, const std::vector<Point>& corners,
                   float error) {
  double most = 0;
  for (const Point& p : corners)
    most = std::max(most, std::fabs(axis.x * (p.x - centre.x) + axis.y * (p.y - centre.y) +
                                    axis.z * (p.z - centre.z)));
  const double lengths = std::fabs(axis.x) + std::fabs(axis.y) + std::fabs(axis.z);
  return std::ceil((most + double{error} * lengths) / 65536 + 0x1p-5 + 0.03);
}

void put(const Candidate& box, const std::vector<Point>& corners, float error, uint32_t* words) {
  const Rounded centre(box.centre, 1);
  const std::array<Rounded, 3> axis{Rounded(box.axis[0], kAxisLength),
                                    Rounded(box.axis[1], kAxisLength),
                                    Rounded(box.axis[2], kAxisLength)};
  const auto half = [&](size_t k) { return half_length(axis[k], centre, corners, error); };
  words[0] = pair_of(half(0), half(1));
  words[1] = pair_of(0xFFFF, half(2));
  words[2] = pair_of(centre.x, centre.y);
  words[3] = pair_of(centre.z, axis[2].z);
  for (size_t k = 0; k < 3; ++k) words[4 + k] = pair_of(axis[k].x, axis[k].y);
  words[7] = pair_of(axis[0].z, axis[1].z);
}

// In half cells of the grid, less 2^15.
std::vector<Point> corners_of(const Surface& surface, const Grid& grid, uint32_t first,
                              uint32_t count) {
  const Point low_m{double{grid.low_m[0]}, double{grid.low_m[1]}, double{grid.low_m[2]}};
  std::vector<Point> corners;
  for (uint32_t t = first; t < first + count; ++t)
    for (const uint32_t corner : surface.faces[t])
      corners.push_back((to_point(surface.vertices[corner]) - low_m) * (2 / double{grid.cell_m}) -
                        Point{32768, 32768, 32768});
  return corners;
}

}  // namespace

std::vector<uint32_t> make_leaf_boxes(const Surface& surface, const Grid& grid,
                                      const MeshTree& tree) {
  const size_t end = surface.faces.size() * mesh::kLeafBoxStride;
  std::vector<uint32_t> words(end + mesh::kLeafBoxesEnd);
  words[end] = words[end + 1] = mesh::kNoLeafBox;
  const float error = grid.slack_cells > 0 ? mesh::kTurnedErrorHalfCells : mesh::kErrorHalfCells;
  for (const mesh::Node& node : tree.nodes)
    for (const mesh::Side& side : node.side) {
      if (!mesh::is_leaf(side.child)) continue;
      const uint32_t first = mesh::leaf_first(side.child), count = mesh::leaf_count(side.child);
      uint32_t* const leaf = words.data() + size_t{mesh::kLeafBoxStride} * first;
      if (count == 1) leaf[0] = leaf[1] = mesh::kNoLeafBox;
      if (count < 2) continue;
      const std::vector<Point> corners = corners_of(surface, grid, first, count);
      put(smallest_box(corners), corners, error, leaf);
    }
  return words;
}

}  // namespace firmtouch::tools
