#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "host_sim/plant/environment.hpp"
#include "host_sim/plant/vec.hpp"
#include "host_sim/report/image.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

/// A line of the 3D picture; where `values` is given, one a point from 0 to 1, it is coloured by
/// them.
struct Path {
  std::string key;  // names its colour in the style sheet and its switch in the legend
  std::string label;
  Colour colour;
  double width = 2;         // pixels
  std::vector<Vec> points;  // NaN in x: the line is interrupted
  std::vector<double> values;
};

/// What the 3D picture shows: the part and the lines about it, for the report's viewer and for the
/// drawn picture alike.
struct Stage {
  std::vector<Vec> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
  uint32_t source_triangles = 0;  // before it was thinned out for showing
  std::vector<Path> paths;
  Vec centre;
  double radius_m = 0.1;  // of all that is shown, about the centre
  double tool_radius_m = 0;
};

Stage make_stage(const World& world, const Trace& trace, double tool_radius_m);

/// Colours a force from none (0) to the run's largest (1).
Colour heat(double share);

/// Draws the stage as the viewer does at its first sight: orthographic, z up, hidden parts hidden.
/// The tool is drawn at `tool_m` where its x is finite.
Image draw(const Stage& stage, uint32_t width, uint32_t height, Colour background, Vec tool_m);

}  // namespace firmtouch::host_sim
