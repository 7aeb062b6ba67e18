#include "firmtouch/mesh/layout.hpp"
#include "surface/read/import_sink.hpp"
#include "surface/read/text_scan.hpp"

// Wavefront OBJ: `v x y z [w or colours]` and `f a b c ...`, where a corner is a, a/b, a//c or
// a/b/c and a negative index counts back from the last vertex read. All else that OBJ knows is
// passed over; what it does not know is refused, since a damaged `v` would shift every index after
// it.

namespace firmtouch::tools {
namespace {

constexpr std::string_view kPassedOver[] = {
    "vt",   "vn",         "vp",        "g",      "o",      "s",      "usemtl",   "mtllib",
    "l",    "p",          "mg",        "usemap", "maplib", "bevel",  "c_interp", "d_interp",
    "lod",  "shadow_obj", "trace_obj", "ctech",  "stech",  "cstype", "deg",      "bmat",
    "step", "curv2",      "parm",      "trim",   "hole",   "scrv",   "sp",       "end",
    "con",  "call",       "csh",       "maplib"};

bool is_passed_over(std::string_view word) {
  for (const std::string_view known : kPassedOver) {
    if (word == known) return true;
  }
  return false;
}

// What changes a shape and is not read, for a note.
struct PassedOver {
  uint64_t count = 0, first_line = 0;

  void add(uint64_t line) {
    if (count++ == 0) first_line = line;
  }
  void report(ImportSink& sink, const std::string& what) const {
    if (count != 0)
      sink.note("passed over " + what + ": " + std::to_string(count) + ", first at line " +
                std::to_string(first_line));
  }
};

// `weights`: w other than 1. Of a face's corner it has no meaning.
bool read_vertex(TextScan& scan, ImportSink& sink, PassedOver& weights) {
  double xyz[3] = {};
  for (int k = 0; k < 3; ++k) {
    std::string_view word;
    if (!scan.next_word(word)) {
      sink.defect({scan.line()}, "short vertex",
                  "a vertex with fewer than three coordinates: is the file cut short? Export the "
                  "model again");
      break;
    }
    const char* wrong = read_number(word, xyz[k]);
    if (wrong != nullptr) sink.bad_word({scan.line()}, word, wrong);
  }
  std::string_view fourth, colour;
  double w = 1;
  if (scan.next_word(fourth) && !scan.next_word(colour) && read_number(fourth, w) == nullptr &&
      (w < 1 || w > 1))
    weights.add(scan.line());
  return sink.add_vertex(xyz, {scan.line()});
}

bool read_face(TextScan& scan, ImportSink& sink, std::vector<int64_t>& corners) {
  corners.clear();
  const int64_t count = static_cast<int64_t>(sink.vertex_count());
  std::string_view word;
  while (scan.next_word(word)) {
    int64_t index = 0;
    const char* wrong = read_integer(word.substr(0, word.find('/')), index);
    const Place place{scan.line()};
    if (wrong != nullptr) return sink.bad_word(place, word, wrong);
    if (index == 0) {
      return sink.defect(place, "index",
                         "vertex index 0: OBJ counts from 1; add 1 to every index of the faces");
    }
    if (index < -count) {
      return sink.defect(place, "index",
                         "vertex index " + std::to_string(index) +
                             " reaches back before the first of " + std::to_string(count) +
                             " vertices: mend it or export the model again");
    }
    if (corners.size() > mesh::kMaxTriangles + 1)
      return sink.fail(place, "a face with more corners than an asset has triangles: split it");
    corners.push_back(index > 0 ? index - 1 : count + index);
  }
  return sink.add_polygon(corners, {scan.line()});
}

// Which word begins a material: a file without `usemtl` has groups.
std::string_view material_word(std::string_view text, const ImportSink& sink) {
  TextScan scan(text);
  std::string_view word;
  while (sink.reads_materials() && scan.next_line())
    if (scan.next_word(word) && word == "usemtl") return "usemtl";
  return "g";
}

// A group without a name, which OBJ calls `default`, has no material; of several groups the first
// has. Exporters write names of materials with blanks: they become _.
bool read_material(TextScan& scan, std::string_view keyword, ImportSink& sink) {
  std::string name;
  std::string_view word;
  while (scan.next_word(word) && (name.empty() || keyword != "g"))
    name += (name.empty() ? "" : "_") + std::string(word);
  sink.use_material(name);
  return !name.empty() || keyword == "g" ||
         sink.defect({scan.line()}, "usemtl", "usemtl without the name of a material: add one");
}

}  // namespace

void read_obj(std::string_view text, ImportSink& sink) {
  const char* other = known_by_content(text);
  if (other != nullptr) {
    sink.fail(std::string("is ") + other +
              " by its content, not OBJ: rename it, or export the model as OBJ");
    return;
  }
  sink.count_from(1);
  TextScan scan(text);
  const std::string_view of_material = material_word(text, sink);
  std::vector<int64_t> corners;
  PassedOver weights, free_forms;
  std::string_view word;
  while (scan.next_line()) {
    if (!scan.next_word(word)) continue;
    bool going_on = true;
    if (word == "v") {
      going_on = read_vertex(scan, sink, weights);
    } else if (word == "f" || word == "fo") {
      going_on = read_face(scan, sink, corners);
    } else if (sink.reads_materials() && word == of_material) {
      going_on = read_material(scan, word, sink);
    } else if (word == "curv" || word == "surf") {
      free_forms.add(scan.line());
    } else if (!is_passed_over(word)) {
      going_on = sink.defect({scan.line()}, "keyword",
                             quoted(word) +
                                 " is no keyword of OBJ: is the file damaged, or of another "
                                 "format? Export the model again");
    }
    if (!going_on) return;
    while (scan.next_word(word)) continue;  // a backslash continues what is passed over, too
  }
  weights.report(sink, "weights of vertices, which only free-form elements have");
  free_forms.report(sink,
                    "free-form elements `curv` and `surf` (export them as faces to have them)");
}

}  // namespace firmtouch::tools
