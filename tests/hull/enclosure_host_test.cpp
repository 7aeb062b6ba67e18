#include "../surface/shapes.hpp"

#include <set>

#include "exact_oracle.hpp"
#include "harness/long.hpp"
#include "harness/test.hpp"
#include "hull/build_hull.hpp"
#include "surface/check/check.hpp"
#include "surface/crossings.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"
#include "surface/read/read_surface.hpp"

// No point of the mesh lies outside any stored hull: all vertices, and points of faces drawn evenly
// over the faces.

namespace firmtouch::tools {
namespace {

using test::is_long;

struct Outside {
  size_t points = 0;
  std::set<uint32_t> faces;  // of the mesh, where they lie
};

Outside outside(const Surface& mesh, const Surface& level, uint32_t samples) {
  const Oracle oracle(level);
  Outside found;
  std::set<uint32_t> vertices;
  for (uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (oracle.where(spot_at(mesh.vertices[v])) == Oracle::Where::kOutside) vertices.insert(v);
  }
  found.points = vertices.size();
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (const uint32_t v : mesh.faces[f]) {
      if (vertices.count(v) != 0) found.faces.insert(f);
    }
  }
  Random random(5);
  for (uint32_t k = 0; k < samples; ++k) {
    const uint32_t f = random.below(static_cast<uint32_t>(mesh.faces.size()));
    const Face& face = mesh.faces[f];
    const int first = static_cast<int>(random.below(17));
    const int second = static_cast<int>(random.below(static_cast<uint32_t>(17 - first)));
    const Spot spot{{mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]},
                    {first, second, 16 - first - second}};
    if (oracle.where(spot) != Oracle::Where::kOutside) continue;
    ++found.points;
    found.faces.insert(f);
  }
  return found;
}

Surface sound(const std::string& folder, const char* name) {
  Imported read = read_surface(folder + "/" + name, 1);
  CHECK(read.problem.empty());
  CHECK(check_and_mend(read.surface, {}).usable());
  return std::move(read.surface);
}

ProgressiveHull hull_of(const Surface& mesh, HullStrategy strategy, uint32_t bits, uint32_t faces) {
  HullOptions options;
  options.strategy = strategy;
  options.grid_bits = bits;
  options.target_faces = faces;
  HullReport report;
  return build_hull(mesh, options, report);
}

void check_levels(const Surface& mesh, const ProgressiveHull& hull, uint32_t samples) {
  for (const uint32_t faces : {50000u, 20000u, 10000u, 5000u, 2000u, 500u, 200u}) {
    if (faces >= mesh.faces.size()) continue;
    test::note("faces", faces);
    CHECK_EQ(outside(mesh, hull_level(hull, faces), samples).points, 0u);
  }
}

}  // namespace

TEST(NoPointOfThePartIsOutsideAnyStoredHull) {
  const Surface part = make_part(1, is_long() ? 20000 : 6000);
  for (const HullStrategy strategy :
       {HullStrategy::kVolume, HullStrategy::kCentre, HullStrategy::kLazyVolume}) {
    for (const uint32_t bits : {22u, 16u, 12u}) {
      test::note("bits", bits);
      check_levels(part, hull_of(part, strategy, bits, 200), is_long() ? 1000000 : 4000);
    }
  }
}

TEST(NoPointOfTheRockerArmIsOutsideAnyStoredHull) {
  const char* folder = models_folder();
  if (folder == nullptr) return;
  const Surface mesh = sound(folder, "rocker-arm.off");
  for (const uint32_t bits : {22u, 16u})
    check_levels(mesh, hull_of(mesh, HullStrategy::kLazyVolume, bits, 200),
                 is_long() ? 1000000 : 10000);
}

// Where the horse crosses itself it winds around some points of its own surface 0 times: these are
// the listed places, and only there may a point be outside.
TEST(OnlyWhereTheHorseCrossesItselfMayAPointBeOutside) {
  const char* folder = models_folder();
  if (folder == nullptr) return;
  const Surface mesh = sound(folder, "horse.ply");
  const Crossings crossings = find_crossings(mesh);
  std::set<uint32_t> listed;
  for (const Crossings::Place& place : crossings.places)
    listed.insert(place.faces.begin(), place.faces.end());
  std::set<uint32_t> corners;
  for (const uint32_t f : listed) corners.insert(mesh.faces[f].begin(), mesh.faces[f].end());
  const ProgressiveHull hull =
      hull_of(mesh, HullStrategy::kLazyVolume, 22, is_long() ? 200 : 20000);
  for (const uint32_t faces : {50000u, 20000u, 5000u, 2000u, 500u, 200u}) {
    if (faces < hull.min_faces()) continue;
    const Outside found = outside(mesh, hull_level(hull, faces), is_long() ? 1000000 : 20000);
    for (const uint32_t f : found.faces) {
      test::note("face", f);
      const Face& face = mesh.faces[f];
      CHECK(corners.count(face[0]) + corners.count(face[1]) + corners.count(face[2]) > 0);
    }
  }
}

// What the proof is for: the same hulls rounded without it.
TEST(CarelessRoundingLeavesVerticesOutside) {
  HullOptions options;
  options.limits.is_careless = true;
  options.target_faces = 2000;
  HullReport report;
  const Surface part = make_part(1, 6000);
  CHECK_LT(20, outside(part, hull_level(build_hull(part, options, report), 3000), 0).points);
  const char* folder = models_folder();
  if (folder == nullptr) return;
  const Surface mesh = sound(folder, "rocker-arm.off");
  CHECK_LT(100, outside(mesh, hull_level(build_hull(mesh, options, report), 10000), 0).points);
}

TEST(Oracle_SeparatesInsideOnAndOutside) {
  const Surface body = cube();
  const Oracle oracle(body);
  using Where = Oracle::Where;
  const Face& f = body.faces[0];
  const Spot middle{{body.vertices[f[0]], body.vertices[f[1]], body.vertices[f[2]]}, {5, 5, 6}};
  CHECK(oracle.where(middle) == Where::kOn);
  for (const math::Vec3& v : body.vertices) {
    CHECK(oracle.where(spot_at(v)) == Where::kOn);
    const float out = 1 + 0x1p-23f, in = 1 - 0x1p-24f;
    CHECK(oracle.where(spot_at({v.x * out, v.y, v.z})) == Where::kOutside);
    CHECK(oracle.where(spot_at({v.x, v.y, v.z * out})) == Where::kOutside);
    CHECK(oracle.where(spot_at({v.x * in, v.y, v.z})) == Where::kOn);
    CHECK(oracle.where(spot_at({v.x * in, v.y * in, v.z * in})) == Where::kInside);
  }
  Random random(9);
  const Surface part = make_part(1, 2000);
  const Oracle of_part(part);
  for (int k = 0; k < 1000; ++k) {
    const math::Vec3 p = to_vec3(
        {random.between(-0.06, 0.06), random.between(-0.06, 0.06), random.between(-0.01, 0.03)});
    const bool is_inside = winding_by_angles(part, to_point(p)) > 0.5;
    CHECK(of_part.where(spot_at(p)) == (is_inside ? Where::kInside : Where::kOutside));
  }
}

}  // namespace firmtouch::tools
