#include <cstdio>

#include "formats.hpp"
#include "shapes.hpp"
#include "surface/make/make_part.hpp"
#include "surface/read/read_surface.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::tools {
namespace {

bool reads_cube(const std::string& bytes, const char* name) {
  const Imported read = read_surface_bytes(bytes, name, 1);
  if (!read.problem.empty()) std::printf("  %s\n", read.problem.c_str());
  return read.problem.empty() && same(read.surface, cube());
}

bool refuses(const std::string& bytes, const char* name, const char* place, const char* what) {
  const std::string problem = read_surface_bytes(bytes, name, 1).problem;
  const bool good = says(problem, name) && says(problem, place) && says(problem, what);
  if (!good) std::printf("  wanted `%s` and `%s`, got: %s\n", place, what, problem.c_str());
  return good;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST(ObjIsReadHoweverItIsWritten) {
  CHECK(reads_cube(cube_obj(), "a.obj"));
  CHECK(reads_cube(cube_obj("", "\r\n", [](int v) { return std::to_string(v + 1); }), "A.B.OBJ"));
  CHECK(reads_cube(cube_obj("", "\r", [](int v) { return std::to_string(v + 1); }), "a.obj"));
  CHECK(reads_cube(cube_obj("\t1.0", "\n", [](int v) { return std::to_string(v - 8); }), "a.obj"));
  CHECK(reads_cube(
      cube_obj(" 0.1 0.2 0.3", " \n", [](int v) { return std::to_string(v + 1) + "/1/1"; }),
      "a.obj"));
  CHECK(reads_cube(cube_obj(" # here", "\n", [](int v) { return std::to_string(v + 1) + "//1"; }),
                   "a.obj"));
  CHECK(reads_cube(
      cube_obj("", "\n", [](int v) { return "\\\n +" + std::to_string(v + 1) + "/1"; }), "a.obj"));
  CHECK(reads_cube(
      "l 1 2 \\\n 3\n" + cube_obj(" 1 0 \\\n 0", "\n", [](int v) { return std::to_string(v + 1); }),
      "a.obj"));  // in what is passed over
  std::string text = cube_obj();
  text.pop_back();
  CHECK(reads_cube("\xEF\xBB\xBF\n\n" + text, "a.obj"));
  const size_t faces = text.find("f ");
  CHECK(reads_cube(text.substr(faces) + "\n" + text.substr(0, faces), "a.obj"));  // faces first
}

TEST(OffIsReadHoweverItIsWritten) {
  CHECK(reads_cube(cube_off(), "a.off"));
  CHECK(reads_cube(cube_off("OFF 8 6 12\r\n", "\r\n", "\r\n"), "a.Off"));
  CHECK(reads_cube(
      cube_off("# a cube\nOFF\n# counts\n8 6\n12 # edges\n\n", " 0.5 0.5 0.5\n", "\t255 0 0\n"),
      "a.off"));
  std::string text = cube_off();
  text.pop_back();
  CHECK(reads_cube(text, "a.off"));
}

TEST(PlyIsReadInEveryFormatAndOrder) {
  CHECK(reads_cube(cube_ply_ascii(), "a.ply"));
  CHECK(reads_cube(replaced(cube_ply_ascii(), "uchar int vertex_indices", "uint int8 vertex_index"),
                   "a.PLY"));
  CHECK(reads_cube(cube_ply_binary(false), "a.ply"));
  CHECK(reads_cube(cube_ply_binary(true), "a.ply"));
}

TEST(CoordinatesAreScaledInDoubleAndRoundedOnce) {
  const std::string text = "v 0.1 25.4 1e-3\nv 16777217 3 1e-400\nv 1 -0 7.0000001\nf 1 2 3\n";
  const Imported read = read_surface_bytes(text, "a.obj", 0.0254);
  CHECK(read.problem.empty());
  const double wanted[3][3] = {{0.1, 25.4, 1e-3}, {16777217, 3, 0}, {1, 0, 7.0000001}};
  for (size_t v = 0; v < 3 && read.surface.vertices.size() == 3; ++v) {
    const math::Vec3 got = read.surface.vertices[v];
    CHECK(!(got.x < static_cast<float>(wanted[v][0] * 0.0254) ||
            got.x > static_cast<float>(wanted[v][0] * 0.0254)));
    CHECK(!(got.y < static_cast<float>(wanted[v][1] * 0.0254) ||
            got.y > static_cast<float>(wanted[v][1] * 0.0254)));
    CHECK(!(got.z < static_cast<float>(wanted[v][2] * 0.0254) ||
            got.z > static_cast<float>(wanted[v][2] * 0.0254)));
  }
}

TEST(WhatIsWrittenIsReadBackBitForBit) {
  const Surface part = make_part(3, 2000);
  const Imported read = read_surface_bytes(to_obj(part), "part.obj", 1);
  CHECK(read.problem.empty());
  CHECK(same(read.surface, part));
}

TEST(ObjProblemsAreNamedWithTheirLine) {
  CHECK(refuses("", "a.obj", "", "empty"));
  CHECK(refuses("# nothing\n", "a.obj", "", "no vertices"));
  CHECK(refuses("v 0 0 0\nv 1 0 0\n", "a.obj", "", "no faces"));
  CHECK(refuses("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "a.obj",
                ":4:", "index 9 is out of range: the file has 3"));
  CHECK(refuses("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "a.obj", ":4:", "index -4 reaches back"));
  CHECK(refuses("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "a.obj", ":4:", "OBJ counts from 1"));
  CHECK(refuses("v 0 0 0\nv 1 0 0\nf 1 2\n", "a.obj", ":3:", "2 corners"));
  CHECK(refuses("v 0 0 nan\n", "a.obj", ":1:", "`nan` is not finite"));
  CHECK(refuses("v 0 0 0\r\n\r\nv 0 0 x\r\n", "a.obj", ":3:", "`x` is not a number"));
  CHECK(refuses("v 0 0 0\nv -inf 0 0\n", "a.obj", ":2:", "not finite"));
  CHECK(refuses("v 0 0 1e39\n", "a.obj", ":1:", "not a finite 32-bit"));
  CHECK(refuses("v 0 0 1e999\n", "a.obj", ":1:", "too large"));
  CHECK(refuses("v 0,5 0 0\n", "a.obj", ":1:", "with a point"));
  CHECK(refuses("v 0 0x1 0\n", "a.obj", ":1:", "is not a number"));
  CHECK(refuses("v 0 0\n", "a.obj", ":1:", "fewer than three"));
  CHECK(refuses("v 0 0 0\nf 1 b 2\n", "a.obj", ":2:", "`b` is not a whole number"));
  CHECK(refuses("v 0 0 0\nf 1 2 99999999999999999999\n", "a.obj", ":2:", "too large for an index"));
  CHECK(refuses("v 0 0 0\nw 0 0 0\n", "a.obj", ":2:", "no keyword"));
  CHECK(refuses(cube_off(), "a.obj", "", "is an OFF file by its content"));
  CHECK(refuses("solid thing\n", "a.obj", "", "an STL file"));
  CHECK(refuses(std::string("v 0 0 0\n\0\0", 10), "a.obj", "", "a binary file"));
  CHECK(refuses("x", "a.stp", "", "is STEP"));
  CHECK(refuses("x", "dir.obj/mesh", "", "no extension of a mesh"));
}

TEST(OffProblemsAreNamedWithTheirLine) {
  CHECK(refuses("\n", "a.off", "", "no text"));
  CHECK(refuses("8 6 12\n", "a.off", ":1:", "the word OFF"));
  CHECK(refuses(cube_off("4OFF\n8 6 12\n"), "a.off", ":1:", "other than three coordinates"));
  CHECK(refuses("OFF BINARY\n", "a.off", ":1:", "binary OFF"));
  CHECK(refuses("OFF 8 -6 12\n", "a.off", ":1:", "no number of faces"));
  CHECK(refuses(cube_off("OFF\n9 6 12\n"), "a.off", ":16: ", "the file ends here"));
  CHECK(refuses(cube_off("OFF\n8 7 12\n"), "a.off", "face 6 (from 0)", "the file ends here"));
  CHECK(refuses(cube_off("OFF\n8 5 12\n"), "a.off", ":16:", "counts at the top are too small"));
  CHECK(refuses(replaced(cube_off(), "\n1 -1 -1", "\n1 x -1"), "a.off", ":4: vertex 1",
                "`x` is not a number"));
  CHECK(refuses(replaced(cube_off(), "4 0 2 3 1", "2 0 2"), "a.off", ":11: face 0", "2 corners"));
  CHECK(refuses(replaced(cube_off(), "4 0 2 3 1", "4 0 2 8 1"), "a.off", ":11: face 0",
                "index 8 is out of range"));
  CHECK(refuses(replaced(cube_off(), "4 0 2 3 1", "4 0 2 -3 1"), "a.off", ":11: face 0",
                "out of range"));
  CHECK(refuses(cube_ply_ascii(), "a.off", "", "a PLY file by its content"));
}

TEST(PlyProblemsAreNamedWithTheirPlace) {
  const std::string ascii = cube_ply_ascii(), binary = cube_ply_binary(false);
  CHECK(refuses(cube_obj(), "a.ply", "", "does not begin with the line `ply`"));
  CHECK(refuses(ascii.substr(0, ascii.find("property")), "a.ply", ":4:", "no `end_header`"));
  CHECK(refuses(replaced(ascii, "face 6", "face 5"), "a.ply", ":", "goes on after"));
  CHECK(refuses(binary + "abcd", "a.ply", "byte", "goes on after"));
  CHECK(reads_cube(binary + "\r\n", "a.ply"));
  CHECK(refuses(replaced(ascii, "ascii 1.0", "ebcdic 1.0"), "a.ply", ":2:", "no format of PLY"));
  CHECK(refuses(replaced(ascii, "property double x", "property quad x"), "a.ply",
                ":5:", "`quad` is no type"));
  CHECK(refuses(replaced(ascii, "float z", "float w"), "a.ply", "", "no properties x, y and z"));
  CHECK(refuses(replaced(ascii, "int vertex_indices", "float vertex_indices"), "a.ply", "",
                "not whole numbers"));
  CHECK(refuses(replaced(ascii, "int vertex_indices", "int strip"), "a.ply", "",
                "no list vertex_indices"));
  CHECK(refuses(replaced(ascii, "4 0 2 3 1", "4 0 2 9 1"), "a.ply", ":25: face 0",
                "index 9 is out of range"));
  CHECK(refuses(replaced(ascii, "4 0 2 3 1", "2 0 2"), "a.ply", ":25: face 0", "2 corners"));
  CHECK(refuses(replaced(ascii, "2 0.5 0.25", "2 0.5 0.25 9"), "a.ply", ":25: face 0",
                "more values"));
  CHECK(refuses(replaced(ascii, "element face", "element faces"), "a.ply", "", "no element face"));
  CHECK(
      refuses(replaced(ascii, "element face 6", "element face 7"), "a.ply", "face 6", "cut short"));
  CHECK(refuses(binary.substr(0, binary.size() - 1), "a.ply", "vertex 7 (from 0)", "cut short"));
  CHECK(refuses(replaced(binary, "element face 6", "element face 99999999999"), "a.ply", "byte ",
                "face"));
  std::string nan = binary;
  nan.replace(nan.size() - 8, 8, std::string(8, '\xFF'));
  CHECK(refuses(nan, "a.ply", "vertex 7", "not finite"));
}

TEST(FirstProblem_IsReportedWithCountAndLastPosition) {
  CHECK(refuses("v 0 nan 0\nv 0 0 inf\nv 1 1 1\nv 2 x nan\nf 1 2 3\n", "a.obj", ":1:",
                "`nan` is not finite: mend it, or export the model again (3 times, last at line 4; "
                "problems of other kinds: 1)"));
  CHECK(refuses("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\nf 1 2 3\nf 1 9 8\n", "a.obj",
                ":4:", "Export it again (2 times, last at line 6)"));
  CHECK(refuses("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "a.obj", ":4:", "(once)"));
  CHECK(refuses("v 0,5 0,5 0\nv 1 0 0\nv 0 1,5 0\nf 1 2 3\n", "a.obj",
                ":1:", "with a point (3 times, last at line 3)"));
  CHECK(refuses("v 0 0 0\nq\nv 0 0 0\nq\n", "a.obj", ":2:", "(2 times, last at line 4)"));
  CHECK(refuses(replaced(replaced(cube_off(), "\n1 -1 -1", "\n1 x -1"), "\n1 1 -1", "\n1 1 y"),
                "a.off", ":4: vertex 1 (from 0):", "(2 times, last at vertex 3 (from 0), line 6)"));
  CHECK(refuses(replaced(replaced(cube_off(), "4 0 2 3 1", "4 0 8 3 1"), "4 4 5", "4 4 9"), "a.off",
                ":11: face 0 (from 0):", "(2 times, last at face 1 (from 0), line 12)"));
  std::string nan = cube_ply_binary(false);
  nan.replace(nan.size() - 8, 8, std::string(8, '\xFF'));
  CHECK(refuses(nan, "a.ply", (" byte " + std::to_string(nan.size() - 8) + ", vertex 7").c_str(),
                "a coordinate is not finite: mend the model (once)"));
}

TEST(APlyThatSaysOneThingTwiceIsRefused) {
  const std::string ascii = cube_ply_ascii();
  CHECK(refuses(replaced(ascii, "uchar red", "uchar x"), "a.ply", "", "property x twice"));
  CHECK(refuses(replaced(ascii, "element edge 1",
                         "element vertex 1\nproperty int x\nproperty int "
                         "y\nproperty int z"),
                "a.ply", "", "element vertex twice"));
  CHECK(refuses(replaced(ascii, "float texcoord", "int vertex_index"), "a.ply", "", "twice"));
}

TEST(CoordinatesThatRoundingMovesAreReported) {
  const auto far = [](const char* shift, const char* corner) {
    const std::string s = shift, c = corner;
    return "v " + s + ".0 0 0\nv " + s + c + " 0 0\nv " + s + ".0 1 0\nv " + s +
           ".0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  };
  CHECK(read_surface_bytes(far("0", ".1"), "a.obj", 1).notes.empty());
  CHECK(read_surface_bytes(far("10000", ".5"), "a.obj", 1).notes.empty());  // a float as it is
  const Imported moved = read_surface_bytes(far("10000", ".1"), "a.obj", 1);
  CHECK(says(moved.notes, "moved vertices by up to 0.000391 m") &&
        says(moved.notes, "they lie 1e+04 m from the origin"));
  // A vertex that no face uses moves nothing.
  CHECK(read_surface_bytes("v 1e9 1e-9 0.1\n" + far("1", ".5"), "a.obj", 1).problem.empty());
}

TEST(ObjNotesWhatItPassesOverOfTheShape) {
  const std::string faces = cube_obj();
  CHECK(read_surface_bytes(faces + "v 0 0 0 1\nv 0 0 0 .5 .5 .5\n", "a.obj", 1).notes.empty());
  const Imported weighted = read_surface_bytes("\nv 0 0 0 0.5\nv 0 0 0 2\n" + faces, "a.obj", 1);
  CHECK_EQ(weighted.notes.size(), 1u);
  CHECK(says(weighted.notes, "weights of vertices") &&
        says(weighted.notes, ": 2, first at line 2"));
  const Imported free =
      read_surface_bytes("cstype bspline\nsurf 0 1 0 1 1 2 3 4\nend\n" + faces, "a.obj", 1);
  CHECK_EQ(free.notes.size(), 1u);
  CHECK(says(free.notes, "`surf`") && says(free.notes, ": 1, first at line 2"));
}

TEST(AFileThatCannotBeOpenedIsNamed) {
  const std::string problem = read_surface("no such folder/model.obj", 1).problem;
  CHECK(says(problem, "no such folder/model.obj: cannot be opened"));
}

}  // namespace firmtouch::tools
