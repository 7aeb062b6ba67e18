#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "surface/read/read_surface.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// Where in a file: a line of a text, or a byte of a binary, and in either an element where it
/// helps.
struct Place {
  uint64_t line = 0;  // from 1; 0: there are no lines, `byte` counts
  uint64_t byte = 0;
  const char* element = nullptr;  // "vertex", "face"; lives for ever
  uint64_t index = 0;             // of that element, from 0
};

/// Takes what a reader finds, checks it and builds the surface. The first problem is kept and its
/// like are counted, so that the message says how often; after fail() nothing is taken.
class ImportSink {
 public:
  ImportSink(const std::string& path, const FileFrame& frame) : path_(path) {
    surface_.frame = frame;
  }

  /// Reading cannot go on. Result: false.
  bool fail(const Place& place, const std::string& what);
  bool fail(const std::string& what);
  /// The file is refused, but reading goes on, to count. `kind`: what its like have in common.
  /// Result: true, but false after fail().
  bool defect(const Place& place, std::string_view kind, const std::string& what);
  /// A word that read_number() or read_integer() found `wrong`.
  bool bad_word(const Place& place, std::string_view word, const char* wrong);
  /// A remark for the report of a bake; the surface is accepted.
  void note(const std::string& what) { notes_.push_back(what); }

  /// The unit that a file states; one that the user gave counts instead.
  void take_unit(double unit_m, const char* name) { surface_.frame.take_unit(unit_m, name); }
  /// Points without faces are taken too: each becomes a face of one vertex, for wrapping.
  void allow_points() { allows_points_ = true; }
  bool allows_points() const { return allows_points_; }
  void read_materials() { reads_materials_ = true; }
  bool reads_materials() const { return reads_materials_; }
  /// Of the polygons that follow; "": of none.
  void use_material(std::string_view name);
  /// The same by a number: of a file whose materials have no names.
  void use_material(uint32_t number) { material_ = number; }
  /// The folder of the file with its separator, or empty.
  std::string folder() const { return path_.substr(0, path_.find_last_of("/\\") + 1); }

  /// Coordinates in the file's unit: placed in double, rounded once. A vertex that is refused still
  /// counts, so that indices stay right.
  bool add_vertex(const double* xyz, const Place& place);
  /// A polygon, fanned from its first corner; where a triangle of the fan would be turned over or
  /// flat, because the outline is concave, split by clip_ears(). An index may name a vertex that
  /// comes later: finish() checks and splits.
  bool add_polygon(const std::vector<int64_t>& corners, const Place& place);
  bool finish();
  /// Whether the format counts vertices from 0 or 1, for messages.
  void count_from(int64_t base) { base_ = base; }

  size_t vertex_count() const { return surface_.vertices.size(); }
  bool failed() const { return !problem_.empty(); }
  Surface& surface() { return surface_; }
  const std::vector<std::string>& notes() const { return notes_; }
  const FileMaterials& materials() const { return materials_; }
  /// The first problem, and how often; empty where there is none.
  std::string problem() const;

 private:
  struct Later {
    int64_t index;
    Place place;
  };

  struct Polygon {
    size_t first;  // of its triangles
    size_t corners;
    Place place;
  };

  std::string where(const Place& place) const;
  void split_concave(const Polygon& polygon);
  void report_rounding();

  std::string path_;
  int64_t base_ = 0;
  Surface surface_;
  std::vector<Later> later_;
  std::vector<Polygon> polygons_;  // of more than three corners
  std::vector<std::string> notes_;
  double moved_m_ = 0;  // by the rounding to float, at most
  bool is_stopped_ = false, allows_points_ = false, reads_materials_ = false;
  FileMaterials materials_;
  uint32_t material_ = 0;       // of the polygons that follow
  std::string problem_, kind_;  // the first one
  uint64_t times_ = 0, others_ = 0;
  Place first_, last_;
};

/// "`word`", cut short where it is long.
std::string quoted(std::string_view word);

/// What a file is by its first bytes ("an STL file", ...), or nullptr if unknown.
const char* known_by_content(std::string_view bytes);

// One a format: each takes the whole file and fills the sink, whose problem says what is wrong.
void read_obj(std::string_view text, ImportSink& sink);
void read_off(std::string_view text, ImportSink& sink);
void read_ply(std::string_view bytes, ImportSink& sink);
void read_stl(std::string_view bytes, ImportSink& sink);
void read_gltf(std::string_view bytes, ImportSink& sink);
void read_3mf(std::string_view bytes, ImportSink& sink);

}  // namespace firmtouch::tools
