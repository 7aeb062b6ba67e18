#include <cctype>
#include <string>

#include "surface/read/stl_facets.hpp"
#include "surface/read/text_scan.hpp"

// The text form of STL: words, whatever the lines; but a solid's name runs to the end of its line.
// Several solids in one file are read as one surface.

namespace firmtouch::tools {
namespace {

class StlText {
 public:
  StlText(std::string_view text, ImportSink& sink) : scan_(text), sink_(sink), facets_(sink) {}

  void read() {
    std::string_view word;
    uint64_t solids = 0;
    while (scan_.find_word(word)) {
      if (!is(word, "solid")) {
        sink_.fail(place(), quoted(word) + " stands where `solid` should: mend or remove it");
        return;
      }
      ++solids;
      scan_.next_line();  // past the name
      if (!read_solid()) return;
      scan_.next_line();
    }
    if (solids > 1)
      sink_.note("read " + std::to_string(solids) + " solids of the file as one surface");
    facets_.finish();
  }

 private:
  Place place() const { return {scan_.line(), 0, "facet", facets_.count()}; }

  static bool is(std::string_view word, std::string_view keyword) {
    if (word.size() != keyword.size()) return false;
    for (size_t k = 0; k < word.size(); ++k) {
      if (std::tolower(static_cast<unsigned char>(word[k])) != keyword[k]) return false;
    }
    return true;
  }

  bool next(std::string_view& word) {
    return scan_.find_word(word) ||
           sink_.fail(place(), "the file ends before `endsolid`: it is cut short; export it again");
  }

  bool expect(std::string_view keyword) {
    std::string_view word;
    if (!next(word)) return false;
    if (is(word, keyword)) return true;
    return sink_.fail(place(), quoted(word) + " stands where `" + std::string(keyword) +
                                   "` should: export the model again");
  }

  bool read_solid() {
    std::string_view word;
    for (;;) {
      if (!next(word)) return false;
      if (is(word, "endsolid")) return true;
      if (!is(word, "facet")) {
        return sink_.fail(place(), quoted(word) +
                                       " stands where `facet` or `endsolid` should: "
                                       "export the model again");
      }
      if (!read_facet()) return false;
    }
  }

  bool read_facet() {
    const Place here = place();
    Point normal, corners[3];
    if (!expect("normal") || !read_normal(normal) || !expect("outer") || !expect("loop"))
      return false;
    for (Point& corner : corners) {
      if (!expect("vertex") || !read_corner(corner)) return false;
    }
    std::string_view word;
    if (!next(word)) return false;
    if (is(word, "vertex")) {
      return sink_.fail(place(),
                        "a facet with more than three corners: STL knows triangles only; "
                        "export the model again");
    }
    if (!is(word, "endloop")) {
      return sink_.fail(place(), quoted(word) +
                                     " stands where `endloop` should: export the model "
                                     "again");
    }
    return expect("endfacet") && facets_.add(normal, corners, here);
  }

  // Programs write `nan` and worse for facets without area; the winding counts in any case.
  bool read_normal(Point& normal) {
    for (double* value : {&normal.x, &normal.y, &normal.z}) {
      std::string_view word;
      if (!next(word)) return false;
      if (is(word, "outer"))
        return sink_.fail(place(),
                          "a normal with fewer than three numbers: export the model again");
      read_number(word, *value);
    }
    return true;
  }

  bool read_corner(Point& corner) {
    for (double* value : {&corner.x, &corner.y, &corner.z}) {
      std::string_view word;
      if (!next(word)) return false;
      const char* wrong = read_number(word, *value);
      if (wrong != nullptr && !sink_.bad_word(place(), word, wrong)) return false;
    }
    return true;
  }

  TextScan scan_;
  ImportSink& sink_;
  StlFacets facets_;
};

}  // namespace

void read_stl_text(std::string_view text, ImportSink& sink) { StlText(text, sink).read(); }

}  // namespace firmtouch::tools
