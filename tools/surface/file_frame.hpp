#pragma once
#include <string>

#include "surface/point.hpp"

namespace firmtouch::tools {

/// How coordinates of a file become metres: scaled, turned, then moved. Messages name places in the
/// file's own coordinates, so each surface keeps its frame.
struct FileFrame {
  /// `metres`: a unit of the file.
  FileFrame(double metres = 1);  // NOLINT(google-explicit-constructor): a unit is a frame

  double unit_m = 1;
  bool has_unit = true;  // the user said it: a unit in the file gives way
  const char* unit = "m";
  double scale = 1;
  bool is_turned = false;
  double turn[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // orthonormal
  Point offset_m;

  Point to_m(Point p) const { return placed(p * unit_m); }
  /// The same for a point that is in metres already.
  Point placed(Point p_m) const;
  Point in_file(Point p_m) const;
  /// Replaces the unit, unless the user gave one. `name`: "m", "mm", ...; lives for ever.
  void take_unit(double metres, const char* name);
  /// "12.5 mm", from metres.
  std::string length_text(double length_m) const;
  /// " (1, 2, 3 mm)", from metres.
  std::string place_text(Point p_m) const;
};

/// Quarter turns are exact. `axis`: 0 x, 1 y, 2 z; right-handed, after what `frame` turns already.
void turn_about(FileFrame& frame, int axis, double degrees);

}  // namespace firmtouch::tools
