#include "lab/pyramids.hpp"

#include <algorithm>
#include <cmath>

#include "bake/mesh/pseudonormals.hpp"
#include "bake/mesh/sign_proof.hpp"
#include "bake/mesh/stars.hpp"
#include "firmtouch/mesh/pseudonormal.hpp"
#include "lab/reference_normals.hpp"
#include "lab/trials.hpp"

namespace firmtouch::lab {
namespace {

using math::Vec3;
using tools::Point;

constexpr uint32_t kSides = 5, kPyramids = 1000;

Point unit(Point a) { return a * (1 / length(a)); }

double asin_of(double sine) { return std::asin(std::max(-1.0, std::min(1.0, sine))); }

// Without special attention to numerics, as the paper has it, in float32.
Point plain_float_normal(const std::vector<Corner>& corners) {
  float sum[3] = {};
  for (const Corner& c : corners) {
    const float a[3] = {static_cast<float>(c.next.x), static_cast<float>(c.next.y),
                        static_cast<float>(c.next.z)},
                b[3] = {static_cast<float>(c.last.x), static_cast<float>(c.last.y),
                        static_cast<float>(c.last.z)};
    const auto dot3 = [](const float* u, const float* v) {
      return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    };
    const float n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                        a[0] * b[1] - a[1] * b[0]};
    const float cosine = dot3(a, b) / std::sqrt(dot3(a, a) * dot3(b, b));
    const float weight = std::acos(std::min(1.0f, cosine)) / std::sqrt(dot3(n, n));
    for (size_t k = 0; k < 3; ++k) sum[k] += n[k] * weight;
  }
  return {static_cast<double>(sum[0]), static_cast<double>(sum[1]), static_cast<double>(sum[2])};
}

struct Spread {
  double least = HUGE_VAL, sum = 0, most = -HUGE_VAL;
  uint32_t negative = 0, refused = 0;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
    sum += value;
    negative += value > 0 ? 0u : 1u;
    refused += value >= tools::kMinMargin_rad ? 0u : 1u;
  }
  void add_to(std::vector<std::string>& row) const {
    for (const double value : {least, sum / kPyramids, most}) row.push_back(number_text(value));
    row.push_back(std::to_string(negative));
  }
};

}  // namespace

Pyramid::Pyramid(tools::Random& random, double radius) {
  std::vector<double> turns;
  for (uint32_t k = 0; k < kSides; ++k) turns.push_back(random.between(0, 2 * M_PI));
  std::sort(turns.begin(), turns.end());
  for (const double turn : turns)
    base.push_back({radius * std::cos(turn), radius * std::sin(turn), 0});
}

tools::Surface Pyramid::surface() const {
  tools::Surface surface;
  surface.vertices.push_back({0, 0, 1});
  for (const Point& corner : base) surface.vertices.push_back(to_vec3(corner));
  for (uint32_t k = 1; k <= kSides; ++k)
    surface.faces.push_back({k % kSides + 1, 0, k});  // a long edge first
  for (uint32_t k = 2; k < kSides; ++k) surface.faces.push_back({1, k + 1, k});
  return surface;
}

ApexMargins apex_margins(const Pyramid& pyramid) {
  const Point apex{0, 0, 1};
  std::vector<Corner> corners;
  for (size_t k = 0; k < kSides; ++k)
    corners.push_back({pyramid.base[k] - apex, pyramid.base[(k + 1) % kSides] - apex});
  const std::vector<tools::SideRay> rays = rays_of(corners);
  const auto margin = [&](Point normal) {
    return asin_of(tools::vertex_margin(rays, unit(normal)));
  };
  ApexMargins margins{};
  margins.doubles_rad = margin(reference_normal(NormalKind::kAngleWeighted, corners, {}));
  margins.floats_rad = margin(plain_float_normal(corners));
  const tools::Surface surface = pyramid.surface();
  const tools::ExactNormals exact(surface);
  const tools::Pseudonormals stored = make_pseudonormals(surface, exact);
  margins.stored_rad = asin_of(
      tools::vertex_margin(tools::extreme_rays(tools::Stars(surface, exact).around(0)),
                           tools::to_point(mesh::decode_vertex_normal(stored.vertices[0]))));
  return margins;
}

// The paper's figure 10: margins of the apex over 1,000 pyramids a radius. Its plot has negative
// margins from a radius of about 1.5e-4 on.
void run_pyramids(const Options&, Report& report) {
  report.heading("margin of a five-sided pyramid's apex, rad, 1,000 pyramids a radius (figure 10)");
  std::vector<std::string> heads{"radius"};
  for (const char* from : {"doubles", "stored", "float32"})
    for (const char* what : {": least", ": mean", ": most", ": wrong"})
      heads.push_back(std::string(from) + what);
  heads.insert(heads.end(), {"refused by the baker", "the paper"});
  std::vector<std::vector<std::string>> rows;
  for (const double radius :
       {1.0, 0.3, 0.1, 0.03, 0.01, 0.003, 1e-3, 3e-4, 1.5e-4, 1e-5, 1e-6, 1e-7}) {
    report.stage("pyramids of radius " + number_text(radius));
    tools::Random random(10);
    Spread doubles, stored, floats;
    for (uint32_t i = 0; i < kPyramids; ++i) {
      const ApexMargins margins = apex_margins(Pyramid(random, radius));
      doubles.add(margins.doubles_rad);
      stored.add(margins.stored_rad);
      floats.add(margins.floats_rad);
    }
    std::vector<std::string> row{number_text(radius)};
    for (const Spread* spread : {&doubles, &stored, &floats}) spread->add_to(row);
    row.push_back(std::to_string(stored.refused));
    row.push_back(radius > 1.5e-4 ? "positive" : radius < 1.5e-4 ? "" : "first negative");
    rows.push_back(row);
    if (radius >= 1e-6)
      report.bar("wrong from doubles, radius " + number_text(radius), "", doubles.negative, "", 0);
  }
  report.table(heads, rows);
}

}  // namespace firmtouch::lab
