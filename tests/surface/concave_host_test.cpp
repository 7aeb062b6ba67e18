// Faces with concave outlines: split by ear clipping, or refused by name.
#include <cmath>
#include <string>
#include <vector>

#include "shapes.hpp"
#include "surface/check/check.hpp"
#include "surface/crossings.hpp"
#include "surface/random.hpp"
#include "surface/read/read_surface.hpp"

namespace firmtouch::tools {
namespace {

using Drawing = std::vector<Point>;  // counter-clockwise, z 0

double area_of(const Drawing& drawing) {
  double sum = 0;
  for (size_t k = 0; k < drawing.size(); ++k)
    sum += cross(drawing[k], drawing[(k + 1) % drawing.size()]).z;
  return sum / 2;
}

// Two faces of the outline, one `height` above the other, and a quad a side; turned askew.
std::string prism_off(const Drawing& outline, double height, double turn, size_t start) {
  const size_t n = outline.size();
  const Point x{std::cos(turn), std::sin(turn) * 0.6, std::sin(turn) * 0.8};
  const Point aside = cross(x, Point{0.1, 0.9, 0.2});
  const Point z = aside * (1 / length(aside)), y = cross(z, x);
  std::string text = "OFF\n" + std::to_string(2 * n) + " " + std::to_string(n + 2) + " 0\n";
  for (size_t k = 0; k < 2 * n; ++k) {
    const Point p = x * outline[k % n].x + y * outline[k % n].y + z * (k < n ? 0 : height);
    text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  std::string below = std::to_string(n), above = below;
  for (size_t k = 0; k < n; ++k) {  // from any corner
    below += " " + std::to_string((start + n - 1 - k) % n);
    above += " " + std::to_string((start + k) % n + n);
  }
  text += below + "\n" + above + "\n";
  for (size_t k = 0; k < n; ++k) {
    const size_t next = (k + 1) % n;
    text += "4 " + std::to_string(k) + " " + std::to_string(next) + " " + std::to_string(next + n) +
            " " + std::to_string(k + n) + "\n";
  }
  return text;
}

}  // namespace

TEST(ConcaveFaces_AreSplitInTheirPlane) {
  // L, U, an arrow, a corner on a side.
  const Drawing drawings[] = {
      {{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 5, 0}, {0, 5, 0}},
      {{0, 0, 0}, {5, 0, 0}, {5, 4, 0}, {4, 4, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}},
      {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.7, 1, 0}},
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 0.4, 0}, {0, 1, 0}},
  };
  uint32_t tried = 0;
  for (const Drawing& drawing : drawings) {
    for (size_t start = 0; start < drawing.size(); ++start) {
      const Imported read = read_surface_bytes(
          prism_off(drawing, 0.7, 0.3 * static_cast<double>(start), start), "a.off", 1);
      CHECK(read.problem.empty());
      Surface surface = read.surface;
      CHECK_EQ(surface.faces.size(), 2 * (drawing.size() - 2) + 2 * drawing.size());
      CHECK(is_closed_and_alike(surface));
      CHECK(find_crossings(surface).pairs.empty());
      CHECK(std::fabs(volume_of(surface) - 0.7 * area_of(drawing)) < 1e-4);
      ++tried;
    }
  }
  CHECK_EQ(tried, 24u);
}

TEST(StarsOfAnyOutline_AreSplit) {
  Random random(4);
  for (int i = 0; i < 40; ++i) {
    Drawing star;
    const int corners = 5 + static_cast<int>(random.below(40));
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * 3.14159265358979 * k / corners, radius = random.between(0.2, 3);
      star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    const Imported read = read_surface_bytes(prism_off(star, 1, 0.1 * i, 0), "a.off", 1);
    CHECK(read.problem.empty());
    Surface surface = read.surface;
    CHECK(is_closed_and_alike(surface));
    CHECK(std::fabs(volume_of(surface) - area_of(star)) < 1e-4 * area_of(star) + 1e-4);
  }
}

// A convex face keeps the fan from its first corner: triangles are numbered in the file's order.
TEST(ConvexFaces_AreFanned) {
  const Imported read = read_surface_bytes(
      "OFF\n5 1 0\n0 0 0\n2 0 0\n3 1 0\n2 2 0\n0 2 0\n5 0 1 2 3 4\n", "a.off", 1);
  const std::vector<Face> fan = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  CHECK(read.surface.faces == fan);
}

TEST(FaceWhoseOutlineCrossesItself_IsNamed) {
  const Imported read = read_surface_bytes(
      "OFF\n5 1 0\n0 0 0\n4 0 0\n1 3 0\n2 -1 0\n3 3 0\n5 0 1 2 3 4\n", "a.off", 1);
  CHECK(says(read.problem, "a.off:8"));
  CHECK(says(read.problem, "outline crosses itself"));
}

}  // namespace firmtouch::tools
