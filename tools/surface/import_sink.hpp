#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

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

/// Takes what a reader finds, checks it and builds the surface. The first problem is kept; after it
/// nothing is taken.
class ImportSink {
 public:
  ImportSink(const std::string& path, double unit_m) : path_(path), unit_m_(unit_m) {}

  bool fail(const Place& place, const std::string& what);
  bool fail(const std::string& what);

  /// Coordinates in the file's unit: scaled in double, rounded once.
  bool add_vertex(const double* xyz, const Place& place);
  /// A polygon, fanned from its first corner. An index may name a vertex that comes later: finish()
  /// checks.
  bool add_polygon(const std::vector<int64_t>& corners, const Place& place);
  bool finish();
  /// Whether the format counts vertices from 0 or 1, for messages.
  void count_from(int64_t base) { base_ = base; }

  size_t vertex_count() const { return surface_.vertices.size(); }
  bool failed() const { return !problem_.empty(); }
  Surface& surface() { return surface_; }
  const std::string& problem() const { return problem_; }

 private:
  struct Later {
    int64_t index;
    Place place;
  };

  std::string path_;
  double unit_m_;
  int64_t base_ = 0;
  Surface surface_;
  std::vector<Later> later_;
  std::string problem_;
};

/// What a file is by its first bytes ("an STL file", ...), or nullptr where they do not tell.
const char* known_by_content(std::string_view bytes);

// One a format: each takes the whole file and fills the sink, whose problem says what is wrong.
void read_obj(std::string_view text, ImportSink& sink);
void read_off(std::string_view text, ImportSink& sink);
void read_ply(std::string_view bytes, ImportSink& sink);

}  // namespace firmtouch::tools
