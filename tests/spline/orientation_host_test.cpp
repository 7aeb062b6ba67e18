// Surfaces whose normals point to different sides are turned to one, or reported.
#include "spline/orientation.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "bake/spline/bake_spline.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "harness/test.hpp"
#include "surface/random.hpp"

namespace {

namespace query = firmtouch::query;
namespace spline = firmtouch::spline;
namespace tools = firmtouch::tools;
using tools::ControlPoint;
using tools::Point;
using tools::SplineModel;
using tools::SplineSurface;

// From (0, 0) to (1, 1) in u and v.
SplineSurface flat(const Point& a, const Point& b, const Point& c, const Point& d) {
  SplineSurface s;
  s.degree_u = s.degree_v = 1;
  s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = {0, 0, 1, 1};
  for (const Point& p : {a, b, c, d}) s.points.push_back({p.x, p.y, p.z, 1});
  return s;
}

// The same surface with its normal on the other side, by the file's own parameters.
SplineSurface reversed(const SplineSurface& of) {
  SplineSurface s = of;
  for (size_t j = 0; j < s.count_v; ++j)
    for (size_t i = 0; i < s.count_u; ++i)
      s.points[j * s.count_u + i] = of.points[j * s.count_u + s.count_u - 1 - i];
  for (size_t k = 0; k < s.knots_u.size(); ++k)
    s.knots_u[k] = s.u0 + s.u1 - of.knots_u[s.knots_u.size() - 1 - k];
  return s;
}

// u and v change places, so that its normal turns as well.
SplineSurface swapped(const SplineSurface& of) {
  SplineSurface s = of;
  std::swap(s.degree_u, s.degree_v);
  std::swap(s.count_u, s.count_v);
  std::swap(s.knots_u, s.knots_v);
  std::swap(s.u0, s.v0);
  std::swap(s.u1, s.v1);
  for (size_t j = 0; j < s.count_v; ++j)
    for (size_t i = 0; i < s.count_u; ++i)
      s.points[j * s.count_u + i] = of.points[i * of.count_u + j];
  return s;
}

SplineModel numbered(std::vector<SplineSurface> surfaces) {
  SplineModel model;
  model.surfaces = std::move(surfaces);
  for (size_t i = 0; i < model.surfaces.size(); ++i) {
    model.surfaces[i].piece = static_cast<int>(i);
    model.surfaces[i].where = "entity 128 in line " + std::to_string(3 + 2 * i);
  }
  return model;
}

// A cube of side 2 about `middle`, all normals out.
std::vector<SplineSurface> cube(const Point& middle = {}) {
  std::vector<SplineSurface> sides;
  for (int axis = 0; axis < 3; ++axis)
    for (int end = -1; end <= 1; end += 2) {
      Point corners[4];
      for (int k = 0; k < 4; ++k) {
        double at[3];
        at[axis] = end;
        at[(axis + 1) % 3] = (k % 2 == 0 ? -1 : 1) * end;
        at[(axis + 2) % 3] = k < 2 ? -1 : 1;
        corners[k] = middle + Point{at[0], at[1], at[2]};
      }
      sides.push_back(flat(corners[0], corners[1], corners[2], corners[3]));
    }
  return sides;
}

Point normal_of(const SplineSurface& s) {
  const double h = 1e-4, u = 0.5 * (s.u0 + s.u1), v = 0.5 * (s.v0 + s.v1);
  const Point n = cross(point_at(s, u + h, v) - point_at(s, u - h, v),
                        point_at(s, u, v + h) - point_at(s, u, v - h));
  return n * ((s.is_turned ? -1 : 1) / length(n));
}

// Surfaces whose normals, turned as they are, point away from `middle`.
size_t pointing_out(const SplineModel& model, const Point& middle) {
  size_t count = 0;
  for (const SplineSurface& s : model.surfaces)
    count += dot(normal_of(s), point_at(s, 0.5 * (s.u0 + s.u1), 0.5 * (s.v0 + s.v1)) - middle) > 0;
  return count;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// A strip of flat patches round the z axis, with so many half twists.
std::vector<SplineSurface> strip(int patches, int twists) {
  const auto at = [&](int i, double across) {
    const double turn = 2 * 3.14159265358979324 * i / patches, tilt = 0.5 * twists * turn;
    const double away = 1 + across * std::cos(tilt);
    return Point{away * std::cos(turn), away * std::sin(turn), across * std::sin(tilt)};
  };
  std::vector<SplineSurface> made;
  for (int i = 0; i < patches; ++i)
    made.push_back(flat(at(i, -0.2), at(i, 0.2), at(i + 1, -0.2), at(i + 1, 0.2)));
  return made;
}

}  // namespace

TEST(SurfacesThatShareBordersAreTurnedToOneSide) {
  tools::Random random(31);
  for (int round = 0; round < 64; ++round) {
    std::vector<SplineSurface> sides = cube();
    size_t in = 0;
    for (size_t i = 0; i < 6; ++i) {
      if ((round >> i & 1) == 0) continue;
      ++in;
      sides[i] = random.below(2) == 0 ? reversed(sides[i]) : swapped(sides[i]);
    }
    SplineModel model = numbered(sides);
    CHECK_EQ(pointing_out(model, {}), 6 - in);
    orient(model);
    const size_t out = pointing_out(model, {});
    if (in < 3) CHECK_EQ(out, 6u);
    if (in > 3) CHECK_EQ(out, 0u);
    CHECK(out == 0 || out == 6);
    const size_t turned = in < 6 - in ? in : 6 - in;
    CHECK_EQ(model.notes.size(), turned > 0 ? 1u : 0u);
    if (turned > 0)
      CHECK(has(model.notes[0], "turned over " + std::to_string(turned) + " of 6 surfaces"));
  }
}

TEST(BordersAreSharedInPartsAndByOtherParameters) {
  // Of a cube's top two halves and the face before it of degree 2 by 3, with its own knots and
  // weights.
  std::vector<SplineSurface> sides = cube();
  const SplineSurface top = sides[5];
  const auto point = [&](double u, double v) { return point_at(top, u, v); };
  sides[5] = flat(point(0, 0), point(0.37, 0), point(0, 1), point(0.37, 1));
  sides.push_back(reversed(flat(point(0.37, 0), point(1, 0), point(0.37, 1), point(1, 1))));
  const SplineSurface frontier = sides[0];
  SplineSurface curved;
  curved.degree_u = 2, curved.degree_v = 3;
  curved.count_u = 3, curved.count_v = 4;
  curved.knots_u = {2, 2, 2, 5, 5, 5};
  curved.knots_v = {-1, -1, -1, -1, 4, 4, 4, 4};
  curved.u0 = 2, curved.u1 = 5, curved.v0 = -1, curved.v1 = 4;
  for (size_t j = 0; j < 4; ++j)
    for (size_t i = 0; i < 3; ++i) {
      const Point p = point_at(frontier, static_cast<double>(i) / 2, static_cast<double>(j) / 3);
      curved.points.push_back({p.x, p.y, p.z, 1.0 + static_cast<double>(i)});
    }
  sides[0] = swapped(curved);
  SplineModel model = numbered(sides);
  CHECK_EQ(pointing_out(model, {}), 5u);
  orient(model);
  CHECK_EQ(pointing_out(model, {}), 7u);
  CHECK(model.surfaces[0].is_turned && model.surfaces[6].is_turned);
  CHECK(has(model.notes[0], "turned over 2 of 7 surfaces"));
  CHECK(has(model.notes[0], "entity 128 in line 3, entity 128 in line 15"));
}

TEST(OneSidedShell_IsReportedAndKept) {
  for (const int twists : {0, 1, 2, 3}) {
    std::vector<SplineSurface> patches = strip(7, twists);
    patches[2] = reversed(patches[2]);
    SplineModel model = numbered(patches);
    orient(model);
    CHECK_EQ(model.notes.size(), 1u);
    size_t turned = 0;
    for (const SplineSurface& s : model.surfaces) turned += s.is_turned;
    CHECK_EQ(turned, twists % 2 == 0 ? 1u : 0u);
    CHECK(has(model.notes[0], twists % 2 == 0 ? "turned over 1 of 7" : "a shell of one side"));
  }
  // One surface that closes upon itself, too.
  SplineSurface whole = strip(7, 1)[0];
  whole.count_v = 8;
  whole.knots_v = {0, 0, 1, 2, 3, 4, 5, 6, 7, 7};
  whole.v1 = 7;
  const std::vector<SplineSurface> patches = strip(7, 1);
  for (size_t i = 1; i < 7; ++i)
    whole.points.insert(whole.points.end(), patches[i].points.begin() + 2, patches[i].points.end());
  SplineModel model = numbered({whole});
  orient(model);
  CHECK_EQ(model.notes.size(), 1u);
  CHECK(has(model.notes[0], "a shell of one side"));
}

TEST(ShellsThatShareNoBorderAreEachTurnedByThemselves) {
  std::vector<SplineSurface> sides = cube(), others = cube({5, 0, 0});
  sides[1] = reversed(sides[1]);
  others[4] = swapped(others[4]);
  sides.erase(sides.begin() + 5);  // both are open: nothing says how they lie to each other
  others.erase(others.begin());
  for (SplineSurface& s : others) s = reversed(s);
  sides.insert(sides.end(), others.begin(), others.end());
  SplineModel model = numbered(sides);
  orient(model);
  CHECK(model.surfaces[1].is_turned && model.surfaces[8].is_turned);
  CHECK_EQ(model.notes.size(), 2u);
  CHECK(has(model.notes[0], "turned over 2 of 10 surfaces"));
  CHECK(has(model.notes[1], "its 2 shells share no border"));
}

TEST(ClosedShellsAreTurnedToEncloseOneSolid) {
  // Two cubes beside each other, and in the first a cavity with a cube in it.
  const auto scaled = [](std::vector<SplineSurface> sides, double by) {
    for (SplineSurface& s : sides)
      for (ControlPoint& p : s.points) p.x *= by, p.y *= by, p.z *= by;
    return sides;
  };
  const std::vector<std::vector<SplineSurface>> shells = {cube({5, 0, 0}), cube(),
                                                          scaled(cube(), 0.6), scaled(cube(), 0.3)};
  for (int mask = 0; mask < 16; ++mask) {
    std::vector<SplineSurface> all;
    for (size_t k = 0; k < 4; ++k)
      for (const SplineSurface& s : shells[k])
        all.push_back((mask >> k & 1) != 0 ? reversed(s) : s);
    SplineModel model = numbered(all);
    orient(model);
    int side[4];  // 1: normals away from the shell's own middle
    for (size_t k = 0; k < 4; ++k) {
      SplineModel one;
      one.surfaces.assign(model.surfaces.begin() + static_cast<std::ptrdiff_t>(6 * k),
                          model.surfaces.begin() + static_cast<std::ptrdiff_t>(6 * k + 6));
      const size_t out = pointing_out(one, k == 0 ? Point{5, 0, 0} : Point{});
      CHECK(out == 0 || out == 6);
      side[k] = out == 6 ? 1 : -1;
    }
    CHECK(side[0] == side[1] && side[2] == -side[1] && side[3] == side[1]);
    size_t turned = 0;
    for (const SplineSurface& s : model.surfaces) turned += s.is_turned;
    CHECK_LE(turned, 12u);
    CHECK_EQ(model.notes.size(), turned > 0 ? 1u : 0u);
  }
}

TEST(ClosedShellsMayTouchButNotCross) {
  for (const bool crosses : {false, true}) {
    std::vector<SplineSurface> sides = cube();
    for (const SplineSurface& s : cube({crosses ? 1.5 : 2, 0.5, 0.5})) sides.push_back(reversed(s));
    SplineModel model = numbered(sides);
    orient(model);
    size_t turned = 0;
    for (const SplineSurface& s : model.surfaces) turned += s.is_turned;
    CHECK_EQ(turned, crosses ? 0u : 6u);
    CHECK_EQ(model.notes.size(), 1u);
    CHECK(has(model.notes[0], crosses ? "its 2 shells share no border" : "turned over 6 of 12"));
  }
}

TEST(WhereThreeSurfacesMeetNoneIsTurnedByThat) {
  // Two flat patches and a third that stands on their border.
  std::vector<SplineSurface> patches = {flat({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}),
                                        reversed(flat({1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2, 1, 0})),
                                        flat({1, 0, 0}, {1, 0, 1}, {1, 1, 0}, {1, 1, 1})};
  SplineModel model = numbered(patches);
  orient(model);
  for (const SplineSurface& s : model.surfaces) CHECK(!s.is_turned);
  CHECK(has(model.notes[0], "its 3 shells share no border"));
}

TEST(TurnedSurface_ReturnsTheFilesParameters) {
  std::vector<SplineSurface> sides = cube();
  sides[2] = reversed(sides[2]);
  sides[2].knots_u = {3, 3, 7, 7};
  sides[2].u0 = 3, sides[2].u1 = 7;
  SplineModel model = numbered(sides);
  orient(model);
  CHECK(model.surfaces[2].is_turned);
  tools::SplineReport report;
  const std::vector<tools::Section> sections =
      tools::bake_spline(model, "x", tools::surface_detail(false), report);
  spline::View view;
  CHECK(tools::open_baked(sections, "x", view).ok());
  tools::Random random(8);
  spline::Hint hint;
  for (int i = 0; i < 300; ++i) {
    const Point p{random.between(-1.5, 1.5), random.between(-1.5, 1.5), random.between(-1.5, 1.5)};
    const spline::Closest c = closest_point(view, tools::to_vec3(p), query::kUnlimited, hint);
    const SplineSurface& s = model.surfaces[c.piece];
    const Point there = point_at(s, static_cast<double>(c.u), static_cast<double>(c.v));
    CHECK_LE(length(there - tools::to_point(c.point_m)), 4e-6);
    CHECK_GE(dot(normal_of(s), tools::to_point(c.direction)), 0.999);
    CHECK_GE(dot(tools::to_point(c.direction), tools::to_point(c.point_m)), 0.99);  // out
  }
}
