#include "firmtouch/mesh/layout.hpp"
#include "surface/read/import_sink.hpp"
#include "surface/read/text_scan.hpp"

// OFF, COFF, NOFF, STOFF and their joins: the word, the counts of vertices, faces and edges, the
// vertices, the faces. Numbers after the third of a vertex's line and after the corners of a face's
// line are colours and passed over.

namespace firmtouch::tools {
namespace {

bool read_header(TextScan& scan, std::string_view text, ImportSink& sink) {
  std::string_view word;
  if (!scan.find_word(word)) return sink.fail("holds no text: export the model again");
  std::string_view kind = word;  // colours, normals and textures follow the coordinates
  for (const std::string_view what : {"ST", "C", "N"})
    if (kind.substr(0, what.size()) == what) kind.remove_prefix(what.size());
  if (kind != "OFF") {
    if (word.size() > 3 && word.size() <= 8 && word.substr(word.size() - 3) == "OFF") {
      return sink.fail(
          {scan.line()},
          quoted(word) + " files have other than three coordinates: export as plain OFF");
    }
    const char* other = known_by_content(text);
    if (other != nullptr)
      return sink.fail(std::string("is ") + other +
                       " by its content, not OFF: rename or export it");
    return sink.fail({scan.line()},
                     quoted(word) + " stands where the word OFF should: is this an OFF file?");
  }
  return true;
}

bool read_count(TextScan& scan, ImportSink& sink, const char* what, int64_t& count) {
  std::string_view word;
  if (!scan.find_word(word))
    return sink.fail({scan.line()}, std::string("ends before the number of ") + what);
  if (word == "BINARY")
    return sink.fail({scan.line()}, "binary OFF is not read: export the model as text");
  const char* wrong = read_integer(word, count);
  if (wrong != nullptr || count < 0) {
    return sink.fail({scan.line()}, quoted(word) + " is no number of " + what);
  }
  return true;
}

// The next word of element `i`, which `place` then names.
bool find_word_of(TextScan& scan, ImportSink& sink, const char* what, int64_t i, int64_t count,
                  std::string_view& word, Place& place) {
  const bool found = scan.find_word(word);
  place = {scan.line(), 0, what, static_cast<uint64_t>(i)};
  if (found) return true;
  const std::string all = std::to_string(count) + (*what == 'v' ? " vertices" : " faces");
  return sink.fail(place,
                   "the file ends here; it states " + all + ": it is cut short, export it again");
}

bool read_vertices(TextScan& scan, ImportSink& sink, int64_t count) {
  for (int64_t i = 0; i < count; ++i) {
    double xyz[3] = {};
    Place place;
    for (int k = 0; k < 3; ++k) {
      std::string_view word;
      if (!find_word_of(scan, sink, "vertex", i, count, word, place)) return false;
      const char* wrong = read_number(word, xyz[k]);
      if (wrong != nullptr) sink.bad_word(place, word, wrong);
    }
    if (!sink.add_vertex(xyz, place)) return false;
    scan.next_line();
  }
  return true;
}

bool read_faces(TextScan& scan, ImportSink& sink, int64_t count) {
  std::vector<int64_t> corners;
  for (int64_t i = 0; i < count; ++i) {
    corners.clear();
    int64_t wanted = 1;  // the count itself first
    Place place;
    for (int64_t k = 0; k <= wanted; ++k) {
      std::string_view word;
      if (!find_word_of(scan, sink, "face", i, count, word, place)) return false;
      int64_t value = 0;
      const char* wrong = read_integer(word, value);
      if (wrong != nullptr) {
        sink.bad_word(place, word, wrong);
        break;  // the rest of the line is passed over
      }
      if (k > 0) {
        corners.push_back(value);
      } else if (value < 3) {
        sink.defect(place, "corners",
                    "a face with " + std::to_string(value) +
                        " corners: a face needs at least 3; remove it");
        break;
      } else if (value > int64_t{mesh::kMaxTriangles} + 2) {
        return sink.fail(place, "a face with " + std::to_string(value) +
                                    " corners, more than an asset has triangles: split it");
      } else {
        wanted = value;
      }
    }
    const bool is_whole = static_cast<int64_t>(corners.size()) == wanted;
    if (is_whole && wanted >= 3 && !sink.add_polygon(corners, place)) return false;
    scan.next_line();
  }
  return true;
}

}  // namespace

void read_off(std::string_view text, ImportSink& sink) {
  TextScan scan(text);
  int64_t vertices = 0, faces = 0, edges = 0;
  if (!read_header(scan, text, sink) || !read_count(scan, sink, "vertices", vertices) ||
      !read_count(scan, sink, "faces", faces) || !read_count(scan, sink, "edges", edges)) {
    return;
  }
  scan.next_line();
  if (!read_vertices(scan, sink, vertices) || !read_faces(scan, sink, faces)) return;
  std::string_view word;
  if (scan.find_word(word)) {
    sink.fail({scan.line()}, quoted(word) + " comes after the last of " + std::to_string(faces) +
                                 " faces: the counts at the top are too small; mend them");
  }
}

}  // namespace firmtouch::tools
