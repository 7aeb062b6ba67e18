#include "harness/test.hpp"
#include "hull/linear_program.hpp"
#include "surface/random.hpp"

namespace firmtouch::tools {
namespace {

Point any_direction(Random& random) {
  for (;;) {
    const Point p{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    if (length(p) > 0.1 && length(p) < 1) return p * (1 / length(p));
  }
}

// The least goal . x over all corners: points where three planes meet that lie in all half-spaces.
bool best_corner(std::vector<HalfSpace> spaces, Point goal, double& least) {
  for (int k = 0; k < 3; ++k) {
    const Point e{k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
    spaces.push_back({e, -LinearProgram::kBox});
    spaces.push_back({e * -1.0, -LinearProgram::kBox});
  }
  bool found = false;
  for (size_t i = 0; i < spaces.size(); ++i) {
    for (size_t j = i + 1; j < spaces.size(); ++j) {
      for (size_t k = j + 1; k < spaces.size(); ++k) {
        const Point a = spaces[i].normal, b = spaces[j].normal, c = spaces[k].normal;
        const double det = dot(a, cross(b, c));
        if (std::fabs(det) < 1e-9) continue;
        const Point x = (cross(b, c) * spaces[i].offset + cross(c, a) * spaces[j].offset +
                         cross(a, b) * spaces[k].offset) *
                        (1 / det);
        bool is_in = true;
        for (const HalfSpace& space : spaces)
          is_in = is_in && dot(space.normal, x) >= space.offset - 1e-9;
        if (!is_in) continue;
        if (!found || dot(goal, x) < least) least = dot(goal, x);
        found = true;
      }
    }
  }
  return found;
}

}  // namespace

TEST(TheOptimumIsTheBestCorner) {
  Random random(3);
  LinearProgram program;
  int solvable = 0, unsolvable = 0;
  for (int k = 0; k < 3000; ++k) {
    test::note("case", k);
    std::vector<HalfSpace> spaces;
    const uint32_t count = 1 + random.below(14);
    const Point up = any_direction(random);
    for (uint32_t i = 0; i < count; ++i) {
      Point n = any_direction(random);
      if (k % 4 != 0 && dot(n, up) < 0) n = n * -1.0;  // a star's normals share a side
      spaces.push_back({n, random.between(-0.6, 0.6)});
    }
    Point goal;
    for (const HalfSpace& space : spaces) goal = goal + space.normal * random.uniform();
    goal = goal * (1 / length(goal));
    double least = 0;
    Point x;
    const bool has_corner = best_corner(spaces, goal, least);
    const Optimum found = program.solve(spaces, goal, x);
    CHECK_EQ(found != Optimum::kNone, has_corner);
    if (found == Optimum::kNone || !has_corner) {
      ++unsolvable;
      continue;
    }
    ++solvable;
    CHECK_LT(std::fabs(dot(goal, x) - least), 1e-7);
    for (const HalfSpace& space : spaces) CHECK_GE(dot(space.normal, x), space.offset - 1e-9);
  }
  CHECK_LT(1000, solvable);
  CHECK_LT(30, unsolvable);
}

TEST(AFlatStarAnswersTheFootOfItsMiddle) {
  LinearProgram program;
  Point x;
  const Point n{0.6, 0, 0.8};
  const std::vector<HalfSpace> flat(9, HalfSpace{n, 0.25});
  CHECK(program.solve(flat, n, x) == Optimum::kFound);
  CHECK_LT(length(x - n * 0.25), 1e-12);
}

}  // namespace firmtouch::tools
