#include "bake/spline_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/left_filled.hpp"
#include "bake/principal_axes.hpp"

namespace firmtouch::tools {
namespace {

struct Part {
  spline::Leaf leaf;
  spline::LeafShape shape;
  std::array<float, 3> middle_m;
  uint32_t order;                // piece by piece
  uint16_t first = 0, last = 0;  // points of a curve
};

struct Range {
  uint32_t node, begin, end;
};

spline::Bend bend_of(const Part& part, uint32_t k) {
  return {spline::rounded_up(part.shape.fixed[k]), spline::rounded_up(part.shape.turning[k])};
}

std::vector<Part> parts_of(const std::vector<StoredPiece>& pieces) {
  std::vector<Part> parts;
  for (size_t p = 0; p < pieces.size(); ++p) {
    const spline::Piece& piece = pieces[p].piece;
    for (uint32_t v = 0; v < 1u << piece.level_v; ++v)
      for (uint32_t u = 0; u < 1u << piece.level_u; ++u) {
        Part part{};
        part.shape = shape_of(pieces[p], piece.level_u, u, piece.level_v, v);
        part.leaf.piece = static_cast<uint16_t>(p);
        part.leaf.index_u = static_cast<uint8_t>(u);
        part.leaf.index_v = static_cast<uint8_t>(v);
        part.middle_m = {part.shape.middle_m.x, part.shape.middle_m.y, part.shape.middle_m.z};
        part.order = static_cast<uint32_t>(parts.size());
        parts.push_back(part);
      }
  }
  return parts;
}

math::Vec3 end_of(const spline::LeafShape& shape, float x) {
  math::Vec3 sum{};
  float w = 0;
  for (uint32_t k = shape.degree_u + 1; k-- > 0;) {
    sum = {sum.x * x + shape.c[k].x, sum.y * x + shape.c[k].y, sum.z * x + shape.c[k].z};
    w = w * x + shape.w[k];
  }
  return {shape.middle_m.x + sum.x / w, shape.middle_m.y + sum.y / w, shape.middle_m.z + sum.z / w};
}

// Neighbours that meet share the point between them.
bool place_points(std::vector<Part>& parts, std::vector<spline::Point>& points) {
  for (Part& part : parts) {
    const math::Vec3 first = end_of(part.shape, -1), last = end_of(part.shape, 1);
    const spline::Point* before = points.empty() ? nullptr : &points.back();
    const float near_m = 4 * part.shape.noise_m;
    const bool meets = before != nullptr && std::fabs(before->x_m - first.x) <= near_m &&
                       std::fabs(before->y_m - first.y) <= near_m &&
                       std::fabs(before->z_m - first.z) <= near_m;
    if (!meets) points.push_back({first.x, first.y, first.z});
    part.first = static_cast<uint16_t>(points.size() - 1);
    points.push_back({last.x, last.y, last.z});
    part.last = static_cast<uint16_t>(points.size() - 1);
    if (points.size() > spline::kMaxLeaves) return false;
  }
  return true;
}

uint32_t widest_axis(const std::vector<Part>& parts, uint32_t begin, uint32_t end) {
  std::array<float, 3> low = parts[begin].middle_m, high = low;
  for (uint32_t i = begin + 1; i < end; ++i)
    for (size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], parts[i].middle_m[k]);
      high[k] = std::max(high[k], parts[i].middle_m[k]);
    }
  size_t widest = 0;
  for (size_t k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[widest] - low[widest]) widest = k;
  return static_cast<uint32_t>(widest);
}

math::Vec3 vec(const spline::Point& p) { return {p.x_m, p.y_m, p.z_m}; }

spline::Capsule capsule_around(const std::vector<Part>& parts, uint32_t begin, uint32_t end,
                               const std::vector<spline::Point>& points) {
  spline::Capsule capsule{parts[begin].first, parts[end - 1].last, 0};
  const math::Vec3 a = vec(points[capsule.first]), b = vec(points[capsule.last]);
  for (uint32_t i = begin; i < end; ++i) {
    const math::Vec3 from = vec(points[parts[i].first]), to = vec(points[parts[i].last]);
    const uint16_t own = spline::rounded_up(spline::radius_for(parts[i].shape, from, to));
    const uint16_t needed =
        end - begin == 1
            ? own
            : spline::rounded_up(spline::radius_above(spline::from_half(own), from, to, a, b));
    capsule.radius = std::max(capsule.radius, needed);
  }
  return capsule;
}

Point at(const spline::LeafShape& shape, double x, double y) {
  Point sum{};
  double w = 0, py = 1;
  for (uint32_t j = 0; j <= shape.degree_v; ++j, py *= y) {
    double px = py;
    for (uint32_t i = 0; i <= shape.degree_u; ++i, px *= x) {
      const uint32_t k = j * (shape.degree_u + 1) + i;
      sum = sum + to_point(shape.c[k]) * px;
      w += static_cast<double>(shape.w[k]) * px;
    }
  }
  return to_point(shape.middle_m) + sum * (1 / w);
}

double volume(const spline::Box& box, double least_m) {
  double product = 1;
  for (const float half_m : box.half_m) product *= static_cast<double>(half_m) + least_m;
  return product;
}

// Along the principal axes of points of the parts, or along the model's, whichever is smaller.
spline::Box box_around(const std::vector<Part>& parts, uint32_t begin, uint32_t end) {
  std::vector<Point> samples;
  for (uint32_t i = begin; i < end; ++i)
    for (const double y : {-1.0, 0.0, 1.0})
      for (const double x : {-1.0, 0.0, 1.0}) samples.push_back(at(parts[i].shape, x, y));
  spline::Box best{};
  double least = HUGE_VAL;
  for (const bool is_own : {true, false}) {
    const Frame frame = is_own ? principal_axes(samples) : Frame{};
    double low[3], high[3];
    for (size_t k = 0; k < 3; ++k) {
      low[k] = HUGE_VAL, high[k] = -HUGE_VAL;
      for (const Point& s : samples) {
        low[k] = std::min(low[k], dot(s, frame.axis[k]));
        high[k] = std::max(high[k], dot(s, frame.axis[k]));
      }
    }
    spline::Box box{};
    Point centre{};
    for (size_t k = 0; k < 3; ++k) centre = centre + frame.axis[k] * (0.5 * (low[k] + high[k]));
    const math::Vec3 c = to_vec3(centre);
    box.centre_m[0] = c.x, box.centre_m[1] = c.y, box.centre_m[2] = c.z;
    for (size_t k = 0; k < 2; ++k) {
      const math::Vec3 axis = to_vec3(frame.axis[k] * (1 - 0x1p-21));
      box.axis[k][0] = axis.x, box.axis[k][1] = axis.y, box.axis[k][2] = axis.z;
    }
    for (uint32_t i = begin; i < end; ++i) spline::enlarge(parts[i].shape, box);
    const double size =
        volume(box, 1e-3 * static_cast<double>(box.half_m[0] + box.half_m[1] + box.half_m[2]));
    if (size < least) {
      least = size;
      best = box;
    }
  }
  return best;
}

}  // namespace

SplineTree build_spline_tree(const std::vector<StoredPiece>& pieces, bool is_surface) {
  SplineTree tree;
  std::vector<Part> parts = parts_of(pieces);
  const uint32_t bends = spline::bends_a_leaf(is_surface);
  for (const Part& part : parts)
    for (uint32_t k = 0; k < bends; ++k)
      if (bend_of(part, k).fixed >= 0x7F80u || bend_of(part, k).turning >= 0x7F80u) return tree;
  if (!is_surface && !place_points(parts, tree.points)) return tree;
  const auto count = static_cast<uint32_t>(parts.size());
  tree.leaves.resize(count);
  tree.bends.resize(size_t{count} * bends);
  tree.places.resize(count);
  if (is_surface)
    tree.boxes.resize(2 * count - 1);
  else
    tree.capsules.resize(2 * count - 1);
  std::vector<Range> open{{0, 0, count}};
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    if (is_surface)
      tree.boxes[range.node] = box_around(parts, range.begin, range.end);
    else
      tree.capsules[range.node] = capsule_around(parts, range.begin, range.end, tree.points);
    const uint32_t size = range.end - range.begin;
    if (size == 1) {
      const uint32_t leaf = range.node - (count - 1);
      tree.leaves[leaf] = parts[range.begin].leaf;
      for (uint32_t k = 0; k < bends; ++k)
        tree.bends[leaf * bends + k] = bend_of(parts[range.begin], k);
      tree.places[parts[range.begin].order] = static_cast<uint16_t>(leaf);
      continue;
    }
    const uint32_t middle = range.begin + (first_size(2 * size - 1) + 1) / 2;
    if (is_surface) {  // a curve keeps its order
      const size_t axis = widest_axis(parts, range.begin, range.end);
      std::sort(parts.begin() + range.begin, parts.begin() + range.end,
                [axis](const Part& a, const Part& b) {
                  if (a.middle_m[axis] < b.middle_m[axis]) return true;
                  if (b.middle_m[axis] < a.middle_m[axis]) return false;
                  return a.order < b.order;
                });
    }
    open.push_back({spline::first_child(range.node), range.begin, middle});
    open.push_back({spline::first_child(range.node) + 1, middle, range.end});
  }
  return tree;
}

}  // namespace firmtouch::tools
