#pragma once
#include "firmtouch/asset/container.hpp"
#include "firmtouch/curve/view.hpp"
#include "firmtouch/field/view.hpp"
#include "firmtouch/hull/view.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/spline/guide_view.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch {

// The sections of one named geometry of an asset, as its module's open() takes them. The modules know no
// container, and the container no geometry: whoever composes them finds the sections here.
// Errors: a section that the asset lacks is empty, which open() refuses by its rule.
// Bounds: a search of the section table each (asset::Container::find); no memory is copied.
mesh::Sections mesh_sections(const asset::Container& container, const char* name);
field::Sections distance_field_sections(const asset::Container& container, const char* name);
hull::Sections hull_sections(const asset::Container& container, const char* name);
curve::Sections curve_sections(const asset::Container& container, const char* name);
spline::Sections spline_sections(const asset::Container& container, const char* name);
spline::GuideSections guide_sections(const asset::Container& container, const char* name);

}  // namespace firmtouch
