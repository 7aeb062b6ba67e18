#include "surface/file_frame.hpp"

#include <cmath>
#include <cstdio>

#include "surface/turns.hpp"

namespace firmtouch::tools {
namespace {

const char* name_of(double unit_m) {
  static constexpr struct {
    double unit_m;
    const char* name;
  } kUnits[] = {{1, "m"}, {0.01, "cm"}, {0.001, "mm"}, {0.0254, "in"}};
  for (const auto& unit : kUnits)
    if (!(unit.unit_m < unit_m || unit.unit_m > unit_m)) return unit.name;
  return "units";
}

bool is_moved(Point p) { return p.x < 0 || p.x > 0 || p.y < 0 || p.y > 0 || p.z < 0 || p.z > 0; }

}  // namespace

FileFrame::FileFrame(double metres) : unit_m(metres), unit(name_of(metres)) {}

Point FileFrame::placed(Point p_m) const {
  Point at = p_m * scale;
  if (is_turned)
    at = {turn[0][0] * at.x + turn[0][1] * at.y + turn[0][2] * at.z,
          turn[1][0] * at.x + turn[1][1] * at.y + turn[1][2] * at.z,
          turn[2][0] * at.x + turn[2][1] * at.y + turn[2][2] * at.z};
  return is_moved(offset_m) ? at + offset_m : at;
}

Point FileFrame::in_file(Point p_m) const {
  Point at = is_moved(offset_m) ? p_m - offset_m : p_m;
  if (is_turned)
    at = {turn[0][0] * at.x + turn[1][0] * at.y + turn[2][0] * at.z,
          turn[0][1] * at.x + turn[1][1] * at.y + turn[2][1] * at.z,
          turn[0][2] * at.x + turn[1][2] * at.y + turn[2][2] * at.z};
  return at * (1 / (unit_m * scale));
}

void FileFrame::take_unit(double metres, const char* name) {
  if (has_unit) return;
  unit_m = metres;
  unit = name;
}

std::string FileFrame::length_text(double length_m) const {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g %s", length_m / (unit_m * scale), unit);
  return text;
}

std::string FileFrame::place_text(Point p_m) const {
  const Point p = in_file(p_m);
  char text[120];
  std::snprintf(text, sizeof text, " (%.6g, %.6g, %.6g %s)", p.x, p.y, p.z, unit);
  return text;
}

void turn_about(FileFrame& frame, int axis, double degrees) {
  double cosine = cosine_of_turns(degrees / 360), sine = sine_of_turns(degrees / 360);
  if (!(std::fabs(std::remainder(degrees, 90)) > 0)) {
    cosine = std::round(cosine);
    sine = std::round(sine);
  }
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  for (int k = 0; k < 3; ++k) {
    const double a = frame.turn[i][k], b = frame.turn[j][k];
    frame.turn[i][k] = cosine * a - sine * b;
    frame.turn[j][k] = sine * a + cosine * b;
  }
  frame.is_turned = true;
}

}  // namespace firmtouch::tools
