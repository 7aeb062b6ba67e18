#include "bake/field/bake_field.hpp"

#include "bake/mesh/bake_mesh.hpp"
#include "field/oracle.hpp"
#include "firmtouch/field/centre.hpp"
#include "firmtouch/field/distance_bounds.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"
#include "surface/shapes.hpp"

// A baked distance field of a real shape against brute force in double.

namespace firmtouch::tools {
namespace {

struct Baked {
  Surface surface;
  std::vector<Section> mesh_sections_, field_sections_;
  mesh::View mesh;
  field::View distance_field;
  FieldReport report;
};

Baked bake(Surface surface, uint32_t cells, bool is_signed = true) {
  Baked baked;
  baked.surface = std::move(surface);
  MeshReport report;
  MeshOptions options;
  options.is_signed = is_signed;
  baked.mesh_sections_ = bake_mesh(baked.surface, "m", options, report);
  CHECK(report.problem.empty());
  CHECK(open_baked(baked.mesh_sections_, "m", baked.mesh).ok());
  baked.field_sections_ = bake_field(baked.mesh, "m", cells, baked.report);
  CHECK(baked.report.problem.empty());
  CHECK(field::open(sections_of<field::Sections>(baked.field_sections_, "m"), baked.mesh,
                    baked.distance_field)
            .ok());
  return baked;
}

void check_point(const Baked& baked, math::Vec3 p, bool check_side) {
  const field::Bounds b = field::distance_bounds(baked.distance_field, p);
  const double truth = oracle_distance(baked.surface, to_point(p));
  CHECK_LE(static_cast<double>(b.lower_m), truth);
  CHECK_GE(static_cast<double>(b.upper_m), truth);
  if (!check_side || !(b.lower_m > 0)) return;
  const bool inside = winding_by_angles(baked.surface, to_point(p)) > 0.5;
  CHECK_EQ(static_cast<int>(b.sign), inside ? -1 : 1);
}

}  // namespace

TEST(BoundsHoldAgainstBruteForceAtCentresCornersAndAnywhere) {
  const Baked baked = bake(make_part(1, 1500), 16);
  const field::Head& head = baked.distance_field.head();
  for (uint32_t z = 0; z < head.count[2]; z += 2)
    for (uint32_t y = 0; y < head.count[1]; y += 2)
      for (uint32_t x = 0; x < head.count[0]; x += 3) {
        const math::Vec3 c = field::centre_of(head, x, y, z);
        const float half = 0.5f * head.cell_m;
        check_point(baked, c, false);
        check_point(baked, {c.x + half, c.y - half, c.z + half}, false);
      }
  Random random(2);
  for (int i = 0; i < 1500; ++i) {
    const double reach = i % 3 == 0 ? 10 : i % 3 == 1 ? 0.6 : 1.2;
    const double size = reach * static_cast<double>(baked.mesh.head().diagonal_m);
    const auto at = [&] { return static_cast<float>(random.between(-size, size)); };
    check_point(baked, {at(), at(), at()}, true);
  }
}

TEST(BoundsGrowCloserWithMoreCells) {
  const Baked coarse = bake(make_part(1, 1500), 8), fine = bake(make_part(1, 1500), 32);
  Random random(3);
  double gap_coarse = 0, gap_fine = 0;
  const double size = 0.4 * static_cast<double>(coarse.mesh.head().diagonal_m);
  for (int i = 0; i < 2000; ++i) {
    const auto at = [&] { return static_cast<float>(random.between(-size, size)); };
    const math::Vec3 p{at(), at(), at()};
    const field::Bounds a = field::distance_bounds(coarse.distance_field, p);
    const field::Bounds b = field::distance_bounds(fine.distance_field, p);
    gap_coarse += static_cast<double>(a.upper_m - a.lower_m);
    gap_fine += static_cast<double>(b.upper_m - b.lower_m);
  }
  CHECK_LT(gap_fine, 0.5 * gap_coarse);
  CHECK_EQ(coarse.report.unknown + fine.report.unknown, 0u);
}

TEST(UnsignedMesh_GivesUnsignedField) {
  Surface open = make_part(1, 1500);
  open.faces.pop_back();
  open.source.pop_back();
  const Baked baked = bake(open, 12, false);
  for (const int16_t word : baked.distance_field.distances()) CHECK(word >= 0);
  CHECK_EQ(static_cast<int>(field::distance_bounds(baked.distance_field, {9, 9, 9}).sign), 0);
  check_point(baked, {9, 9, 9}, false);
  check_point(baked, {0.001f, 0.002f, 0.003f}, false);
}

TEST(Bake_TooManyCells_IsRefused) {
  Baked baked = bake(make_part(1, 1500), 4);
  FieldReport report;
  CHECK(bake_field(baked.mesh, "m", 4000, report).empty());
  CHECK(says(report.problem, "choose fewer"));
}

TEST(SameMesh_GivesSameField) {
  const Baked one = bake(make_part(1, 1500), 12), two = bake(make_part(1, 1500), 12);
  for (size_t i = 0; i < one.field_sections_.size(); ++i)
    CHECK(one.field_sections_[i].bytes == two.field_sections_[i].bytes);
}

}  // namespace firmtouch::tools
