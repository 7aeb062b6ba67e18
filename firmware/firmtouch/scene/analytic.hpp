#pragma once
#include "firmtouch/scene/touched.hpp"

// Shapes in closed form, device frame: models of what a shape of your own looks like. Each costs
// one visit a query, one unit a way, and keeps no hint.
namespace firmtouch::scene {

/// The half-space behind a plane.
struct PlaneTouched {
  math::Vec3 point_m, normal;  // unit
  float scale_m = 1;           // the size that tolerances refer to

  float size_m() const { return scale_m; }
  Near near(math::Vec3 x_m, query::Budget budget, float needed_m) const;
  float free_part(const Way& way, query::Budget budget, uint32_t& work) const;
};

struct SphereTouched {
  math::Vec3 centre_m;
  float radius_m = 0;

  float size_m() const;
  Near near(math::Vec3 x_m, query::Budget budget, float needed_m) const;
  float free_part(const Way& way, query::Budget budget, uint32_t& work) const;
};

/// All points within radius_m of a segment.
struct CapsuleTouched {
  math::Vec3 end_m[2];
  float radius_m = 0;

  float size_m() const;
  Near near(math::Vec3 x_m, query::Budget budget, float needed_m) const;
  float free_part(const Way& way, query::Budget budget, uint32_t& work) const;
};

/// Flat ends, across the axis.
struct CylinderTouched {
  math::Vec3 end_m[2];
  float radius_m = 0;

  float size_m() const;
  Near near(math::Vec3 x_m, query::Budget budget, float needed_m) const;
  float free_part(const Way& way, query::Budget budget, uint32_t& work) const;
};

struct BoxTouched {
  math::RigidTransform pose;
  math::Vec3 half_m;  // extent along its own axes

  float size_m() const;
  Near near(math::Vec3 x_m, query::Budget budget, float needed_m) const;
  float free_part(const Way& way, query::Budget budget, uint32_t& work) const;
};

}  // namespace firmtouch::scene
