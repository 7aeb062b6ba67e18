#pragma once
#include "firmtouch/controller/controller.hpp"
#include "firmtouch/controller/curve_guide.hpp"
#include "firmtouch/controller/homed_device.hpp"
#include "firmtouch/controller/mesh_surface.hpp"
#include "firmtouch/controller/shaded.hpp"
#include "firmtouch/controller/spline_guide.hpp"
#include "firmtouch/controller/spline_surface.hpp"
#include "firmtouch/params/table.hpp"

namespace firmtouch {

/// A controller of every part of the library, with names for what it has opened.
template <template <class> class ScenesOf, class Device = HomedDevice, class Mesh = FullMesh,
          class SurfaceList = Surfaces<Mesh, SplineSurface>>
class EveryPart : public Controller<Shaded<SurfaceList>, Guides<CurveGuide, SplineGuide>, Device,
                                    asset::Proven, ScenesOf> {
 public:
  const mesh::View& mesh() const { return full_mesh().mesh(); }
  const hull::View& hull() const { return full_mesh().hull(); }
  const field::View& distance_field() const { return full_mesh().distance_field(); }
  const spline::View& spline_surface() const {
    return this->template surface<SplineSurface>().surface();
  }
  const curve::View& curve() const { return this->guide().template get<CurveGuide>().curve(); }
  const device::StoredLinkage& linkage() const { return this->device().linkage(); }
  const spline::GuideView& spline_guide() const {
    return this->guide().template get<SplineGuide>().guide();
  }

 private:
  const Mesh& full_mesh() const { return this->template surface<Mesh>(); }
};

/// With room for the next asset (Controller::begin_next()).
using SwappingController = EveryPart<TwoScenes>;

/// Every part of the library except `objects` and `materials`: a mesh with its distance field and
/// base hull, else spline surfaces; a sampled curve, else spline curves; a linkage, homed where the
/// asset says how, else three axes. FIRMTOUCH_APP="all;homing".
using FullController = EveryPart<OneScene>;
static_assert(FullController::kTable.size() == params::kTable.size(),
              "params::kTable is the full controller's");

}  // namespace firmtouch
