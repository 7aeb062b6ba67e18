#include "surface/near_faces.hpp"

#include <algorithm>
#include <cmath>

#include "surface/edges.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

// Sides and turns below this, relative to the products they are made of, are not sure.
constexpr double kRounding = 1e-14;
constexpr uint32_t kFewFaces = 64;      // about a vertex: all pairs take less time than a tree
constexpr double kFarDirection = 1e-9;  // far above the rounding of a direction

Box box_around(Point a, Point b, double margin) {
  return {{std::min(a.x, b.x) - margin, std::min(a.y, b.y) - margin, std::min(a.z, b.z) - margin},
          {std::max(a.x, b.x) + margin, std::max(a.y, b.y) + margin, std::max(a.z, b.z) + margin}};
}

// A face with its normal, and the sum of the products that each coordinate of it is made of.
struct Triangle {
  const Face& face;
  Point at[3], normal, products;

  Triangle(const Surface& surface, const Face& of) : face(of) {
    for (uint32_t k = 0; k < 3; ++k) at[k] = to_point(surface.vertices[face[k]]);
    const Point a = at[1] - at[0], b = at[2] - at[0];
    normal = cross(a, b);
    products = {std::fabs(a.y * b.z) + std::fabs(a.z * b.y),
                std::fabs(a.z * b.x) + std::fabs(a.x * b.z),
                std::fabs(a.x * b.y) + std::fabs(a.y * b.x)};
  }
  bool has(uint32_t v) const { return v == face[0] || v == face[1] || v == face[2]; }
};

// 1 above the plane of a, -1 below it, 0 where that is not sure.
int side(const Triangle& a, Point p) {
  const Point w = p - a.at[0];
  const double value = dot(a.normal, w);
  const double doubt = kRounding * (a.products.x * std::fabs(w.x) + a.products.y * std::fabs(w.y) +
                                    a.products.z * std::fabs(w.z));
  return value > doubt ? 1 : value < -doubt ? -1 : 0;
}

// Whether b lies on one side of the plane of a, except for common vertices.
bool is_beside_plane(const Triangle& a, const Triangle& b) {
  int first = 0;
  for (uint32_t k = 0; k < 3; ++k) {
    if (a.has(b.face[k])) continue;
    const int of_corner = side(a, b.at[k]);
    if (of_corner == 0 || of_corner == -first) return false;
    first = of_corner;
  }
  return first != 0;
}

// A triangle seen along an axis.
struct Shape {
  const Face& face;
  double u[3], v[3];

  Shape(const Triangle& of, int axis) : face(of.face) {
    for (uint32_t k = 0; k < 3; ++k) {
      const Point& p = of.at[k];
      u[k] = axis == 0 ? p.y : axis == 1 ? p.z : p.x;
      v[k] = axis == 0 ? p.z : axis == 1 ? p.x : p.y;
    }
  }
};

// The axis that a normal is nearest to.
int axis_of(Point normal) {
  const double x = std::fabs(normal.x), y = std::fabs(normal.y), z = std::fabs(normal.z);
  return x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
}

// 1 where corner c of b lies to the left of edge k of a, -1 to the right, 0 where that is not sure.
int turn(const Shape& a, uint32_t k, const Shape& b, uint32_t c) {
  const uint32_t next = (k + 1) % 3;
  const double eu = a.u[next] - a.u[k], ev = a.v[next] - a.v[k];
  const double cu = b.u[c] - a.u[k], cv = b.v[c] - a.v[k];
  const double left = eu * cv, right = ev * cu;
  const double doubt = kRounding * (std::fabs(left) + std::fabs(right));
  return left - right > doubt ? 1 : left - right < -doubt ? -1 : 0;
}

// Whether the line of an edge of a separates them: b lies beyond it, except for common ends.
bool separates(const Shape& a, const Shape& b) {
  for (uint32_t k = 0; k < 3; ++k) {
    const int inside = turn(a, k, a, (k + 2) % 3);
    bool is_beyond = inside != 0;
    for (uint32_t c = 0; c < 3 && is_beyond; ++c) {
      const uint32_t corner = b.face[c];
      is_beyond =
          corner == a.face[k] || corner == a.face[(k + 1) % 3] || turn(a, k, b, c) == -inside;
    }
    if (is_beyond) return true;
  }
  return false;
}

}  // namespace

NearFaces::NearFaces(const Surface& surface) : surface_(surface), tree_({}) {
  gather_stars();
  std::vector<Box> items;
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    if (star_of_[f] == kNone) loose_.push_back(f), items.push_back(box_of(f));
  }
  for (Star& star : stars_) {
    std::vector<Box> boxes, directions;
    for (const uint32_t f : star.faces) {
      boxes.push_back(box_of(f));
      directions.push_back(directions_of(f, star.hub));
    }
    star.boxes = BoxTree(std::move(boxes));
    star.directions = BoxTree(std::move(directions));
    items.push_back(star.boxes.bounds());
  }
  tree_ = BoxTree(std::move(items));
}

// Each face goes to the vertex with the most faces.
void NearFaces::gather_stars() {
  std::vector<uint32_t> valence(surface_.vertices.size(), 0), star_at(valence.size(), kNone);
  for (const Face& face : surface_.faces)
    for (const uint32_t v : face) ++valence[v];
  for (uint32_t f = 0; f < surface_.faces.size(); ++f) {
    const Face& face = surface_.faces[f];
    const uint32_t hub = *std::max_element(
        face.begin(), face.end(), [&](uint32_t v, uint32_t w) { return valence[v] < valence[w]; });
    star_of_.push_back(kNone);
    if (valence[hub] <= kFewFaces) continue;
    if (star_at[hub] == kNone) {
      star_at[hub] = static_cast<uint32_t>(stars_.size());
      stars_.push_back({hub, {}, BoxTree({}), BoxTree({})});
    }
    star_of_[f] = star_at[hub];
    stars_[star_of_[f]].faces.push_back(f);
  }
}

Box NearFaces::box_of(uint32_t f) const {
  const Face& face = surface_.faces[f];
  const Box box =
      box_around(to_point(surface_.vertices[face[0]]), to_point(surface_.vertices[face[1]]), 0);
  const Point c = to_point(surface_.vertices[face[2]]);
  return {box_around(box.low, c, 0).low, box_around(box.high, c, 0).high};
}

// Of the directions from the hub to the face: an arc of the unit sphere, nowhere farther from its
// chord c than c^2 / 4.
Box NearFaces::directions_of(uint32_t f, uint32_t hub) const {
  const Face& face = surface_.faces[f];
  const uint32_t k = hub == face[0] ? 0 : hub == face[1] ? 1 : 2;
  const auto direction = [&](uint32_t corner) {
    const Point along =
        to_point(surface_.vertices[face[corner % 3]]) - to_point(surface_.vertices[hub]);
    const double size = length(along);
    return size > 0 ? along * (1 / size) : Point{};
  };
  const Point a = direction(k + 1), b = direction(k + 2);
  return box_around(a, b, dot(b - a, b - a) / 4 + kFarDirection);
}

void NearFaces::above(uint32_t f, std::vector<uint32_t>& near) const {
  within(f, 0, near);
  keep_above(f, near);
}

void NearFaces::within(uint32_t f, double margin_m, std::vector<uint32_t>& near) const {
  const Point margin{margin_m, margin_m, margin_m};
  Box box = box_of(f);
  box = {box.low - margin, box.high + margin};
  near.clear();
  found_.clear();
  tree_.overlaps(box, found_);
  for (const uint32_t item : found_) {
    if (item < loose_.size()) {
      near.push_back(loose_[item]);
      continue;
    }
    const uint32_t s = item - static_cast<uint32_t>(loose_.size());
    const Star& star = stars_[s];
    const size_t first = near.size();
    if (s == star_of_[f])
      star.directions.overlaps(directions_of(f, star.hub), near);
    else
      star.boxes.overlaps(box, near);
    for (size_t i = first; i < near.size(); ++i) near[i] = star.faces[near[i]];
  }
}

void NearFaces::keep_above(uint32_t f, std::vector<uint32_t>& near) const {
  const Triangle face(surface_, surface_.faces[f]);
  const int axis = axis_of(face.normal);
  const Shape shape(face, axis);
  const auto is_no_pair = [&](uint32_t g) {
    if (g <= f) return true;
    const Triangle other(surface_, surface_.faces[g]);
    if (is_beside_plane(face, other) || is_beside_plane(other, face)) return true;
    const Shape beside(other, axis);
    return separates(shape, beside) || separates(beside, shape);
  };
  near.erase(std::remove_if(near.begin(), near.end(), is_no_pair), near.end());
}

}  // namespace firmtouch::tools
