#pragma once
#include <string>
#include <vector>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/curve/view.hpp"
#include "firmtouch/field/view.hpp"
#include "firmtouch/hull/view.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/spline/guide/view.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::tools {

/// Whether a mesh has its tree; without it only its hull can be queried.
bool has_tree(const asset::Container& container, const char* name);

/// The names of the geometries that have a section of this type, in the asset's order.
std::vector<std::string> names_with(const asset::Container& container, uint32_t type);

/// Opens a whole asset as a controller would: container, every mesh and curve, every probe's
/// answer. Result: empty, or what is wrong: the rule of tools/FORMAT.md and where.
std::string prove_asset(core::Bytes file);

std::string rule_text(core::Verdict verdict);

}  // namespace firmtouch::tools
