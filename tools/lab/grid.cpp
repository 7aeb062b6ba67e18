// `firmtouch-lab grid`: Table 1 of Baerentzen & Aanaes 2005: building a tree of boxes, a grid of
// distances, both with and without signs, and the signs alone by ray casting.
#include "lab/grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bake/mesh/mesh_tree.hpp"
#include "bake/mesh/pseudonormals.hpp"
#include "bench/problem.hpp"
#include "bench/timing.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "lab/orders/orders.hpp"
#include "lab/trials.hpp"

namespace firmtouch::lab {
namespace {

constexpr uint32_t kSide = 32, kSideLong = 128;  // 128: the paper's
constexpr uint32_t kWaiting = orders::kQueueBoxes + orders::kStackBoxes;

using Points = std::vector<math::Vec3>;

// The paper's query: best-first, a stored vertex for the upper bound, squares to the end.
template <class K>
orders::Nearest nearest_of(const orders::Tree<K>& tree, math::Vec3 p_m, orders::Pending* waiting) {
  orders::Counters ignored;
  orders::Nearest nearest;
  (void)orders::find_nearest<K, orders::Order::kBestFirst, orders::Upper::kVertex, false>(
      tree, p_m, {waiting, kWaiting}, ignored, nearest);
  return nearest;
}

template <class K>
double paper_pass(const orders::Tree<K>& tree, const Points& points, bool is_signed) {
  std::vector<orders::Pending> waiting(kWaiting);
  double sum = 0;
  for (const math::Vec3& p_m : points) {
    const orders::Nearest nearest = nearest_of(tree, p_m, waiting.data());
    const double distance_m = static_cast<double>(math::square_root(nearest.distance2_m2));
    sum += is_signed && orders::is_inside(*tree.mesh, nearest) ? -distance_m : distance_m;
  }
  return sum;
}

double firmware_pass(const mesh::View& view, const Points& points) {
  double sum = 0;
  for (const math::Vec3& p_m : points) {
    mesh::Hint hint;
    sum += static_cast<double>(mesh::closest_point(view, p_m, query::kUnlimited, hint).distance_m);
  }
  return sum;
}

template <class K>
double ray_pass(const orders::Tree<K>& tree, const Points& points) {
  uint32_t inside = 0;
  for (const math::Vec3& p_m : points) inside += orders::crossings(tree, {p_m, kRayAlong}) & 1u;
  return inside;
}

// Seconds: of the hierarchy, and of a whole grid.
struct Column {
  double build_s, build_signed_s, grid_s, grid_signed_s, ray_s;
};

struct Columns {
  Column oriented, aligned, firmware;
};

Columns measure(const Model& model, const Model& plain, const Grown<orders::OrientedKind>& oriented,
                const Grown<orders::FloatKind>& aligned, const Points& points) {
  const auto once = [](const std::function<double()>& work) { return timed(1, work); };
  const mesh::View& view = model.view;
  const std::vector<double> us = medians_us({
      once([&] {
        const tools::Grid grid = tools::make_grid(model.surface);
        return tools::build_mesh_tree(model.surface, grid, tools::kFastTree).depth;
      }),
      once([&] {
        const tools::ExactNormals exact(model.surface);
        return tools::make_pseudonormals(model.surface, exact).vertices.size();
      }),
      once([&] { return Grown<orders::OrientedKind>(view).tree().nodes.size(); }),
      once([&] { return Grown<orders::FloatKind>(view).tree().nodes.size(); }),
      once([&] { return paper_pass(oriented.tree(), points, false); }),
      once([&] { return paper_pass(oriented.tree(), points, true); }),
      once([&] { return paper_pass(aligned.tree(), points, false); }),
      once([&] { return paper_pass(aligned.tree(), points, true); }),
      once([&] { return firmware_pass(plain.view, points); }),
      once([&] { return firmware_pass(view, points); }),
      once([&] { return ray_pass(oriented.tree(), points); }),
      once([&] { return ray_pass(aligned.tree(), points); }),
  });
  const auto s = [&](size_t i) { return us[i] * 1e-6; };
  const double tree_s = s(0), normals_s = s(1);
  return {{tree_s + s(2), tree_s + s(2) + normals_s, s(4), s(5), s(10)},
          {tree_s + s(3), tree_s + s(3) + normals_s, s(6), s(7), s(11)},
          {tree_s, tree_s + normals_s, s(8), s(9), std::nan("")}};
}

std::string seconds(double value) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return std::isnan(value) ? "" : text;
}
std::string percent(double share) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.1f", 100 * (share - 1));
  return text;
}
std::string ratio(double value) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.2f", value);
  return text;
}

std::vector<std::string> row_of(const char* boxes, const Column& c) {
  return {boxes,
          seconds(c.build_s),
          seconds(c.build_signed_s),
          percent(c.build_signed_s / c.build_s),
          seconds(c.grid_s),
          seconds(c.grid_signed_s),
          percent(c.grid_signed_s / c.grid_s),
          seconds(c.ray_s)};
}

// Their table, as ratios: the range over its eight models, and its horse of 60,680 triangles. They
// build a tree of one triangle a leaf for each kind of box; here both take the baker's tree.
void report_ratios(const Columns& c, Report& report) {
  const Column &obb = c.oriented, &aabb = c.aligned;
  report.table(
      {"ratio", "here", "paper, eight models", "paper's horse"},
      {{"build*, oriented / aligned", ratio(obb.build_s / aabb.build_s), "2.2 to 2.9", "2.35"},
       {"build, oriented, with signs / without", ratio(obb.build_signed_s / obb.build_s),
        "1.16 to 1.21", "1.18"},
       {"build, aligned, with signs / without", ratio(aabb.build_signed_s / aabb.build_s),
        "1.35 to 1.53", "1.41"},
       {"grid, oriented / aligned, with signs", ratio(obb.grid_signed_s / aabb.grid_signed_s),
        "0.55 to 0.97", "0.59"},
       {"grid, oriented, with signs / without", ratio(obb.grid_signed_s / obb.grid_s),
        "0.99 to 1.03", "0.99"},
       {"grid, aligned, with signs / without", ratio(aabb.grid_signed_s / aabb.grid_s),
        "1.03 to 1.04", "1.04"},
       {"rays / grid with signs, oriented", ratio(obb.ray_s / obb.grid_signed_s), "0.11 to 0.70",
        "0.14"},
       {"rays / grid with signs, aligned", ratio(aabb.ray_s / aabb.grid_signed_s), "0.39 to 3.77",
        "0.40"},
       {"grid with signs, the firmware / aligned",
        ratio(c.firmware.grid_signed_s / aabb.grid_signed_s), "", ""},
       {"* here: boxes fitted to the baker's tree", "", "", ""}});
}

void report_signs(const Model& model, const Grown<orders::FloatKind>& aligned, const Points& points,
                  Report& report) {
  std::vector<orders::Pending> waiting(kWaiting);
  size_t rays_differ = 0, firmware_differs = 0;
  for (const math::Vec3& p_m : points) {
    const bool inside =
        orders::is_inside(model.view, nearest_of(aligned.tree(), p_m, waiting.data()));
    const bool odd = (orders::crossings(aligned.tree(), {p_m, kRayAlong}) & 1u) != 0;
    mesh::Hint hint;
    const mesh::Closest c = mesh::closest_point(model.view, p_m, query::kUnlimited, hint);
    if (odd != inside) ++rays_differ;
    if ((c.certificate.sign < 0) != inside) ++firmware_differs;
  }
  const std::string of = "of " + std::to_string(points.size()) + " voxels";
  report.figure("signs on which rays, not cast robustly, differ", model.name,
                static_cast<double>(rays_differ), "", of);
  report.figure("signs on which the firmware differs", model.name,
                static_cast<double>(firmware_differs), "", of);
}

}  // namespace

std::vector<math::Vec3> voxels(const Model& model, uint32_t n) {
  const mesh::Head& head = model.view.head();
  double side_m = 0;
  for (int k = 0; k < 3; ++k)
    side_m =
        std::max(side_m, static_cast<double>(head.high_m[k]) - static_cast<double>(head.low_m[k]));
  const auto at = [&](int axis, uint32_t i) {
    const double middle_m =
        (static_cast<double>(head.low_m[axis]) + static_cast<double>(head.high_m[axis])) / 2;
    return static_cast<float>(middle_m + side_m * ((i + 0.5) / n - 0.5));
  };
  std::vector<math::Vec3> points;
  for (uint32_t z = 0; z < n; ++z)
    for (uint32_t y = 0; y < n; ++y)
      for (uint32_t x = 0; x < n; ++x) points.push_back({at(0, x), at(1, y), at(2, z)});
  return points;
}

void run_grid(const Options& options, Report& report) {
  const uint32_t side = options.is_long ? kSideLong : kSide;
  for (const Model& model : load_models(options)) {
    if (model.report.triangles < 2)
      throw Problem(model.name + ": has one triangle; there is nothing to search");
    report.stage("a grid about " + model.name);
    const Model plain = baked_again(model, Sides::kUnsigned);
    const Points points = voxels(model, side);
    const Grown<orders::OrientedKind> oriented(model.view);
    const Grown<orders::FloatKind> aligned(model.view);
    const Columns c = measure(model, plain, oriented, aligned, points);
    const std::string n = std::to_string(side);
    report.heading(model.name + ", " + std::to_string(model.report.triangles) +
                   " triangles, a grid of " + n + " x " + n + " x " + n + " (seconds)");
    report.table({"boxes", "build", "with signs", "+ %", "grid", "with signs", "+ %", "rays"},
                 {row_of("oriented", c.oriented), row_of("float AABB", c.aligned),
                  row_of("the firmware's", c.firmware)});
    report_ratios(c, report);
    report_signs(model, aligned, points, report);
  }
}

}  // namespace firmtouch::lab
