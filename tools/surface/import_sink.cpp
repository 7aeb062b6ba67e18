#include "surface/import_sink.hpp"

#include "firmtouch/mesh/layout.hpp"

namespace firmtouch::tools {
namespace {

bool begins(std::string_view bytes, std::string_view with) {
  return bytes.substr(0, with.size()) == with;
}

bool is_finite(float value) { return value - value <= 0; }

}  // namespace

bool ImportSink::fail(const Place& place, const std::string& what) {
  if (failed()) return false;
  std::string where = path_;
  if (place.line != 0) where += ":" + std::to_string(place.line);
  where += ": ";
  if (place.line == 0) where += "byte " + std::to_string(place.byte) + ", ";
  if (place.element != nullptr) {
    where += place.element + (" " + std::to_string(place.index)) + " (from 0)";
  }
  if (where.size() > 2 && where.substr(where.size() - 2) == ", ") where.resize(where.size() - 2);
  if (where.substr(where.size() - 2) != ": ") where += ": ";
  problem_ = where + what;
  return false;
}

bool ImportSink::fail(const std::string& what) {
  if (!failed()) problem_ = path_ + ": " + what;
  return false;
}

bool ImportSink::add_vertex(const double* xyz, const Place& place) {
  if (failed()) return false;
  if (surface_.vertices.size() >= 0xFFFFFFF0u)
    return fail(place, "more vertices than 32 bits can number");
  const math::Vec3 v{static_cast<float>(xyz[0] * unit_m_), static_cast<float>(xyz[1] * unit_m_),
                     static_cast<float>(xyz[2] * unit_m_)};
  if (!is_finite(v.x) || !is_finite(v.y) || !is_finite(v.z)) {
    return fail(place,
                "a coordinate is not a finite 32-bit number of metres: mend the model or choose "
                "another --unit");
  }
  surface_.vertices.push_back(v);
  return true;
}

bool ImportSink::add_polygon(const std::vector<int64_t>& corners, const Place& place) {
  if (failed()) return false;
  if (corners.size() < 3) {
    return fail(place, "a face with " + std::to_string(corners.size()) +
                           " corners: a face needs at least 3; remove it");
  }
  const int64_t known = static_cast<int64_t>(vertex_count());
  for (const int64_t corner : corners) {
    if (corner < 0 || corner > 0xFFFFFFFE) {
      return fail(place, "vertex index " + std::to_string(corner + base_) +
                             " is out of range: it must be at least " + std::to_string(base_) +
                             " and name one of the vertices");
    }
    if (corner >= known) later_.push_back({corner, place});
  }
  if (surface_.faces.size() + (corners.size() - 2) > mesh::kMaxTriangles) {
    return fail(place, "more than " + std::to_string(mesh::kMaxTriangles) +
                           " triangles: simplify or split the model");
  }
  for (size_t k = 1; k + 1 < corners.size(); ++k) {
    surface_.source.push_back(static_cast<uint32_t>(surface_.faces.size()));
    surface_.faces.push_back({static_cast<uint32_t>(corners[0]), static_cast<uint32_t>(corners[k]),
                              static_cast<uint32_t>(corners[k + 1])});
  }
  return true;
}

bool ImportSink::finish() {
  if (failed()) return false;
  const int64_t count = static_cast<int64_t>(vertex_count());
  for (const Later& later : later_) {
    if (later.index < count) continue;
    return fail(later.place, "vertex index " + std::to_string(later.index + base_) +
                                 " is out of range: the file has " + std::to_string(count) +
                                 " vertices, counted from " + std::to_string(base_) +
                                 "; is it cut short?");
  }
  if (count == 0) return fail("has no vertices: is it a mesh? Export it again with its geometry");
  if (surface_.faces.empty())
    return fail("has no faces: export it as a mesh, not as points or lines");
  return true;
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
      {"PK\x03\x04", "a zip archive (3MF?)"},
      {"glTF", "a glTF file"},
      {"ISO-10303", "a STEP file"},
      {"%PDF", "a PDF"},
      {"\x1F\x8B", "a gzip archive"},
      {"\x89PNG", "a PNG picture"},
      {"<", "an XML or HTML page"},
      {"version https://git-lfs", "a Git LFS pointer (run `git lfs pull`)"},
      {"{", "a JSON file"},
      {"Kaydara FBX", "an FBX file"},
  };
  if (begins(bytes, "\xEF\xBB\xBF")) bytes.remove_prefix(3);
  for (const auto& known : kKnown) {
    if (begins(bytes, known.start)) return known.name;
  }
  return bytes.substr(0, 512).find('\0') != bytes.npos ? "a binary file" : nullptr;
}

}  // namespace firmtouch::tools
