#pragma once
#include <string>
#include <vector>

#include "field/distance_field.hpp"

namespace firmtouch::tools {

/// A distance field as VTK ImageData (.vti, which ParaView opens): a point a voxel, at its centre,
/// with the arrays distance (signed), closest_point, triangle (index in its file), object (index of
/// the model), side (-1 inside, 1 outside) and kind (0 outside, 1 surface, 2 inside by the flood).
/// What was not computed is NaN, triangle and object -1, side 0.
std::string to_vti(const DistanceField& distance_field, const std::vector<Solid>& solids);

/// The signed distances alone as NRRD (.nrrd, which 3D Slicer opens). What was not computed is NaN.
/// Source: Definition of NRRD File Format, Teem (attached header, raw).
std::string to_nrrd(const DistanceField& distance_field);

}  // namespace firmtouch::tools
