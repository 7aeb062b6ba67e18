#pragma once
#include "bake/asset/section.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {

/// What the stored coordinates of all models in the box from `low_m` to `high_m` count from: 0
/// where float32 holds the box there to mesh::kMaxRounding diagonals, else its middle, rounded to
/// a power of two: a float32 exactly, and the same after small changes of the models.
Point origin_for(Point low_m, Point high_m);

/// Whether it is another than 0.
bool is_moved(Point origin_m);

/// Of the asset (tools/FORMAT.md). Pre: of origin_for(), or read from such a section.
Section origin_section(Point origin_m);

/// A stored position in the coordinates of the models. At 0 it keeps -0.
inline Point in_file(Point stored_m, Point origin_m) {
  return is_moved(origin_m) ? stored_m + origin_m : stored_m;
}

}  // namespace firmtouch::tools
