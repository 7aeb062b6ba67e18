// What `firmtouch make` writes of splines.
#include "harness/test.hpp"
#include "spline/read_spline.hpp"
#include "spline/sample_splines.hpp"
#include "spline/write_iges.hpp"

namespace {

using namespace firmtouch;
using tools::ControlPoint;
using tools::SplineModel;

void check_points(const std::vector<ControlPoint>& read, const std::vector<ControlPoint>& written) {
  CHECK_EQ(read.size(), written.size());
  for (size_t i = 0; i < written.size() && i < read.size(); ++i) {
    CHECK_EQ(read[i].x, written[i].x);
    CHECK_EQ(read[i].y, written[i].y);
    CHECK_EQ(read[i].z, written[i].z);
    CHECK_EQ(read[i].w, written[i].w);
  }
}

}  // namespace

TEST(WhatIsWrittenIsReadBackToTheBit) {
  SplineModel written;
  written.curves.push_back(tools::winding_curve(1, 15, true, false));
  written.curves.push_back(tools::winding_curve(2, 7, false, true));
  written.curves[0].points[3].x = 0x1.23456789abcdep-60;
  written.curves[1].t0 = 0.1 + 0.2;
  written.surfaces.push_back(tools::hilly_surface(3, 5, 0.15, true));
  const SplineModel read = tools::read_spline_bytes(tools::to_iges(written), "made.igs", 0);
  CHECK(read.problem.empty());
  CHECK_EQ(read.notes.size(), 0u);
  CHECK_EQ(read.curves.size(), 2u);
  CHECK_EQ(read.surfaces.size(), 1u);
  if (read.curves.size() != 2 || read.surfaces.size() != 1) return;
  for (size_t i = 0; i < 2; ++i) {
    CHECK_EQ(read.curves[i].degree, written.curves[i].degree);
    CHECK(read.curves[i].knots == written.curves[i].knots);
    CHECK_EQ(read.curves[i].t0, written.curves[i].t0);
    CHECK_EQ(read.curves[i].t1, written.curves[i].t1);
    check_points(read.curves[i].points, written.curves[i].points);
  }
  CHECK(read.curves[0].is_planar);
  CHECK(!read.curves[1].is_planar);
  CHECK_EQ(read.surfaces[0].count_u, written.surfaces[0].count_u);
  CHECK_EQ(read.surfaces[0].u1, written.surfaces[0].u1);
  CHECK(read.surfaces[0].knots_v == written.surfaces[0].knots_v);
  check_points(read.surfaces[0].points, written.surfaces[0].points);
}
