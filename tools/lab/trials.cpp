#include "lab/trials.hpp"

namespace firmtouch::lab {

std::vector<Bench> trials() {
  return {
      {"orders", "query orders, upper bounds and kinds of boxes, each with each", run_orders},
      {"pseudonormals", "the sign by every pseudonormal proposed, on figures and models",
       run_pseudonormals},
      {"pyramids", "margins of the sign on slender pyramids, stored and not", run_pyramids},
      {"grid", "Table 1 of Baerentzen & Aanaes: trees, grids and signs, two kinds of boxes",
       run_grid},
      {"morris", "interior distance fields: Table 1 of Morris", run_morris},
      {"hulls", "progressive hulls: tables 1 to 3 and figure 8 of Platis & Theoharis", run_hulls},
      {"hull-tables", "queries of a baked hull: their tables 3 and 4, k-DOP and AABB trees",
       run_hull_tables},
      {"curve-constraint", "the published curve constraint: time against samples and N",
       run_curve_constraint},
      {"curve-drag", "the drag that a penalty on arc length makes at corners", run_curve_drag},
      {"splines", "foot-points of splines carried along, at the published parameters", run_splines},
      {"cells", "planar splines: cells that list what may be nearest, against the tree", run_cells},
      {"pictures", "the papers' figures as SVG (--figures FOLDER)", run_pictures},
  };
}

}  // namespace firmtouch::lab
