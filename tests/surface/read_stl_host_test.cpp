// STL in all its shapes: what is taken, welded, noted and refused.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

#include "formats.hpp"
#include "shapes.hpp"
#include "surface/check/check.hpp"
#include "surface/make/make_part.hpp"
#include "surface/read/read_surface.hpp"
#include "surface/read/weld.hpp"

namespace firmtouch::tools {
namespace {

Imported read(const std::string& bytes) { return read_surface_bytes(bytes, "a.stl", 1); }

// The corners of every face, whatever the numbers of the vertices.
std::vector<std::array<math::Vec3, 3>> corners_of(const Surface& surface) {
  std::vector<std::array<math::Vec3, 3>> corners;
  for (const Face& f : surface.faces)
    corners.push_back({surface.vertices[f[0]], surface.vertices[f[1]], surface.vertices[f[2]]});
  return corners;
}

bool same_place(const math::Vec3& a, const math::Vec3& b) {
  return !(a.x < b.x || a.x > b.x || a.y < b.y || a.y > b.y || a.z < b.z || a.z > b.z);
}

bool same_corners(const Surface& a, const Surface& b) {
  const auto p = corners_of(a), q = corners_of(b);
  return p.size() == q.size() &&
         std::equal(p.begin(), p.end(), q.begin(), [](const auto& s, const auto& t) {
           return same_place(s[0], t[0]) && same_place(s[1], t[1]) && same_place(s[2], t[2]);
         });
}

bool reads_cube(const std::string& bytes, size_t notes = 0) {
  const Imported got = read(bytes);
  if (!got.problem.empty()) std::printf("  %s\n", got.problem.c_str());
  for (const std::string& note : got.notes) std::printf("  note: %s\n", note.c_str());
  return got.problem.empty() && got.notes.size() == notes && got.surface.vertices.size() == 8 &&
         same_corners(got.surface, cube()) && got.surface.source == cube().source &&
         is_closed_and_alike(got.surface);
}

bool refuses(const std::string& bytes, const char* place, const char* what) {
  const std::string problem = read(bytes).problem;
  const bool good = says(problem, "a.stl:") && says(problem, place) && says(problem, what);
  if (!good) std::printf("  wanted `%s` and `%s`, got: %s\n", place, what, problem.c_str());
  return good;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string with_float(std::string bytes, size_t at, float value) {
  Bytes four(false);
  four.put(value);
  return bytes.replace(at, 4, four.text);
}

// Every face with vertices of its own, as STL has them.
Surface torn(const Surface& from) {
  Surface soup;
  for (const auto& corners : corners_of(from)) {
    const uint32_t v = static_cast<uint32_t>(soup.vertices.size());
    soup.source.push_back(v / 3);
    soup.faces.push_back({v, v + 1, v + 2});
    for (const math::Vec3& corner : corners) soup.vertices.push_back(corner);
  }
  return soup;
}

}  // namespace

TEST(StlTextIsReadHoweverItIsWritten) {
  CHECK(reads_cube(cube_stl_text()));
  CHECK(reads_cube(cube_stl_text("", "\r\n")));
  CHECK(reads_cube(cube_stl_text("C:\\parts\\", "\r")));  // no line is continued there
  CHECK(reads_cube(cube_stl_text("#1 facet endsolid")));
  CHECK(reads_cube("\xEF\xBB\xBF\n  " + cube_stl_text("", " \n\n\t")));
  std::string shouted = cube_stl_text("");
  for (char& c : shouted) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  CHECK(reads_cube(shouted));
  std::string text = cube_stl_text();
  text.pop_back();
  CHECK(reads_cube(text));
  std::string one_line = cube_stl_text("", " ");
  CHECK(reads_cube(one_line.insert(6, "\n")));  // STL has words, not lines
}

TEST(StlBinaryIsReadWhateverItsHeaderHolds) {
  for (const char* header : {"", "solid cube", "ply\nformat ascii 1.0\n", "OFF 8 6 12\n", "<html>",
                             "facet normal 0 0 1", "v 0 0 0\nf 1 2 3\n"}) {
    CHECK(reads_cube(cube_stl_binary(header)));
  }
  CHECK(reads_cube(cube_stl_binary(std::string(80, '\xFF'))));
  CHECK(reads_cube(cube_stl_binary("solid " + cube_stl_text())));
  CHECK(reads_cube(cube_stl_binary(std::string(80, ' '))));
}

// Whatever the number of facets is, the facets themselves are no text.
TEST(StlBinaryOfAWrongNumber_IsNoText) {
  std::string bytes = cube_stl_binary("solid cube");
  bytes.replace(0, 84, "solid" + std::string(75, ' ') + std::string(4, '\xFF'));
  CHECK(refuses(bytes, "byte 80", "the header states 4294967295 facets"));
}

TEST(StlAttributesAreCountedAndPassedOver) {
  CHECK(reads_cube(cube_stl_binary("COLOR=\x10\x20\x30\xFF", 0x7C1F), 1));
  CHECK(says(read(cube_stl_binary("", 0x8000)).notes, "attribute bytes (colours) of 12 of 12"));
}

TEST(SeveralSolidsAreOneSurface) {
  std::string second = cube_stl_text("two");
  for (size_t at = 0; (at = second.find("vertex ", at)) != second.npos; ++at)
    second.insert(at + 7, "1");  // 1 becomes 11, -1 becomes 1-1: mended below
  for (size_t at = 0; (at = second.find("1-1", at)) != second.npos;) second.replace(at, 3, "9");
  const Imported got = read(cube_stl_text("one") + second);
  CHECK(got.problem.empty() && got.surface.faces.size() == 24 && got.surface.vertices.size() == 16);
  CHECK(says(got.notes, "read 2 solids of the file as one surface"));
  CHECK(is_closed_and_alike(got.surface));
}

TEST(StlNormalsDoNotCountButAreCompared) {
  const char* turned_note = "of 12 facets 1 have one opposite to the winding";
  const Imported opposite = read(replaced(cube_stl_text(), "normal 0 0 1", "normal 0 0 -1"));
  CHECK(says(opposite.notes, turned_note) && says(opposite.notes, "first facet 2 (from 0)"));
  CHECK(same_corners(opposite.surface, cube()));
  CHECK(says(read(replaced(cube_stl_text(), "normal 0 0 1", "normal 1 0 0")).notes,
             "0 have one opposite to the winding of their corners, 1 one more than 60 degrees"));
  CHECK(says(read(with_float(cube_stl_binary(), 84 + 2 * 50 + 8, -1)).notes, turned_note));
  // None at all, of another length, and what programs write where there is no direction.
  for (const char* normal : {"0 0 0", "0 0 1e-30", "0 0 1e30", "nan nan nan", "-nan(ind) 0 inf"})
    CHECK(reads_cube(replaced(cube_stl_text(), "normal 0 0 1", std::string("normal ") + normal)));
  CHECK(reads_cube(with_float(cube_stl_binary(), 84 + 4, std::numeric_limits<float>::quiet_NaN())));
}

TEST(CornersAreWeldedWhereTheyAreExactlyEqual) {
  const Surface part = make_part(2, 2000);
  Surface welded = torn(part);
  weld_corners(welded);
  CHECK_EQ(welded.vertices.size(), part.vertices.size());
  CHECK(same_corners(welded, part) && is_closed_and_alike(welded));
  // One unit in the last place apart is apart; -0 and 0 are one place.
  Surface torn_cube = torn(cube());
  torn_cube.vertices[0].x = std::nextafter(torn_cube.vertices[0].x, 0.0f);
  weld_corners(torn_cube);
  CHECK_EQ(torn_cube.vertices.size(), 9u);
  Surface zero = torn(tetrahedron());
  for (math::Vec3& v : zero.vertices) {
    if (!(v.x > 0) && (&v - zero.vertices.data()) % 2 == 0) v.x = -0.0f;
  }
  weld_corners(zero);
  CHECK_EQ(zero.vertices.size(), 4u);
}

TEST(TheCheckTakesWhatStlCannotSay) {
  // A facet of no area (its corners on a line) and one whose corners fall together.
  const std::string flat =
      "facet normal 0 0 0\nouter loop\nvertex -1 -1 -1\nvertex 1 -1 -1\nvertex 1 -1 -1\n"
      "endloop\nendfacet\nendsolid";
  Imported got = read(replaced(cube_stl_text(), "endsolid", flat));
  CHECK(got.problem.empty() && got.surface.faces.size() == 13);
  const CheckReport report = check_and_mend(got.surface, {});
  CHECK(report.usable() && says(report.mended, "dropped 1 face that names a vertex twice"));
  CHECK(got.surface.faces.size() == 12 && is_closed_and_alike(got.surface));
}

TEST(StlTextProblemsAreNamedWithTheirLine) {
  const std::string text = cube_stl_text();
  CHECK(refuses(text.substr(0, text.find("endsolid")), ":85: facet 12", "cut short"));
  CHECK(refuses(text.substr(0, text.find("endloop")), ":7: facet 0", "cut short"));
  CHECK(refuses(replaced(text, "vertex -1 1 -1", "vertex -1 nan -1"), ":5: facet 0",
                "`nan` is not finite"));
  CHECK(refuses(replaced(text, "vertex -1 1 -1", "vertex -1,0 1,0 -1"), ":5: facet 0",
                "write decimals with a point"));
  CHECK(refuses(replaced(text, "vertex -1 1 -1", "vertex -1 1"), ":6: facet 0",
                "`vertex` is not a number"));
  CHECK(refuses(replaced(text, "vertex -1 1 -1", "vertex 1e39 1 1"), ":2: facet 0",
                "not a finite 32-bit"));
  CHECK(refuses(replaced(text, "endloop", "vertex 0 0 0\nendloop"), ":7: facet 0",
                "more than three corners"));
  CHECK(refuses(replaced(text, "0 0 -1\n", "0 0\n"), ":3: facet 0", "fewer than three numbers"));
  CHECK(refuses(replaced(text, "outer", "inner"), ":3: facet 0", "`inner` stands where `outer`"));
  CHECK(refuses(replaced(text, "endfacet", "facet"), ":8: facet 0", "where `endfacet` should"));
  CHECK(refuses(text + "facet", ":87: facet 12", "`facet` stands where `solid` should"));
  CHECK(refuses("solid\nendsolid\n", "", "no vertices"));
  CHECK(refuses("solid", ":1: facet 0", "cut short"));
}

TEST(StlBinaryProblemsAreNamedWithTheirByte) {
  const std::string bytes = cube_stl_binary();
  for (const char* header : {"", "solid"}) {
    const std::string whole = cube_stl_binary(header);
    CHECK(refuses(whole.substr(0, whole.size() - 1), " byte 80:",
                  "12 facets, 684 bytes in all, but the file has 683: it holds 11 whole"));
    CHECK(refuses(whole.substr(0, 84), " byte 80:", "it holds 0 whole facets"));
    CHECK(refuses(whole + "x", " byte 80:", "1 bytes too many"));
    CHECK(refuses(whole.substr(0, 83), "", "these are 83"));
  }
  std::string wrong_count = bytes;
  wrong_count[80] = 11;
  CHECK(refuses(wrong_count, " byte 80:", "50 bytes too many"));
  wrong_count[80] = 0;
  CHECK(refuses(wrong_count, " byte 80:", "600 bytes too many"));
  wrong_count.replace(80, 4, "\xFF\xFF\xFF\xFF");
  CHECK(refuses(wrong_count, " byte 80:", "states 4294967295 facets"));
  CHECK(refuses(bytes.substr(0, 80) + std::string(4, '\0'), "", "no vertices"));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  CHECK(refuses(with_float(bytes, 84 + 50 * 3 + 16, nan),
                " byte 234, facet 3 (from 0):", "not a finite 32-bit number of metres"));
  CHECK(refuses(with_float(with_float(bytes, 84 + 12, nan), 84 + 50 * 3 + 16, nan),
                "(2 times, last at facet 3 (from 0), byte 234)", "not a finite"));
  CHECK(refuses(cube_obj(), "", "states"));
  CHECK(refuses(cube_ply_ascii(), "", "is a PLY file by its content, not STL"));
  CHECK(refuses("v 0 0 0\n", "", "neither begins with the word `solid`"));
}

}  // namespace firmtouch::tools
