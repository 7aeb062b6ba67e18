// Models and points of the benches: the same in every run, and where they are said to be.
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "bench/models.hpp"
#include "bench/problem.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;         // NOLINT: a test file
using namespace firmtouch::bench;  // NOLINT

const Model& part() {
  static const Model model = demo_part(Sides::kSigned, 2000);
  return model;
}

bool same(const std::vector<math::Vec3>& a, const std::vector<math::Vec3>& b) {
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i)
    if (std::fabs(a[i].x - b[i].x) + std::fabs(a[i].y - b[i].y) + std::fabs(a[i].z - b[i].z) > 0)
      return false;
  return true;
}

}  // namespace

TEST(WithoutAModelItIsTheDemoPart) {
  const std::vector<Model> models = load_models({});
  CHECK_EQ(models.size(), size_t{1});
  CHECK(models[0].name == "part");
  CHECK_GE(models[0].report.triangles, 20000u);
  CHECK(models[0].view.is_signed());
}

TEST(AnUnsignedBakeKeepsTheTreeAndDropsTheSides) {
  const Model plain = baked_again(part(), Sides::kUnsigned);
  CHECK(!plain.view.is_signed());
  CHECK_EQ(plain.report.nodes, part().report.nodes);
  CHECK_EQ(plain.report.shape_bytes, part().report.shape_bytes);
  CHECK_EQ(plain.report.sign_bytes, 0u);
}

TEST(RandomPointsFillOnePointFiveBoxes) {
  const std::vector<math::Vec3> points = random_points(part(), 4000);
  CHECK(same(points, random_points(part(), 4000)));
  CHECK(!same(points, random_points(part(), 4000, 2)));
  const mesh::Head& head = part().view.head();
  float least = 1e9f, most = -1e9f;
  for (const math::Vec3& p : points) {
    least = p.x < least ? p.x : least;
    most = p.x > most ? p.x : most;
  }
  const float side = head.high_m[0] - head.low_m[0];
  CHECK_GE(least, head.low_m[0] - 0.25f * side);
  CHECK_LE(most, head.high_m[0] + 0.25f * side);
  CHECK_GT(most - least, 1.49f * side);
}

TEST(AWalkIsTheSameInEveryRun) {
  CHECK(same(walk(part(), 500), walk(part(), 500)));
  CHECK(!same(walk(part(), 500), walk(part(), 500, 2)));
}

TEST(WhatAPeerReadsIsThereAndGoesAgain) {
  std::string path;
  {
    const TemporaryFolder folder;
    path = file_for_peer(part(), folder);
    CHECK(std::ifstream(path).good());
  }
  CHECK(!std::ifstream(path).good());
}

TEST(AModelThatCannotBeReadIsAProblem) {
  try {
    (void)load_model("no such model.obj");
    CHECK(false);
  } catch (const Problem& problem) {
    CHECK(std::string(problem.what()).find("no such model.obj") != std::string::npos);
  }
}
