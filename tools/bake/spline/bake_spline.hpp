#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bake/asset/section.hpp"
#include "bake/spline/spline_pieces.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "spline/spline.hpp"

namespace firmtouch::tools {

struct SplineReport {
  bool is_surface = false, is_rational = false, is_planar = false;
  uint32_t entities = 0;
  uint32_t pieces = 0;  // polynomial or rational, after cutting at knots and for float32
  uint32_t leaves = 0;
  uint32_t levels = 0;  // of the tree
  double extent_m = 0;
  double loss_m = 0;       // of a distance, at most, beside 5 units of float32 of it
  double deviation_m = 0;  // of what is stored from the file, at most; within loss_m
  uint64_t bytes = 0;      // of all sections that a tick reads
  std::string problem;     // empty: baked and proven; else what, where and how to mend
};

/// How finely pieces are cut into leaves. More leaves, fewer evaluations a query; small: half the
/// bytes.
struct SplineDetail {
  double thickness = 0.004;  // of a leaf about its chord or plane, of the extent
  double doubt =
      1;  // change of the second derivative across a leaf (rational curves: a piece), of itself
  uint32_t max_halvings = 4;  // of a piece on an axis
  uint32_t cell_level = 1;    // halvings of a surface's piece to a cell, a rational one.s: one more
};
SplineDetail curve_detail(bool is_small);
SplineDetail surface_detail(bool is_small);

/// Cuts a file's curves or surfaces into pieces and parts with proven bounds and a tree over them,
/// and proves the result with the firmware's own open().
std::vector<Section> bake_spline(const SplineModel& model, const std::string& name,
                                 const SplineDetail& detail, SplineReport& report);

/// Sets how many steps the worst query seen took, in a baked head.
void set_worst_steps(std::vector<Section>& sections, const std::string& name, uint32_t steps);

}  // namespace firmtouch::tools
