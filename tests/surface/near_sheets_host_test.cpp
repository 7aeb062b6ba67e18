// Sheets of opposite orientation, nearer than float32 resolves: rejected, because a query
// cannot resolve which of them is nearer, and they give opposite signs. Cavities near a wall.
#include "shapes.hpp"
#include "surface/check/check.hpp"

namespace firmtouch::tools {
namespace {

// Seven rotations, of which the first is none.
constexpr int kRotations = 7;

Point rotated(Point p, int rotation) {
  const double a = 0.9 * rotation, b = 1.7 * rotation;
  const Point q{p.x * std::cos(a) - p.y * std::sin(a), p.x * std::sin(a) + p.y * std::cos(a), p.z};
  return {q.x * std::cos(b) - q.z * std::sin(b), q.y, q.x * std::sin(b) + q.z * std::cos(b)};
}

void add(Surface& to, const std::vector<Point>& points, const std::vector<Face>& faces,
         int rotation) {
  std::vector<math::Vec3> vertices;
  for (const Point& p : points) vertices.push_back(to_vec3(rotated(p, rotation)));
  append(to, numbered(vertices, faces));
}

std::vector<Face> inside_out(std::vector<Face> faces) {
  for (Face& face : faces) turn(face);
  return faces;
}

std::vector<Point> box_points(Point low, Point high) {
  std::vector<Point> points;
  for (int k = 0; k < 8; ++k)
    points.push_back({(k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                      (k & 4) != 0 ? high.z : low.z});
  return points;
}

void add_box(Surface& to, Point low, Point high, int rotation) {
  add(to, box_points(low, high), cube().faces, rotation);
}
void add_cavity(Surface& to, Point low, Point high, int rotation) {
  add(to, box_points(low, high), inside_out(cube().faces), rotation);
}

// Two boxes beside each other. Diagonal 2.45.
Surface boxes_apart(double gap_m, int rotation) {
  Surface surface;
  add_box(surface, {0, 0, 0}, {1, 1, 1}, rotation);
  add_box(surface, {1 + gap_m, 0.2, 0.3}, {2, 0.8, 0.9}, rotation);
  return surface;
}

Surface plate(Point size, int rotation) {
  Surface surface;
  add_box(surface, {0, 0, 0}, size, rotation);
  return surface;
}

// A plate of thickness 1, and the ridge of a wedge `gap_m` above it. Diagonal 2.29.
Surface ridge_over_plate(double gap_m, int rotation) {
  Surface surface;
  add_box(surface, {0, 0, -1}, {1, 1, 0}, rotation);
  const double g = gap_m, top = gap_m + 0.5;
  add(surface,
      {{0.2, 0.45, g},
       {0.8, 0.45, g},
       {0.2, 0.1, top},
       {0.8, 0.1, top},
       {0.2, 0.9, top},
       {0.8, 0.9, top}},
      faces_of("013 032 051 045 153 024 235 254"), rotation);
  return surface;
}

CheckReport check(Surface surface) { return check_and_mend(surface, {}); }

}  // namespace

TEST(WallsNearerThanFloat32ResolvesAreRefusedWithPlaceAndRemedy) {
  for (int rotation = 0; rotation < kRotations; ++rotation)
    for (const double gap_m : {1e-9, 1e-8, 2e-8, 5e-8, 1e-7, 2e-7, 5e-7})
      CHECK(!check(boxes_apart(gap_m, rotation)).usable());
  const CheckReport report = check(boxes_apart(5e-7, 0));
  CHECK(says(report.refused, "has 4 faces within 1.22e-06 m of a face that looks the other way"));
  CHECK(says(report.refused, "first face 10, at vertex 1 (1, 0, 0 m), and face 21, at vertex 8"));
  CHECK(says(report.refused, "part them by 2.45e-06 m"));
  CHECK(says(report.refused, "--unsigned"));
}

TEST(WallsAMillionthOfTheDiagonalApartAreTaken) {
  for (int rotation = 0; rotation < kRotations; ++rotation)
    CHECK(check(boxes_apart(2.45e-6, rotation)).usable());
}

TEST(SheetsThinnerThanFloat32ResolvesAreRefused) {
  for (int rotation = 0; rotation < kRotations; ++rotation) {
    for (const double thickness_m : {1e-8, 6e-8, 1e-7, 3e-7})
      CHECK(!check(plate({1, 1, thickness_m}, rotation)).usable());
    CHECK(check(plate({1, 1, 1.42e-6}, rotation)).usable());  // a millionth of the diagonal
  }
}

TEST(HairsAreRefusedIfThinnerThanATenMillionthOfTheirLength) {
  for (int rotation = 0; rotation < kRotations; ++rotation) {
    CHECK(!check(plate({1, 1e-6, 1e-8}, rotation)).usable());
    CHECK(!check(plate({1, 3e-8, 3e-8}, rotation)).usable());
    CHECK(check(plate({1, 1e-6, 3e-7}, rotation)).usable());
  }
  CHECK(check(plate({1e-7, 1, 1e-7}, 0)).usable());
}

TEST(ARidgeNearAFaceIsRefused) {
  for (int rotation = 0; rotation < kRotations; ++rotation) {
    CHECK(!check(ridge_over_plate(4e-7, rotation)).usable());
    CHECK(check(ridge_over_plate(2.3e-6, rotation)).usable());
  }
}

TEST(ConvexEdgesNearEachOtherAreHarmless) {
  for (int rotation = 0; rotation < kRotations; ++rotation) {
    Surface surface;
    add_box(surface, {0, 0, 0}, {1, 1, 1}, rotation);
    add_box(surface, {1 + 4e-7, 0.2, 1 + 4e-7}, {2, 0.8, 2}, rotation);
    CHECK(check(surface).usable());
  }
}

// A prism with a sharp edge of 45 degrees, one side of which is cut by corners 3e-6 to 1e-3 from
// the edge. Diagonal 1.27.
TEST(SliversAlongASharpEdgeAreTaken) {
  for (int rotation = 0; rotation < kRotations; ++rotation) {
    for (const double aside_m : {3e-6, 1e-5, 1e-4, 1e-3}) {
      Surface surface;
      add(surface,
          {{0, 0, 0},
           {0, 1, 0},
           {0.5, 0, 0.5},
           {0.5, 1, 0.5},
           {0.5, 0, 0},
           {0.5, 1, 0},
           {aside_m, 0.3, aside_m},
           {aside_m, 0.6, aside_m}},
          faces_of("067 071 026 627 723 713 054 015 245 253 042 135"), rotation);
      const CheckReport report = check(surface);
      CHECK(report.usable() && report.is_closed);
      CHECK_EQ(report.refused.size(), 0u);
    }
  }
}

TEST(SolidsThatCrossAreTakenAsBefore) {
  for (int rotation = 0; rotation < kRotations; ++rotation) {
    Surface surface;
    add_box(surface, {0, 0, 0}, {1, 1, 1}, rotation);
    add_box(surface, {0.5, 0.2, 0.3}, {1.5, 0.77, 0.71}, rotation);
    CHECK(check(surface).usable());
    CHECK(check(ridge_over_plate(-0.1, rotation)).usable());
  }
}

TEST(ACavityNearTheWallIsNeverFilled) {
  for (int rotation = 0; rotation < kRotations; ++rotation) {
    for (const double gap_m : {1e-10, 3e-10, 1e-9, 3e-9, 1e-8, 1e-7}) {
      Surface surface;
      add_box(surface, {0, 0, 0}, {1, 1, 1}, rotation);
      add_cavity(surface, {0.2, 0.3, 0.4}, {1 - gap_m, 0.7, 0.8}, rotation);
      const CheckReport report = check(surface);
      CHECK(!says(report.mended, "inside out"));
      CHECK(!report.usable());
    }
    // With one corner near it, an octahedron.
    for (const double gap_m : {1e-10, 1e-9, 1e-8, 1e-7, 1e-6}) {
      Surface surface;
      add_box(surface, {0, 0, 0}, {1, 1, 1}, rotation);
      add(surface,
          {{0.5, 0.5, 0.6},
           {1 - gap_m, 0.5, 0.6},
           {0.75, 0.3, 0.6},
           {0.75, 0.7, 0.6},
           {0.75, 0.5, 0.3},
           {0.75, 0.5, 0.9}},
          inside_out(faces_of("042 025 034 053 124 152 143 135")), rotation);
      const CheckReport report = check_and_mend(surface, {});
      CHECK(!says(report.mended, "inside out"));
      if (report.usable())
        CHECK(std::fabs(winding_by_angles(surface, rotated({0.75, 0.5, 0.6}, rotation))) < 0.5);
    }
  }
}

TEST(ACavityInsideOutNearTheWallIsStillTurned) {
  for (int rotation = 0; rotation < kRotations; ++rotation) {
    Surface surface;
    add_box(surface, {0, 0, 0}, {1, 1, 1}, rotation);
    add_box(surface, {0.2, 0.3, 0.4}, {1 - 3e-9, 0.7, 0.8}, rotation);
    CHECK(says(check(surface).mended, "turned 1 piece of 12 faces wound inside out"));
  }
}

}  // namespace firmtouch::tools
