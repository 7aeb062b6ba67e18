// What an asset holds for a desktop changes no bit of an answer. (Of weight where the tests are
// built for a processor that reads it: preset host-native.)
#include "bake/bake_mesh.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "harness/test.hpp"
#include "surface/make_part.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file

struct Baked {
  std::vector<tools::Section> sections;
  mesh::View with, without;

  explicit Baked(bool is_signed) {
    tools::MeshOptions options;
    options.is_signed = is_signed;
    options.shape = tools::kDesktopTree;
    tools::MeshReport report;
    sections = tools::bake_mesh(tools::make_part(3, 3000), "part", options, report);
    CHECK(report.problem.empty());
    mesh::Sections found = tools::mesh_sections(sections, "part");
    CHECK(!found.rows.empty());
    CHECK(!found.shape_rows.empty());
    CHECK(!found.directions.empty());
    CHECK(mesh::open(found, with).ok());
    found.rows = found.shape_rows = found.directions = {};
    CHECK(mesh::open(found, without).ok());
  }
};

// Near the surface and far from it, one after the other in short steps and in long ones.
std::vector<query::ProbePoint> points_about(const mesh::Head& head, uint64_t seed) {
  tools::Random random(seed);
  std::vector<query::ProbePoint> points;
  const double size = static_cast<double>(head.diagonal_m);
  double at[3] = {0, 0, 0};
  for (uint32_t i = 0; i < 20000; ++i) {
    const double step = i % 50 == 0 ? 0.7 : 0.002;
    for (uint32_t k = 0; k < 3; ++k) {
      const double low = static_cast<double>(head.low_m[k]);
      const double high = static_cast<double>(head.high_m[k]);
      at[k] += random.between(-step, step) * size;
      if (at[k] < low - 0.1 * size || at[k] > high + 0.1 * size) at[k] = (low + high) / 2;
    }
    points.push_back(
        {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])});
  }
  return points;
}

}  // namespace

TEST(WhatIsThereForADesktopChangesNoBitOfAnAnswer) {
  for (const bool is_signed : {true, false}) {
    const Baked baked(is_signed);
    const std::vector<query::ProbePoint> points = points_about(baked.with.head(), 9);
    const core::Span<const query::ProbePoint> span(points.data(),
                                                   static_cast<uint32_t>(points.size()));
    CHECK_EQ(mesh::probe_hash(baked.with, span), mesh::probe_hash(baked.without, span));
  }
}
