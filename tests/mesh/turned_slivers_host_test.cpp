// Machined parts as CAD exports them, turned: a sliver whose normal float32 loses must not keep a
// sound part from being baked.
#include <cmath>

#include "bake/mesh/bake_mesh.hpp"
#include "bake/mesh/sign_proof.hpp"
#include "brute_force.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "harness/test.hpp"
#include "mesh/sliver_plate.hpp"
#include "surface/make/make_cad.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT

// Source: Shoemake 1992, "Uniform random rotations", without trigonometric functions.
Rotation random_rotation(Random& random) {
  double q[4], sum = 0;
  do {
    sum = 0;
    for (double& part : q) part = random.between(-1, 1), sum += part * part;
  } while (sum > 1 || sum < 0.01);
  const double s = 2 / sum, a = q[0], b = q[1], c = q[2], d = q[3];
  return {{1 - s * (c * c + d * d), s * (b * c - d * a), s * (b * d + c * a)},
          {s * (b * c + d * a), 1 - s * (b * b + d * d), s * (c * d - b * a)},
          {s * (b * d - c * a), s * (c * d + b * a), 1 - s * (b * b + c * c)}};
}

tools::Surface turned(tools::Surface surface, const Rotation& rotation) {
  for (math::Vec3& v : surface.vertices) v = tools::to_vec3(rotation.of(wide(v)));
  return surface;
}

// Each cap a fan from its first corner, as exporters write them; too long to be cut anew.
tools::Surface rod_of_fans(uint32_t sides) {
  tools::Surface rod;
  for (const double z_m : {0.0, 0.04})
    for (uint32_t k = 0; k < sides; ++k) {
      const double turn = 2 * M_PI * k / sides;
      rod.vertices.push_back(tools::to_vec3({0.01 * std::cos(turn), 0.01 * std::sin(turn), z_m}));
    }
  for (uint32_t k = 0; k < sides; ++k) {
    const uint32_t next = (k + 1) % sides;
    if (k > 0 && next > 0) {
      rod.faces.push_back({0, next, k});
      rod.faces.push_back({sides, sides + k, sides + next});
    }
    rod.faces.push_back({k, next, sides + next});
    rod.faces.push_back({k, sides + next, sides + k});
  }
  return rod;
}

// Result: flips that it took.
uint32_t is_signed_like_brute_force(const tools::Surface& given, int queries, uint64_t seed) {
  tools::Surface surface = given;
  const tools::CheckReport check = tools::check_and_mend(surface, {});
  CHECK(check.usable());
  tools::MeshReport report;
  const auto sections = tools::bake_mesh(surface, "part", {}, report);
  CHECK(report.problem.empty());
  if (!report.problem.empty()) return std::printf("  %s\n", report.problem.c_str()), 0;
  mesh::View view;
  CHECK(tools::open_baked(sections, "part", view).ok());
  const double size_m = diagonal(surface);
  for (const math::Vec3 p : hard_queries(surface, static_cast<size_t>(queries), seed)) {
    mesh::Hint hint;
    const mesh::Closest c = mesh::closest_point(view, p, query::kUnlimited, hint);
    const Truth truth = brute_force(surface, wide(p));
    CHECK_LE(double{c.certificate.lower_m}, truth.distance * (1 + 1e-9));
    CHECK_LE(std::fabs(std::fabs(double{c.distance_m}) - truth.distance),
             4e-7 * std::max(size_m, truth.distance));
    if (truth.distance > 4e-6 * size_m) CHECK_EQ(c.certificate.sign, truth.inside ? -1 : 1);
  }
  return report.signs.turned.flips;
}

}  // namespace

TEST(PlateWithSlivers_Turned_IsSignedLikeBruteForce) {
  Random random(4);
  uint32_t flips = 0;
  for (int i = 0; i < 400; ++i) {
    test::note("case", i);
    const Rotation rotation = random_rotation(random);
    const double lift_m = std::pow(10.0, random.between(-8, -6));
    flips +=
        is_signed_like_brute_force(sliver_plate(rotation, lift_m), 60, static_cast<uint64_t>(i));
  }
  CHECK_GT(flips, 10u);
}

TEST(CadParts_Turned_AreSignedLikeBruteForce) {
  Random random(5);
  for (uint64_t seed = 0; seed < 20; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    const tools::Surface part = tools::to_surface(tools::make_cad(seed % tools::kCadKinds));
    is_signed_like_brute_force(turned(part, random_rotation(random)), 50, seed);
  }
}

// Rounding makes such a cap uneven about its first corner.
TEST(RodWithFansOfThousandsOfFaces_Turned_IsProvenAndSigned) {
  Random random(7);
  for (int i = 0; i < 12; ++i) {
    test::note("rotation", i);
    const tools::Surface rod = turned(rod_of_fans(2000), random_rotation(random));
    const tools::ExactNormals exact(rod);
    const tools::SignProof proof =
        prove_signs(rod, exact, make_pseudonormals(rod, exact), tools::kMinMargin_rad, {});
    CHECK(proof.holds());
    CHECK_GT(proof.vertices.smallest_rad, 0.7);
    if (long_run()) is_signed_like_brute_force(rod, 200, static_cast<uint64_t>(i));
  }
}

TEST(MachinedPart_Rotated_IsSignedLikeBruteForce) {
  if (models_folder().empty()) return test::skip("FIRMTOUCH_MODELS names no folder of real models");
  const tools::Surface bracket = real_model("bracket.obj");
  Random random(6);
  for (int i = 0; i < (long_run() ? 20 : 5); ++i) {
    test::note("rotation", i);
    is_signed_like_brute_force(turned(bracket, random_rotation(random)), long_run() ? 3000 : 50,
                               static_cast<uint64_t>(i));
  }
}
