#pragma once
#include "firmtouch/controller/controller.hpp"
#include "firmtouch/controller/curve_guide.hpp"
#include "firmtouch/controller/homed_device.hpp"
#include "firmtouch/controller/mesh_surface.hpp"
#include "firmtouch/controller/spline_guide.hpp"
#include "firmtouch/controller/spline_surface.hpp"
#include "firmtouch/params/table.hpp"

namespace firmtouch {

template <template <class> class ScenesOf, class Device = HomedDevice>
using EveryPart = Controller<Surfaces<FullMesh, SplineSurface>, Guides<CurveGuide, SplineGuide>,
                             Device, asset::Proven, ScenesOf>;

/// With room for the next asset (Controller::begin_next()).
using SwappingController = EveryPart<TwoScenes>;

/// Every part of the library: a mesh with its distance field and base hull, else spline surfaces; a
/// sampled curve, else spline curves; a linkage, homed where the asset says how, else three axes.
/// What the simulator runs, and FIRMTOUCH_APP="all;homing".
class FullController : public EveryPart<OneScene> {
 public:
  const mesh::View& mesh() const { return surface<FullMesh>().mesh(); }
  const hull::View& hull() const { return surface<FullMesh>().hull(); }
  const field::View& distance_field() const { return surface<FullMesh>().distance_field(); }
  const spline::View& spline_surface() const { return surface<SplineSurface>().surface(); }
  const curve::View& curve() const { return guide().get<CurveGuide>().curve(); }
  const device::StoredLinkage& linkage() const { return device().linkage(); }
  const spline::GuideView& spline_guide() const { return guide().get<SplineGuide>().guide(); }
};
static_assert(FullController::kTable.size() == params::kTable.size(),
              "params::kTable is the full controller's");

}  // namespace firmtouch
