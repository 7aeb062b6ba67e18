#pragma once
#include "busy_surface.hpp"

// The controller program whose motors push: joints at rest inside a wall, which nobody presses.
// What the programs that overload and stop it have in common.
namespace firmtouch::target {

/// The wall of BusySurface.
void press_wall(const ModelRequest& request, const params::Values& values, ModelResult& result);

/// Opens an asset of sections that no part knows: they are skipped.
bool open_nothing();

void print(const char* name, uint32_t value);

}  // namespace firmtouch::target
