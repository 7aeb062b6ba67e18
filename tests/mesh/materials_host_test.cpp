// Materials of triangles through the bake: cuts, flips and mending leave each place of the surface
// the material that it had in the file. The oracle is the nearest of the file's triangles, by brute
// force in double.
#include <cmath>

#include "bake/mesh/bake_mesh.hpp"
#include "brute_force.hpp"
#include "firmtouch/mesh/view.hpp"
#include "harness/test.hpp"
#include "mesh/sliver_plate.hpp"
#include "surface/check/check.hpp"
#include "surface/make/make_cad.hpp"
#include "true_distance.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT

constexpr uint8_t kMaterials = 3;  // and none

tools::MeshOptions with_materials() {
  tools::MeshOptions options;
  for (uint8_t i = 0; i < kMaterials; ++i) {
    scene::MaterialLayout material = {};
    material.name[0] = static_cast<char>('a' + i);
    material.stiffness_N_per_m = 100;
    options.materials.push_back(material);
  }
  return options;
}

struct Baked {
  tools::Surface given;
  std::vector<tools::Section> sections;
  mesh::View view;
  core::Bytes material;
  tools::MeshReport report;
  tools::CheckReport check;

  explicit Baked(const tools::Surface& surface) : given(surface) {
    tools::Surface mended = given;
    check = tools::check_and_mend(mended, {});
    CHECK(check.usable());
    sections = tools::bake_mesh(mended, "part", with_materials(), report);
    CHECK(report.problem.empty());
    CHECK(tools::open_baked(sections, "part", view).ok());
    material = tools::find_section(sections, "part", scene::kTriangleMaterialsSection);
    CHECK_EQ(material.size(), view.head().triangle_count);
  }
  Point corner(uint32_t triangle, size_t k) const {
    return wide(view.vertex(view.triangle(triangle).corner[k]));
  }
  double distance(size_t face, Point p) const {
    const tools::Face& f = given.faces[face];
    return true_distance(p, wide(given.vertices[f[0]]), wide(given.vertices[f[1]]),
                         wide(given.vertices[f[2]]));
  }
  // Whether one of the file's triangles that are nearest to the point has this material.
  bool is_of(uint8_t number, Point p) const {
    double nearest = 1e300, nearest_of = 1e300;
    for (size_t f = 0; f < given.faces.size(); ++f) {
      const double d = distance(f, p);
      nearest = std::min(nearest, d);
      if (given.material[f] == number) nearest_of = std::min(nearest_of, d);
    }
    return nearest_of <= nearest + 2e-7 * diagonal(given);
  }
};

double area(Point a, Point b, Point c) { return length(cross(b - a, c - a)) / 2; }

// Some hundred triangles at a point of theirs, and the area of each material.
void check_materials(const Baked& baked, uint64_t seed) {
  Random random(seed);
  double less[kMaterials + 1] = {}, all = 0;
  for (size_t f = 0; f < baked.given.faces.size(); ++f) {
    const tools::Face& face = baked.given.faces[f];
    const double size =
        area(wide(baked.given.vertices[face[0]]), wide(baked.given.vertices[face[1]]),
             wide(baked.given.vertices[face[2]]));
    less[baked.given.material[f]] += size;
    all += size;
  }
  uint32_t wrong = 0;
  const uint32_t every = long_run() ? 1 : baked.material.size() / 300 + 1;
  for (uint32_t t = 0; t < baked.material.size(); ++t) {
    const Point a = baked.corner(t, 0), b = baked.corner(t, 1), c = baked.corner(t, 2);
    less[baked.material[t]] -= area(a, b, c);
    if (t % every != 0) continue;
    double v = random.between(0.05, 0.9), w = random.between(0.05, 0.9);
    if (v + w > 0.95) v *= 0.5, w *= 0.5;
    if (!baked.is_of(baked.material[t], a + (b - a) * v + (c - a) * w)) ++wrong;
  }
  CHECK_EQ(wrong, 0u);
  for (const double left : less) CHECK_LE(std::fabs(left), 2e-6 * all);
}

// Stripes along x, or any material for any face.
void paint(tools::Surface& surface, bool in_stripes, uint64_t seed) {
  Random random(seed);
  surface.source.clear();
  surface.material.clear();
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    double x = 0;
    for (const uint32_t v : surface.faces[f]) x += wide(surface.vertices[v]).x / 3;
    const double place = in_stripes ? std::floor(x * 100) : random.between(0, 1000);
    surface.source.push_back(f);
    surface.material.push_back(
        static_cast<uint8_t>((static_cast<int64_t>(place) + 1000) % (kMaterials + 1)));
  }
}

}  // namespace

TEST(Materials_MachinedParts_KeepTheirPlaces) {
  uint32_t flips = 0, splits = 0;
  for (uint64_t seed = 0; seed < 2 * tools::kCadKinds; ++seed)
    for (const bool in_stripes : {true, false}) {
      test::note("seed", static_cast<int64_t>(seed));
      tools::Surface surface = tools::to_surface(tools::make_cad(seed));
      paint(surface, in_stripes, seed);
      const Baked baked(surface);
      flips += baked.report.refined.flips;
      splits += baked.report.refined.splits;
      check_materials(baked, seed);
    }
  CHECK_GT(flips, 1000u);  // or nothing was put to the test
  CHECK_GT(splits, 100u);
}

// A face without area lies along the border of two materials: mending flips it into one of them.
TEST(Materials_FaceWithoutAreaAtABorder_TakesTheMaterialOfItsPlace) {
  for (uint8_t of_cap = 0; of_cap <= kMaterials; ++of_cap) {
    tools::Surface box;
    for (uint32_t i = 0; i < 8; ++i)
      box.vertices.push_back(
          {(i & 1) != 0 ? 0.02f : 0.0f, (i & 2) != 0 ? 0.02f : 0.0f, (i & 4) != 0 ? 0.02f : 0.0f});
    box.vertices.push_back({0.01f, 0.01f, 0.02f});  // the middle of the lid's diagonal
    box.faces = {{0, 2, 1}, {1, 2, 3}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                 {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}, {4, 5, 6},  // one half of the lid
                 {5, 7, 8}, {8, 7, 6},                                   // the other, in two
                 {5, 8, 6}};  // between them, without area
    for (uint32_t f = 0; f < box.faces.size(); ++f) box.source.push_back(f);
    box.material.assign(box.faces.size(), 0);
    box.material[10] = 1;
    box.material[11] = box.material[12] = 2;
    box.material[13] = of_cap;
    const Baked baked(box);
    CHECK(!baked.check.mended.empty());
    check_materials(baked, of_cap);
  }
}

// CAD slivers that float32 confuses are flipped while signs are proven.
TEST(Materials_TurnedSlivers_KeepTheirPlaces) {
  uint32_t flips = 0;
  for (const double lift_m : {1e-9, 3e-9, 1e-8}) {
    tools::Surface plate = sliver_plate({{0.8, -0.6, 0}, {0.6, 0.8, 0}, {0, 0, 1}}, lift_m);
    paint(plate, false, 5);
    const Baked baked(plate);
    flips += baked.report.signs.turned.flips;
    check_materials(baked, 1);
  }
  CHECK_GE(flips, 1u);
}

TEST(Materials_SameMaterialEverywhere_IsTheSameBake) {
  tools::Surface surface = tools::to_surface(tools::make_cad(2));
  paint(surface, true, 0);
  tools::Surface plain = surface;
  plain.material.clear();
  surface.material.assign(surface.faces.size(), 2);
  tools::MeshReport report;
  const auto with = tools::bake_mesh(surface, "part", with_materials(), report);
  const auto without = tools::bake_mesh(plain, "part", {}, report);
  CHECK_EQ(with.size(), without.size() + 2);
  for (const tools::Section& section : without)
    CHECK(section.bytes.size() == tools::find_section(with, "part", section.type).size() &&
          std::equal(section.bytes.begin(), section.bytes.end(),
                     tools::find_section(with, "part", section.type).begin()));
}
