#include <cstring>

#include "field/distance_field.hpp"
#include "field/oracle.hpp"
#include "field/write_vti.hpp"
#include "surface/check/check.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"
#include "surface/read/read_surface.hpp"
#include "surface/shapes.hpp"

namespace firmtouch::tools {
namespace {

struct Made {
  std::vector<Surface> surfaces;
  std::vector<Solid> solids;
  DistanceField distance_field;
};

Made make(std::vector<Surface> surfaces, uint32_t cells, const FieldOptions& options = {}) {
  Made made;
  made.surfaces = std::move(surfaces);
  std::vector<const Surface*> all;
  for (const Surface& s : made.surfaces) {
    made.solids.emplace_back(s);
    all.push_back(&s);
  }
  made.distance_field = make_distance_field(made.solids, make_voxel_grid(all, cells), options);
  return made;
}

template <class Visit>
void each_voxel(const VoxelGrid& grid, const Visit& visit) {
  for (uint32_t z = 0; z < grid.count[2]; ++z)
    for (uint32_t y = 0; y < grid.count[1]; ++y)
      for (uint32_t x = 0; x < grid.count[0]; ++x)
        visit(grid.index(x, y, z), grid.centre_m(x, y, z));
}

double reported(const Nearest& n) { return std::fabs(static_cast<double>(n.distance_m)); }

bool same_values(const Nearest& a, const Nearest& b) {
  return !(a.distance_m < b.distance_m || a.distance_m > b.distance_m) && a.face == b.face &&
         a.object == b.object && a.sign == b.sign &&
         !(length(to_point(a.closest_m) - to_point(b.closest_m)) > 0);
}

Surface moved(Surface surface, math::Vec3 by) {
  for (math::Vec3& v : surface.vertices) v = {v.x + by.x, v.y + by.y, v.z + by.z};
  return surface;
}

}  // namespace

TEST(EveryVoxelOfAPartHasTheDistanceThatBruteForceFinds) {
  const Made made = make({make_part(1, 1500)}, 24);
  const double diagonal = length(to_point(math::Vec3{0.1f, 0.1f, 0.1f}));
  size_t wrong = 0;
  each_voxel(made.distance_field.grid, [&](size_t v, Point p) {
    const Nearest& n = made.distance_field.values[v];
    const double truth = oracle_distance(made.surfaces[0], p);
    if (std::fabs(reported(n) - truth) > 1e-6 * std::max(diagonal, truth)) ++wrong;
    const Face& f = made.surfaces[0].faces[n.face];  // the point lies on the triangle
    const double off = oracle_triangle(
        to_point(n.closest_m), to_point(made.surfaces[0].vertices[f[0]]),
        to_point(made.surfaces[0].vertices[f[1]]), to_point(made.surfaces[0].vertices[f[2]]));
    if (off > 1e-7 * diagonal ||
        std::fabs(length(to_point(n.closest_m) - p) - truth) > 1e-6 * diagonal)
      ++wrong;
  });
  CHECK_EQ(wrong, 0u);
  CHECK(made.distance_field.disagreements.empty());
}

TEST(SidesAreThoseOfTheWindingNumber) {
  const Made made = make({make_part(2, 1500)}, 20);
  size_t wrong = 0;
  each_voxel(made.distance_field.grid, [&](size_t v, Point p) {
    const bool inside = winding_by_angles(made.surfaces[0], p) > 0.5;
    if (inside != (made.distance_field.values[v].sign < 0)) ++wrong;
    if (inside != (made.distance_field.values[v].distance_m < 0)) ++wrong;
    if (made.distance_field.kinds[v] != Voxel::kSurface &&
        inside != (made.distance_field.kinds[v] == Voxel::kInside))
      ++wrong;
  });
  CHECK_EQ(wrong, 0u);
}

TEST(InteriorOnly_SameValuesInside_NoneOutside) {
  const Made all = make({make_part(1, 1500)}, 30);
  FieldOptions options;
  options.interior_only = true;
  const Made some = make({make_part(1, 1500)}, 30, options);
  CHECK_EQ(some.distance_field.computed, some.distance_field.surface + some.distance_field.inside);
  CHECK_EQ(all.distance_field.computed, all.distance_field.grid.voxels());
  size_t wrong = 0, computed = 0;
  for (size_t v = 0; v < all.distance_field.values.size(); ++v) {
    const bool wanted = all.distance_field.kinds[v] != Voxel::kOutside;
    const Nearest& n = some.distance_field.values[v];
    if (wanted != (n.sign != 0)) ++wrong;
    if (!wanted) continue;
    ++computed;
    // Of two triangles equally near either may be returned.
    if (n.sign != all.distance_field.values[v].sign ||
        std::fabs(reported(n) - reported(all.distance_field.values[v])) > 1e-8)
      ++wrong;
  }
  CHECK_EQ(wrong, 0u);
  CHECK_EQ(computed, some.distance_field.computed);
}

TEST(AnyNumberOfThreadsGivesTheSameBits) {
  const Made one = make({make_part(1, 3000)}, 40);
  FieldOptions options;
  options.threads = 3;
  size_t calls = 0;
  options.on_progress = [&](double share) { calls += share > 0 && share <= 1 ? 1u : 1000000u; };
  const Made three = make({make_part(1, 3000)}, 40, options);
  size_t different = 0;
  for (size_t v = 0; v < one.distance_field.values.size(); ++v)
    different +=
        same_values(one.distance_field.values[v], three.distance_field.values[v]) ? 0u : 1u;
  CHECK_EQ(different, 0u);
  CHECK(calls >= 1 && calls < 1000);
}

TEST(SeveralObjects_DistanceOfTheNearest_InsideOfAny) {
  // Two cubes that overlap: a corner of each lies in the other.
  const Made made = make({cube({0, 0, 0}, 1), cube({1.25f, 1.25f, 1.25f}, 1)}, 26);
  size_t wrong = 0, second = 0;
  each_voxel(made.distance_field.grid, [&](size_t v, Point p) {
    const Nearest& n = made.distance_field.values[v];
    const double to_a = oracle_distance(made.surfaces[0], p),
                 to_b = oracle_distance(made.surfaces[1], p);
    const auto in = [&](double c) {
      return std::max({std::fabs(p.x - c), std::fabs(p.y - c), std::fabs(p.z - c)}) < 1;
    };
    if (std::fabs(reported(n) - std::min(to_a, to_b)) > 1e-6) ++wrong;
    if ((n.sign < 0) != (in(0) || in(1.25))) ++wrong;
    if (std::fabs(to_a - to_b) > 1e-6 && (n.object == 0) != (to_a < to_b)) ++wrong;
    second += n.object;
  });
  CHECK_EQ(wrong, 0u);
  CHECK(second > 100);
}

TEST(Field_AnyScaleAndPosition_SameRelativeError) {
  for (const float scale : {1e-3f, 1.0f, 1e3f}) {
    Surface surface = moved(cube({0, 0, 0}, 1), {300, -200, 100});
    for (math::Vec3& v : surface.vertices) v = {v.x * scale, v.y * scale, v.z * scale};
    const Made made = make({surface}, 10);
    size_t wrong = 0;
    each_voxel(made.distance_field.grid, [&](size_t v, Point p) {
      const double truth = oracle_distance(made.surfaces[0], p);
      if (std::fabs(reported(made.distance_field.values[v]) - truth) >
          4e-6 * static_cast<double>(scale))
        ++wrong;
    });
    CHECK_EQ(wrong, 0u);
  }
}

TEST(SignsThatFloodAndPseudonormalDispute_AreListed) {
  // A cube with another inside it, wound outward too: between them the flood cannot come, and at
  // the inner one the pseudonormal says that its inside is inside and the space between is outside.
  Surface surface = cube({0, 0, 0}, 2);
  append(surface, cube({0, 0, 0}, 1));
  const Made made = make({surface}, 20);
  size_t found = 0, wrong = 0;
  each_voxel(made.distance_field.grid, [&](size_t v, Point p) {
    const double size = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    const double to_outer = 2 - size, to_inner = oracle_distance(cube(), p);
    if (std::fabs(to_outer - to_inner) < 1e-6) return;  // either may be returned
    const bool listed = std::any_of(
        made.distance_field.disagreements.begin(), made.distance_field.disagreements.end(),
        [&](const auto& d) { return d.voxel == v && d.flood_says_inside; });
    const bool expected =
        made.distance_field.kinds[v] != Voxel::kSurface && size > 1 && to_inner < to_outer;
    found += listed ? 1u : 0u;
    wrong += listed != expected ? 1u : 0u;
  });
  CHECK_EQ(wrong, 0u);
  CHECK(found > 100);
}

TEST(Vti_HoldsTheFieldsValues) {
  FieldOptions options;
  options.interior_only = true;
  const Made made = make({tetrahedron()}, 6, options);
  const std::string text = to_vti(made.distance_field, made.solids);
  const size_t count = made.distance_field.grid.voxels();
  CHECK(says(text,
             "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
             "header_type=\"UInt64\">"));
  CHECK(says(text, "WholeExtent=\"0 5 0 5 0 5\""));
  const size_t data = text.find("\n_") + 2;
  const struct {
    const char* name;
    size_t bytes;
  } kArrays[] = {{"distance", 4}, {"closest_point", 12}, {"triangle", 4},
                 {"object", 2},   {"side", 1},           {"kind", 1}};
  size_t offset = 0;
  for (const auto& array : kArrays) {
    const std::string head = "Name=\"" + std::string(array.name) + "\"";
    const size_t at = text.find("offset=\"", text.find(head)) + 8;
    CHECK_EQ(std::stoull(text.substr(at, 20)), offset);
    uint64_t bytes = 0;
    std::memcpy(&bytes, text.data() + data + offset, sizeof bytes);
    CHECK_EQ(bytes, count * array.bytes);
    offset += sizeof bytes + bytes;
  }
  CHECK(text.substr(data + offset) == "\n  </AppendedData>\n</VTKFile>\n");
  size_t wrong = 0;
  for (size_t v = 0; v < count; ++v) {
    float distance = 0;
    std::memcpy(&distance, text.data() + data + 8 + 4 * v, sizeof distance);
    const Nearest& n = made.distance_field.values[v];
    if (n.sign == 0 ? distance <= distance : distance < n.distance_m || distance > n.distance_m)
      ++wrong;
  }
  CHECK_EQ(wrong, 0u);
}

TEST(TheClosedBunnyHasTheVoxelsOfThePaperAndNoDisagreement) {
  const char* folder = models_folder();
  if (folder == nullptr) return;
  Imported read = read_surface(std::string(folder) + "/stanford-bunny.obj", 1);
  CheckOptions checks;
  checks.close_holes = true;
  CHECK(check_and_mend(read.surface, checks).usable());
  FieldOptions options;
  options.interior_only = true;
  const Made made = make({read.surface}, 30, options);
  // The paper: 7,168 at 30 (another orientation or border of its boxes).
  CHECK_LE(std::fabs(static_cast<double>(made.distance_field.computed) / 7168 - 1), 0.05);
  CHECK(made.distance_field.disagreements.empty());
  const std::vector<size_t> probes{made.distance_field.values.size() / 2,
                                   made.distance_field.values.size() / 3};
  size_t wrong = 0, checked = 0;
  each_voxel(made.distance_field.grid, [&](size_t v, Point p) {
    if (made.distance_field.values[v].sign == 0 || v % 61 != 0) return;
    ++checked;
    if (std::fabs(reported(made.distance_field.values[v]) - oracle_distance(made.surfaces[0], p)) >
        2e-7)
      ++wrong;
  });
  CHECK_EQ(wrong, 0u);
  CHECK(checked > 50);
}

}  // namespace firmtouch::tools
