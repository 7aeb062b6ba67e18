#include "surface/read/import_sink.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "firmtouch/mesh/layout.hpp"
#include "surface/ear_clip.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

bool begins(std::string_view bytes, std::string_view with) {
  return bytes.substr(0, with.size()) == with;
}

bool is_finite(float value) { return value - value <= 0; }

std::string element_of(const Place& place) {
  return place.element + (" " + std::to_string(place.index)) + " (from 0)";
}

}  // namespace

std::string quoted(std::string_view word) {
  return "`" + std::string(word.substr(0, 40)) + (word.size() > 40 ? "..." : "") + "`";
}

std::string ImportSink::where(const Place& place) const {
  std::string text = path_ + ":";
  if (place.line != 0) {
    text += std::to_string(place.line) + ":";
  } else {
    text += " byte " + std::to_string(place.byte) + (place.element != nullptr ? "," : ":");
  }
  if (place.element != nullptr) text += " " + element_of(place) + ":";
  return text + " ";
}

bool ImportSink::fail(const Place& place, const std::string& what) {
  if (!failed()) problem_ = where(place) + what;
  is_stopped_ = true;
  return false;
}

bool ImportSink::fail(const std::string& what) {
  if (!failed()) problem_ = path_ + ": " + what;
  is_stopped_ = true;
  return false;
}

bool ImportSink::defect(const Place& place, std::string_view kind, const std::string& what) {
  if (is_stopped_) return false;
  const bool is_first = !failed();
  if (is_first) kind_ = std::string(kind);
  if (kind_ != kind) {
    ++others_;
    return true;
  }
  ++times_;
  const auto is_before = [](const Place& a, const Place& b) {
    return a.line != b.line ? a.line < b.line : a.byte < b.byte;
  };
  if (is_first || is_before(place, first_)) {  // indices are checked last, and may name any line
    problem_ = where(place) + what;
    first_ = place;
  }
  if (is_first || is_before(last_, place)) last_ = place;
  return true;
}

bool ImportSink::bad_word(const Place& place, std::string_view word, const char* wrong) {
  std::string what = quoted(word) + " " + wrong;
  if (what.find(": ") == what.npos) what += ": mend it, or export the model again";
  return defect(place, wrong, what);
}

std::string ImportSink::problem() const {
  if (times_ == 0) return problem_;
  std::string text = problem_ + (times_ == 1 ? " (once" : " (" + std::to_string(times_) + " times");
  if (times_ > 1) {
    text += ", last at ";
    if (last_.element != nullptr) text += element_of(last_) + ", ";
    text += last_.line != 0 ? "line " + std::to_string(last_.line)
                            : "byte " + std::to_string(last_.byte);
  }
  if (others_ != 0) text += "; problems of other kinds: " + std::to_string(others_);
  return text + ")";
}

bool ImportSink::add_vertex(const double* xyz, const Place& place) {
  if (is_stopped_) return false;
  if (surface_.vertices.size() >= 0xFFFFFFF0u)
    return fail(place, "more vertices than 32 bits can number: split the model");
  const Point placed_m = surface_.frame.to_m({xyz[0], xyz[1], xyz[2]});
  const math::Vec3 v = to_vec3(placed_m);
  surface_.vertices.push_back(v);
  if (!is_finite(v.x) || !is_finite(v.y) || !is_finite(v.z)) {
    return defect(place, "coordinate",
                  "a coordinate is not a finite 32-bit number of metres: mend the model or choose "
                  "another --unit");
  }
  const Point moved = to_point(v) - placed_m;
  moved_m_ = std::max(moved_m_, length(moved));
  return true;
}

void ImportSink::use_material(std::string_view name) {
  std::vector<std::string>& names = materials_.names;
  const auto at = std::find(names.begin(), names.end(), name);
  material_ = name.empty() ? 0 : static_cast<uint32_t>(at - names.begin()) + 1;
  if (!name.empty() && at == names.end()) names.emplace_back(name);
}

bool ImportSink::add_polygon(const std::vector<int64_t>& corners, const Place& place) {
  if (is_stopped_) return false;
  if (corners.size() < 3) {
    return defect(place, "corners",
                  "a face with " + std::to_string(corners.size()) +
                      " corners: a face needs at least 3; remove it");
  }
  const int64_t known = static_cast<int64_t>(vertex_count());
  for (const int64_t corner : corners) {
    if (corner < 0 || corner > 0xFFFFFFFE) {
      return defect(place, "index",
                    "vertex index " + std::to_string(corner + base_) +
                        " is out of range: it must be at least " + std::to_string(base_) +
                        " and name one of the vertices; mend it or export the model again");
    }
  }
  if (surface_.faces.size() + (corners.size() - 2) > mesh::kMaxTriangles) {
    return fail(place, "more than " + std::to_string(mesh::kMaxTriangles) +
                           " triangles: simplify or split the model");
  }
  const int64_t greatest = *std::max_element(corners.begin(), corners.end());
  if (greatest >= known) later_.push_back({greatest, place});
  if (corners.size() > 3) polygons_.push_back({surface_.faces.size(), corners.size(), place});
  for (size_t k = 1; k + 1 < corners.size(); ++k) {
    surface_.source.push_back(static_cast<uint32_t>(surface_.faces.size()));
    if (reads_materials_) materials_.of.push_back(material_);
    surface_.faces.push_back({static_cast<uint32_t>(corners[0]), static_cast<uint32_t>(corners[k]),
                              static_cast<uint32_t>(corners[k + 1])});
  }
  return true;
}

void ImportSink::split_concave(const Polygon& polygon) {
  std::vector<uint32_t> corners{surface_.faces[polygon.first][0], surface_.faces[polygon.first][1]};
  for (size_t k = 0; k + 2 < polygon.corners; ++k)
    corners.push_back(surface_.faces[polygon.first + k][2]);
  const auto corner = [&](size_t k) {
    return to_point(surface_.vertices[corners[k % corners.size()]]) -
           to_point(surface_.vertices[corners[0]]);
  };
  Point normal{};  // Newell's, twice the area long
  double reach_m = 0;
  for (size_t k = 0; k < corners.size(); ++k) {
    normal = normal + cross(corner(k), corner(k + 1));
    reach_m = std::max(reach_m, length(corner(k)));
  }
  bool is_turned = false, is_flat = false;
  for (size_t k = 1; k + 1 < corners.size(); ++k) {
    const double along = dot(cross(corner(k), corner(k + 1)), normal);
    is_turned = is_turned || along < 0;
    is_flat = is_flat || !(along > 0);
  }
  if (!is_turned && !is_flat) return;
  // In the face's plane, on a grid of 2^28 units.
  std::vector<Face> ears;
  if (dot(normal, normal) > 0) {
    const Point n = normal * (1 / length(normal));
    const Point aside =
        cross(n, std::fabs(n.x) <= std::fabs(n.y) ? Point{1, 0, 0} : Point{0, 1, 0});
    const Point across = aside * (1 / length(aside)), up = cross(n, across);
    const double per_m = 0x1p28 / reach_m;
    Outline outline;
    for (size_t k = 0; k < corners.size(); ++k)
      outline.push_back(
          {std::llround(dot(corner(k), across) * per_m), std::llround(dot(corner(k), up) * per_m)});
    std::vector<uint32_t> sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    // An outline that runs twice along a cut to a hole passes corners twice.
    const bool has_cut = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
    if (has_cut || is_simple(outline)) ears = clip_ears({outline});
  }
  if (ears.size() + 2 == corners.size()) {
    for (size_t k = 0; k < ears.size(); ++k)
      surface_.faces[polygon.first + k] = {corners[ears[k][0]], corners[ears[k][1]],
                                           corners[ears[k][2]]};
  } else if (is_turned) {
    defect(polygon.place, "outline",
           "a face of " + std::to_string(corners.size()) +
               " corners whose outline crosses itself or is far from flat: split it into triangles "
               "in the program that made it");
  }
}

bool ImportSink::finish() {
  if (is_stopped_) return false;
  const int64_t count = static_cast<int64_t>(vertex_count());
  for (const Later& later : later_) {
    if (later.index < count) continue;
    defect(later.place, "index",
           "vertex index " + std::to_string(later.index + base_) +
               " is out of range: the file has " + std::to_string(count) +
               " vertices, counted from " + std::to_string(base_) +
               "; is it cut short? Export it again");
  }
  if (failed()) return false;
  if (count == 0) return fail("has no vertices: is it a mesh? Export it again with its geometry");
  if (surface_.faces.empty() && allows_points_) {
    for (uint32_t v = 0; v < count && v < mesh::kMaxTriangles; ++v) {
      surface_.source.push_back(v);
      surface_.faces.push_back({v, v, v});
    }
  }
  if (surface_.faces.empty())
    return fail(
        "has no faces: export it as a mesh, not as points or lines; points are taken with --wrap "
        "D");
  for (const Polygon& polygon : polygons_) split_concave(polygon);
  if (failed()) return false;
  report_rounding();
  return true;
}

// Far from the origin 32-bit coordinates are coarse. The asset then holds another surface than the
// file, by more than its certificates cover.
void ImportSink::report_rounding() {
  Point low = to_point(surface_.vertices[surface_.faces[0][0]]), high = low;
  double reach_m = 0;
  for (const Face& face : surface_.faces) {
    for (const uint32_t v : face) {
      const Point p = to_point(surface_.vertices[v]);
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      reach_m = std::max(reach_m, length(p));
    }
  }
  const double moved_m = std::min(moved_m_, reach_m * 0x1p-24);  // vertices that no face uses apart
  const double diagonal_m = length(high - low);
  if (!(moved_m > static_cast<double>(mesh::kMaxRounding) * diagonal_m)) return;
  char share[40];
  std::snprintf(share, sizeof share, "%.2g", moved_m / diagonal_m);
  const FileFrame& frame = surface_.frame;
  note("rounded coordinates to 32 bits, which moved vertices by up to " +
       frame.length_text(moved_m) + " (" + share + " of the diagonal), as they lie " +
       frame.length_text(reach_m) +
       " from the origin that the models share: answers are those of the rounded surface; where "
       "that is too much, bake it alone, or move it, as with --centre");
}

const char* known_by_content(std::string_view bytes) {
  static const struct {
    const char* start;
    const char* name;
  } kKnown[] = {
      {"ply\n", "a PLY file"},
      {"ply\r", "a PLY file"},
      {"OFF", "an OFF file"},
      {"COFF", "a COFF file"},
      {"NOFF", "a NOFF file"},
      {"STOFF", "a STOFF file"},
      {"solid", "an STL file"},
      {"PK\x03\x04", "a zip archive"},
      {"glTF", "a glTF file"},
      {"ISO-10303", "a STEP file"},
      {"%PDF", "a PDF"},
      {"\x1F\x8B", "a gzip archive"},
      {"\x89PNG", "a PNG picture"},
      {"<", "an XML or HTML page"},
      {"version https://git-lfs", "a Git LFS pointer (run `git lfs pull`)"},
      {"{", "a JSON file"},
      {"\xFF\xFE", "a UTF-16 text (save it as UTF-8)"},
      {"\xFE\xFF", "a UTF-16 text (save it as UTF-8)"},
      {"Kaydara FBX", "an FBX file"},
  };
  if (begins(bytes, "\xEF\xBB\xBF")) bytes.remove_prefix(3);
  for (const auto& known : kKnown) {
    if (begins(bytes, known.start)) return known.name;
  }
  return bytes.substr(0, 512).find('\0') != bytes.npos ? "a binary file" : nullptr;
}

}  // namespace firmtouch::tools
