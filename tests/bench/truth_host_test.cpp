// The oracle of `firmtouch bench truth`: it is right, it finds a wrong sign, and the library
// passes.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "bench/brute_truth.hpp"
#include "bench/problem.hpp"
#include "harness/test.hpp"
#include "mesh/brute_force.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file

void check_truth(const bench::Model& model, size_t count) {
  const bench::TruthReport truth = bench::measure_truth(model, count);
  CHECK_EQ(truth.points, count);
  CHECK_LE(truth.worst_error, 4e-7);
  CHECK_EQ(truth.bounds_above_truth, 0u);
  CHECK_EQ(truth.not_exact, 0u);
  CHECK_EQ(truth.wrong_sides, 0u);
  CHECK_EQ(truth.unknown_sides, 0u);
}

bench::Model small_part() { return bench::demo_part(bench::Sides::kSigned, 2000); }

}  // namespace

TEST(Part_HasTrueDistancesAndSigns) {
  check_truth(mesh_test::long_run() ? bench::demo_part() : small_part(),
              mesh_test::long_run() ? 100000 : 4000);
}

TEST(EveryRealModel_HasTrueDistancesAndSigns) {
  if (mesh_test::models_folder().empty())
    return test::skip("FIRMTOUCH_MODELS names no folder of real models");
  for (const char* name : {"spot.obj", "rocker-arm.off", "fandisk.obj", "horse.ply"}) {
    const std::string path = mesh_test::models_folder() + "/" + name;
    const bool is_large = std::string(name) == "horse.ply";
    if (!std::filesystem::exists(path) || (is_large && !mesh_test::long_run())) continue;
    check_truth(bench::load_model(path), mesh_test::long_run() ? 100000 : 300);
  }
}

// Two ways to the same numbers: the oracle of the tests and the bench's.
TEST(BothBruteForcesAgree) {
  const bench::Model model = small_part();
  const bench::BruteForce force(model.surface);
  for (const math::Vec3& p : bench::truth_points(model, 300, 7)) {
    const bench::BruteTruth one = force.at(tools::to_point(p));
    const mesh_test::Truth other = mesh_test::brute_force(model.surface, mesh_test::wide(p));
    CHECK_LE(std::fabs(one.distance_m - other.distance),
             1e-12 * std::max(model.diagonal_m(), other.distance));
    CHECK_EQ(one.winding > 0.5, other.inside);
  }
}

TEST(AWrongVertexNormalIsFoundByItsWrongSides) {
  bench::Model model = small_part();
  for (tools::Section& section : model.sections) {
    if (section.type != mesh::kVertexNormalsSection) continue;
    // Every normal becomes (0, 0, 1) or (0, 0, -1), each where it is wrong for some.
    for (size_t i = 0; i + 4 <= section.bytes.size(); i += 4) {
      const uint32_t code = i % 8 == 0 ? 32767u | 32767u << 16 : 0u;
      std::memcpy(section.bytes.data() + i, &code, 4);
    }
  }
  CHECK(tools::open_baked(model.sections, "model", model.view).ok());
  model.wide = simd::WideMesh(model.view);
  const bench::TruthReport truth = bench::measure_truth(model, 4000);
  CHECK_GT(truth.wrong_sides, 50u);
  CHECK_EQ(truth.wrong_places.size(), 5u);
}
