#pragma once
#include "firmtouch/curve/view.hpp"
#include "firmtouch/field/view.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/scene/stored_materials.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::target {

/// What the measurements read, of the asset in the board's slot.
struct Asset {
  mesh::View mesh;
  field::View field;
  scene::StoredMaterials materials;  // 1: plain, 2: waves, 3: a height map
  curve::View curve;
  spline::View spline;
};

/// Opens it. Result: false if a part is missing or refused.
bool open_asset();
const Asset& asset();

}  // namespace firmtouch::target
