// Bezier patch files.
#include <cmath>
#include <cstdlib>

#include "harness/test.hpp"
#include "iges_text.hpp"

namespace {

using namespace firmtouch;
using namespace firmtouch::spline_test;

std::string patch_file(const std::string& indices, int points) {
  std::string text = "1\n" + indices + "\n" + std::to_string(points) + "\n";
  for (int i = 0; i < points; ++i)
    text += std::to_string(i % 4) + "," + std::to_string(i / 4) + ",0.5\n";
  return text;
}

const char kIndices[] = "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16";

bool refused_text(const std::string& text, std::initializer_list<const char*> parts) {
  return refused(tools::read_spline_bytes(text, "part.bpt", 0), parts);
}

}  // namespace

TEST(APatchIsABicubicOfItsSixteenPoints) {
  const tools::SplineModel model =
      tools::read_spline_bytes(patch_file(kIndices, 16), "a.bpt", 0.001);
  CHECK(model.problem.empty());
  CHECK_EQ(model.surfaces.size(), 1u);
  const tools::SplineSurface& s = model.surfaces[0];
  CHECK_EQ(s.degree_u, 3);
  CHECK_EQ(s.points[1].x, 0.001);
  CHECK_EQ(s.points[4].y, 0.001);
  const std::vector<tools::BezierPatch> patches = tools::bezier_pieces(s);
  CHECK_EQ(patches.size(), 1u);
  for (size_t i = 0; i < 16; ++i) CHECK_EQ(patches[0].points[i].x, s.points[i].x);
  CHECK_LE(tools::length(point_at(s, 0.5, 0.5) - tools::Point{0.0015, 0.0015, 0.0005}), 1e-18);
}

TEST(TheTeapotIsThirtyTwoPatchesThatMeet) {
  const char* folder = std::getenv("FIRMTOUCH_MODELS");
  if (folder == nullptr) return test::skip("FIRMTOUCH_MODELS is not set");
  const tools::SplineModel model = tools::read_spline_file(std::string(folder) + "/teapot.bpt", 0);
  CHECK(model.problem.empty());
  CHECK_EQ(model.surfaces.size(), 32u);
  CHECK_EQ(model.surfaces[31].piece, 31);
  double low = 1e9, high = -1e9;
  for (const tools::SplineSurface& s : model.surfaces) {
    for (const tools::ControlPoint& p : s.points)
      low = std::fmin(low, p.z), high = std::fmax(high, p.z);
  }
  CHECK_LE(std::fabs(high - 3.15), 1e-9);
  CHECK_LE(std::fabs(low), 1e-9);
  // Patch 0's second edge is patch 1's first: a quarter of the rim each.
  for (size_t j = 0; j < 4; ++j)
    CHECK_EQ(model.surfaces[0].points[4 * j + 3].x, model.surfaces[1].points[4 * j].x);
}

TEST(PatchesMayHoldTheirOwnPointsAndDegrees) {
  const tools::SplineModel model = tools::read_spline_bytes(
      "2\n1 2\n0 0 0\n1 0 0\n0 1 1\n1 1 1\n0 2 0\n1 2 0\n1 1\n0,0,5\n1,0,5\n0,1,5\n1,1,5\n",
      "a.bpt", 0);
  CHECK(model.problem.empty());
  CHECK_EQ(model.surfaces.size(), 2u);
  const tools::SplineSurface& s = model.surfaces[0];
  CHECK_EQ(s.degree_u, 1);
  CHECK_EQ(s.degree_v, 2);
  CHECK_LE(tools::length(point_at(s, 0.5, 0.5) - tools::Point{0.5, 1, 0.5}), 1e-16);
  CHECK(refused_text("1\n3 9\n0 0 0\n", {"part.bpt:2:", "degrees 3 and 9", "1 to 5"}));
  CHECK(refused_text("1\n1 1\n0 0 0\n1 0 0\n0 1 0\n", {"ends before point 4 of 4", "cut short"}));
  CHECK(
      refused_text("1\n1 1\n0 0 0\n1 0 0\n0 1 0\n1 1 nan\n", {"part.bpt:6:", "point 4", "`nan`"}));
}

TEST(BadPatchFilesAreRefusedWithLineAndRemedy) {
  CHECK(refused_text("x\n", {"part.bpt:1:", "the number of patches", "`x`"}));
  CHECK(refused_text("0\n", {"part.bpt:1:", "is 0"}));
  CHECK(refused_text("1\n1,2,3\n4,5\n", {"part.bpt:2:", "patch 0", "16 numbers"}));
  CHECK(refused_text(patch_file("1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,17", 16),
                     {"part.bpt:2:", "patch 0 in line 2", "point 17 does not exist", "1 to 16"}));
  CHECK(refused_text(patch_file(kIndices, 16).substr(0, 100),
                     {"the file ends before point", "cut short"}));
  CHECK(refused_text(patch_file(kIndices, 16) + "7\n", {"part.bpt:20:", "after the last point"}));
  std::string text = patch_file(kIndices, 16);
  text.replace(text.find("0.5"), 3, "nan");
  CHECK(refused_text(text, {"part.bpt:4:", "point 1: `nan` is not finite"}));
  text = patch_file(kIndices, 16);
  text.replace(text.find("0.5"), 3, "5e9");
  CHECK(refused_text(text, {"part.bpt:2:", "patch 0", "1e9 m"}));
  CHECK(refused_text(patch_file("1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1", 16), {"patch 0", "no extent"}));
}

TEST(DecimalCommasInAPatchFileAreNamed) {
  CHECK(refused_text("1\n1 1\n0,5 0,5 0,0\n1,5 0,0 0,0\n0,0 1,5 0,0\n1,5 1,5 0,0\n",
                     {"comes after the last point", "decimal commas", "0.1, not `0,1`"}));
  const std::string text = "1\n1 1\n0,0,0\n1,0,0\n0,1,0\n1,1,nan\n";
  const std::string problem = tools::read_spline_bytes(text, "part.bpt", 0).problem;
  CHECK(!problem.empty() && problem.find("decimal") == problem.npos);
}

// Four points on a line, and a curve drawn along itself.
TEST(PatchesWithoutAreaAreRefusedByName) {
  CHECK(refused_text("1\n1 1\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n",
                     {"part.bpt:2:", "patch 0 in line 2 has no area", "remove it"}));
  CHECK(refused_text("1\n2 1\n0 0 0\n1 1 0\n2 0 0\n0 0 0\n1 1 0\n2 0 0\n", {"no area"}));
  const auto is_read = [](const std::string& text) {
    return tools::read_spline_bytes(text, "part.bpt", 0).problem.empty();
  };
  CHECK(is_read("1\n1 1\n0 0 0\n1 0 0\n2 0 0\n3 0 1e-3\n"));
  CHECK(is_read("1\n1 1\n0 0 0\n1 0 0\n0 1e-5 0\n1 1e-5 0\n"));
  CHECK(is_read("1\n1 1\n0 0 0\n0 0 0\n1 1 0\n1 0 0\n"));  // with a pole
}

TEST(PatchFilesCutAnywhereAreRefused) {
  const std::string text = patch_file(kIndices, 16);
  for (size_t length = 0; length + 4 < text.size(); ++length)
    CHECK(!tools::read_spline_bytes(text.substr(0, length), "part.bpt", 0).problem.empty());
}
