#include "host_sim/report/vtk.hpp"

#include <cstdio>

namespace firmtouch::host_sim {
namespace {

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

template <class Range, class Text>
std::string array(const char* type, const std::string& name, uint32_t components,
                  const Range& range, const Text& text, const std::string& attributes = "") {
  std::string all = std::string("<DataArray type=\"") + type + "\" Name=\"" + name +
                    "\" NumberOfComponents=\"" + std::to_string(components) + "\"" + attributes +
                    " format=\"ascii\">\n";
  for (const auto& item : range) all += text(item) + "\n";
  return all + "</DataArray>\n";
}

std::string points(const std::vector<Vec>& points_m) {
  return "<Points>\n" +
         array("Float32", "points", 3, points_m,
               [](Vec p) { return text_of(p.x) + " " + text_of(p.y) + " " + text_of(p.z); }) +
         "</Points>\n";
}

template <class Cells>
std::string cells(const char* kind, const Cells& cells) {
  std::vector<size_t> ends;
  for (const auto& cell : cells) ends.push_back((ends.empty() ? 0 : ends.back()) + cell.size());
  const auto corners = [](const auto& cell) {
    std::string text;
    for (const uint32_t corner : cell) text += std::to_string(corner) + " ";
    return text;
  };
  const auto number = [](size_t end) { return std::to_string(end); };
  return std::string("<") + kind + ">\n" + array("Int32", "connectivity", 1, cells, corners) +
         array("Int32", "offsets", 1, ends, number) + "</" + kind + ">\n";
}

// Readers take as many values of the whole as it says; none if it does not say.
std::string all_values(const char* place, const std::vector<PolyData::Values>& all) {
  std::string text = std::string("<") + place + ">\n";
  for (const PolyData::Values& one : all)
    text += array("Float32", one.name, one.components, one.values, text_of,
                  " NumberOfTuples=\"" + std::to_string(one.values.size() / one.components) + "\"");
  return text + "</" + place + ">\n";
}

std::string file_of(const char* type, const std::string& content) {
  return std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"") + type +
         "\" version=\"0.1\" byte_order=\"LittleEndian\">\n" + content + "</VTKFile>\n";
}

}  // namespace

std::string vtp_of(const PolyData& data) {
  const auto count = [](const char* of, size_t n) {
    return std::string(" NumberOf") + of + "=\"" + std::to_string(n) + "\"";
  };
  return file_of("PolyData", "<PolyData>\n" + all_values("FieldData", data.of_whole) + "<Piece" +
                                 count("Points", data.points_m.size()) +
                                 count("Verts", data.verts.size()) +
                                 count("Lines", data.lines.size()) + count("Strips", 0) +
                                 count("Polys", data.triangles.size()) + ">\n" +
                                 all_values("PointData", data.of_points) + points(data.points_m) +
                                 cells("Verts", data.verts) + cells("Lines", data.lines) +
                                 cells("Polys", data.triangles) + "</Piece>\n</PolyData>\n");
}

std::string pvd_of(const std::vector<TimedFile>& files) {
  std::string text = "<Collection>\n";
  for (const TimedFile& one : files)
    text += "<DataSet timestep=\"" + text_of(one.time_s) + "\" part=\"" + std::to_string(one.part) +
            "\" file=\"" + one.file + "\"/>\n";
  return file_of("Collection", text + "</Collection>\n");
}

}  // namespace firmtouch::host_sim
