#include "surface/check/check.hpp"

#include <algorithm>

#include "surface/check/close_holes.hpp"
#include "surface/check/mending.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

// The option was given already, so it is not recommended again.
void leave_out_close_holes(std::vector<std::string>& defects) {
  const std::string remedy = ", or with --close-holes";
  for (std::string& line : defects) {
    const size_t at = line.find(remedy);
    if (at != line.npos) line.erase(at, remedy.size());
  }
}

constexpr char kBeforeMending[] =
    "; or mend it with --mend, give it a surface around it with --wrap 1%, or bake with "
    "--unsigned: distances without inside and outside";
constexpr char kAfterMending[] =
    "; --mend is not enough: give it a surface around it with --wrap 1%, or bake with --unsigned: "
    "distances without inside and outside";

// Parted sheets may be wound anew.
uint32_t part_and_wind(Surface& surface, std::vector<uint32_t>& component,
                       std::vector<bool>& turned, std::vector<std::string>& defects,
                       CheckReport& report) {
  split_sheets(surface, report);
  defects.clear();
  std::vector<bool> again;
  const uint32_t components = wind_alike(surface, component, again, defects);
  for (size_t f = 0; f < again.size(); ++f) turned[f] = turned[f] != again[f];
  return components;
}

// Caps join the pieces that they close; nothing is left to turn.
uint32_t wind_alike_again(Surface& surface, std::vector<uint32_t>& component,
                          std::vector<bool>& turned) {
  std::vector<std::string> none;
  std::vector<bool> turned_now;
  const uint32_t components = wind_alike(surface, component, turned_now, none);
  turned.resize(surface.faces.size(), false);
  return components;
}

}  // namespace

std::string counted(uint64_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string named_vertex(const Surface& surface, uint32_t vertex) {
  return "vertex " + std::to_string(vertex) +
         surface.frame.place_text(to_point(surface.vertices[vertex]));
}

std::string named_edge(const Surface& surface, uint32_t a, uint32_t b) {
  return "the edge from " + named_vertex(surface, a) + " to " + named_vertex(surface, b);
}

std::string named_face(const Surface& surface, uint32_t face) {
  return "face " + std::to_string(surface.source[face]) + ", at " +
         named_vertex(surface, surface.faces[face][0]);
}

void drop_faces(Surface& surface, const std::vector<bool>& dropped) {
  size_t to = 0;
  for (size_t f = 0; f < surface.faces.size(); ++f) {
    if (dropped[f]) continue;
    surface.faces[to] = surface.faces[f];
    surface.source[to] = surface.source[f];
    ++to;
  }
  surface.faces.resize(to);
  surface.source.resize(to);
}

CheckReport check_and_mend(Surface& surface, const CheckOptions& options) {
  CheckReport report;
  const uint32_t imported = static_cast<uint32_t>(surface.faces.size());
  surface.source.resize(std::min(surface.source.size(), surface.faces.size()));
  for (size_t f = surface.source.size(); f < surface.faces.size(); ++f) {
    surface.source.push_back(static_cast<uint32_t>(f));
  }
  refuse_bad_numbers(surface, report);
  if (!report.usable()) return report;

  drop_pointlike_faces(surface, report);
  weld_torn_vertices(surface, report);
  if (options.mend) weld_near_vertices(surface, report);
  drop_duplicate_faces(surface, report);
  if (options.mend) drop_dangling_faces(surface, report);

  std::vector<std::string> defects;
  std::vector<uint32_t> component;
  std::vector<bool> turned;
  uint32_t components = wind_alike(surface, component, turned, defects);
  if (options.mend) components = part_and_wind(surface, component, turned, defects, report);
  const bool closes = options.close_holes || options.mend;
  if (closes && defects.empty()) {
    close_holes(surface, imported, report);
    components = wind_alike_again(surface, component, turned);
  }
  find_topology_defects(surface, defects);
  if (closes) leave_out_close_holes(defects);
  wind_outward(surface, component, components, defects.empty(), turned, report);
  remove_flat_faces(surface, options, report);
  report.is_closed = defects.empty();
  if (!defects.empty() && !options.allow_unsigned) {
    defects.back() += options.mend ? kAfterMending : kBeforeMending;
  }
  std::vector<std::string>& reported = options.allow_unsigned ? report.kept : report.refused;
  reported.insert(reported.end(), defects.begin(), defects.end());

  if (report.is_closed && report.usable() && !options.allow_unsigned)
    refuse_contacts(surface, report);
  drop_unused_vertices(surface, report);
  refuse_bad_size(surface, report);
  return report;
}

}  // namespace firmtouch::tools
