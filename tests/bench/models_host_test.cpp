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

// As `firmtouch bake` stores it; peers read the file, so models for a race count from its 0.
TEST(AModelFarFromZeroCountsFromTheOriginOfABake) {
  const TemporaryFolder folder;
  const std::string path = folder.write("far.off",
                                        "OFF\n4 4 0\n10 0 0\n10.1 0 0\n10 0.1 0\n"
                                        "10 0 0.1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  const mesh::Head head = load_model(path).view.head();
  CHECK_LT(std::fabs(head.low_m[0]), 1);
  CHECK_LT(std::fabs(head.diagonal_m - std::sqrt(0.03f)), 1e-6f);
  Options options;
  options.models = {path};
  CHECK_LT(std::fabs(load_models(options)[0].view.head().low_m[0] - 10), 1);
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
