#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/query/swept_sphere.hpp"

// What a proxy queries of a shape: a near feature, and a certified bound of the distance. A shape
// is a struct with
//
//     scene::Near near(math::Vec3 x_m, query::Budget budget, float needed_m);  // device frame
//     float size_m() const;                         // diagonal of its bounding box
//
// and, so that small tools follow a fast hand, may have
//
//     float free_part(scene::Way way, query::Budget budget, uint32_t& work) const;
//
// Without it a tool's radius is at least kMinBall of the size (scene/proxy.hpp).
// It may keep a hint between queries. If the budget ends before the bound reaches `needed_m`, it
// may use a coarser bound that is cheaper. scene/analytic.hpp has five shapes,
// scene/mesh_touched.hpp and scene/spline_touched.hpp those of an asset.
namespace firmtouch::scene {

/// A convex part of a shape, device frame. The proxy replaces it by a plane.
struct Feature {
  enum class Kind : uint8_t {
    kNone,
    kTriangle,  // corner[0] to corner[1] is the longest edge
    kBall,      // about corner[0], of radius corner[1].x; 0: a point
    kHalfSpace  // behind the plane through corner[0] with the unit normal corner[1]
  };
  math::Vec3 corner[3];
  Kind kind = Kind::kNone;
  bool is_of_base_hull = false;  // holds only while the work does not suffice
  uint8_t object = 0;            // that it is of, where there are several
  uint8_t material = 0;  // of the triangle, where there are materials (stored_materials.hpp)
};

/// Certified distance, sign and normal of a shape at a point.
struct Nearness {
  float lower_m = 0;     // certified: no point of the shape is nearer
  float distance_m = 0;  // of the feature, an upper bound; without a feature of any point
  // Unit normal at the feature: for tools that begin on the surface or inside, and for how it
  // bends.
  math::Vec3 outward;
  int8_t sign = 0;  // +1 outside, -1 inside, 0 unknown, or the shape has no inside
  bool has_inside = false;
  bool is_exact = false;  // as query::Certificate::exact
  bool is_of_base_hull = false;
};

/// A shape's answer.
struct Near : Nearness {
  uint32_t steps = 0;  // visits
  uint32_t work = 0;   // units used
  Feature feature;     // kNone beyond the band
};

/// A straight move of the tool's sphere, device frame. Its free part, 0 to 1, is one on which no
/// point of the shape is nearer than the radius.
using Way = query::SweptSphere;

/// A plane with a feature behind it.
struct Tangent {
  math::Vec3 normal;     // unit, to the free side; 0 if the point is on the feature
  float distance_m = 0;  // of the point from the plane
};

/// What the choice of a plane depends on, beside feature and position.
struct Outlook {
  math::Vec3 way_m;      // to the hand
  float radius_m = 0;    // of the tool
  float rounding_m = 0;  // distances that differ by less are the same
};

/// The plane between a feature and a tool at `x_m`. It goes through the closest point of the
/// feature, across the line to it. Beside a triangle that is not the only plane which has all of
/// the triangle behind it: if the tool clears the triangle's own plane, the one of the two that
/// leaves more of the way is taken, the own one if they are the same. So a proxy slides over the
/// joints of coplanar triangles.
/// Result: finite. A feature without a kind is infinitely far away.
Tangent tangent_at(const Feature& feature, math::Vec3 x_m, const Outlook& outlook);

}  // namespace firmtouch::scene
