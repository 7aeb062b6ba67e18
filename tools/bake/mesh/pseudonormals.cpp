#include "bake/mesh/pseudonormals.hpp"

#include <algorithm>
#include <cmath>

#include "bake/mesh/sign_margin.hpp"
#include "bake/mesh/stars.hpp"
#include "firmtouch/mesh/pseudonormal.hpp"
#include "surface/edges.hpp"

namespace firmtouch::tools {
namespace {

// Sine of the margin below which the codes beside the nearest are tried too.
constexpr double kSmallMargin = 0.0175;

Point unit(Point a) {
  const double l = length(a);
  return l > 0 ? a * (1 / l) : Point{};
}

// Our own, so that every machine bakes the same bytes. Halved three times to below 0.2, then its
// series: 1e-15.
double arc_tangent(double x) {
  int halvings = 0;
  for (; halvings < 3; ++halvings) x = x / (1 + std::sqrt(1 + x * x));
  double sum = 0;
  for (int k = 19; k >= 1; k -= 2) sum = (k % 4 == 1 ? 1.0 : -1.0) / k + x * x * sum;
  return 8 * x * sum;
}

// Of two unit vectors, exact near 0 and near pi.
double angle_between(Point a, Point b) {
  return 2 * arc_tangent(length(a - b) / std::max(length(a + b), 1e-300));
}

int32_t nearest(double x, double per_unit = 32767) {
  return static_cast<int32_t>(std::floor(x * per_unit + 0.5));
}

uint32_t vertex_code(int32_t u, int32_t v) {
  return static_cast<uint32_t>(u + 32767) | static_cast<uint32_t>(v + 32767) << 16;
}

// The code nearest to `normal` or, where that leaves little of the margin, the best one around it.
uint32_t encode_vertex_normal(Point normal, const std::vector<SideRay>& rays) {
  const double sum = std::fabs(normal.x) + std::fabs(normal.y) + std::fabs(normal.z);
  double u = normal.x / sum, v = normal.y / sum;
  if (normal.z < 0) {
    const double folded = (1 - std::fabs(v)) * (u < 0 ? -1 : 1);
    v = (1 - std::fabs(u)) * (v < 0 ? -1 : 1);
    u = folded;
  }
  const auto margin = [&](uint32_t code) {
    return vertex_margin(rays, to_point(mesh::decode_vertex_normal(code)));
  };
  uint32_t best = vertex_code(nearest(u), nearest(v));
  double most = margin(best);
  if (most >= kSmallMargin) return best;
  for (int32_t i = std::max(-32767, nearest(u) - 1); i <= std::min(32767, nearest(u) + 1); ++i) {
    for (int32_t k = std::max(-32767, nearest(v) - 1); k <= std::min(32767, nearest(v) + 1); ++k) {
      const double now = margin(vertex_code(i, k));
      if (now > most) most = now, best = vertex_code(i, k);
    }
  }
  return best;
}

// The same for edge k of a face whose normal the firmware computes as `reported`.
int8_t encode_fold(const Surface& surface, const ExactNormals& exact, uint32_t f, uint32_t k,
                   math::Vec3 reported) {
  const Face& face = surface.faces[f];
  const math::Vec3 from = surface.vertices[face[k]], to = surface.vertices[face[(k + 1) % 3]];
  const Point normal = exact.faces[f], other = exact.faces[exact.mates[3 * f + k] / 3],
              across = cross(unit(to_point(to) - to_point(from)), normal);
  const double along = dot(normal + other, normal), out = dot(normal + other, across);
  const double sum = std::fabs(along) + std::fabs(out);
  // A fold of no thickness: straight out.
  const int32_t code = nearest(sum > 0 ? out / sum : 1, static_cast<double>(mesh::kFoldsPerUnit));
  const auto margin = [&](int32_t fold) {
    return edge_margin(
        normal, other,
        to_point(mesh::decode_edge_normal(reported, to - from, static_cast<int8_t>(fold))));
  };
  int32_t best = code;
  double most = margin(code);
  if (most < kSmallMargin) {
    for (const int32_t fold :
         {std::max(-mesh::kMaxFold, code - 1), std::min(mesh::kMaxFold, code + 1)}) {
      const double now = margin(fold);
      if (now > most) most = now, best = fold;
    }
  }
  return static_cast<int8_t>(best);
}

}  // namespace

ExactNormals::ExactNormals(const Surface& surface)
    : faces(surface.faces.size()),
      vertices(surface.vertices.size()),
      mates(Edges(surface.faces).mates()) {
  for (size_t f = 0; f < faces.size(); ++f) {
    const Face& face = surface.faces[f];
    const auto corner = [&](size_t k) { return to_point(surface.vertices[face[k % 3]]); };
    faces[f] = unit(cross(corner(1) - corner(0), corner(2) - corner(0)));
    for (size_t k = 0; k < 3; ++k) {
      const Point next = unit(corner(k + 1) - corner(k)), last = unit(corner(k + 2) - corner(k));
      vertices[face[k]] = vertices[face[k]] + faces[f] * angle_between(next, last);
    }
  }
  for (Point& sum : vertices) sum = length(sum) > 0 ? unit(sum) : Point{0, 0, 1};
}

Pseudonormals make_pseudonormals(const Surface& surface, const ExactNormals& exact) {
  Pseudonormals stored;
  const Stars stars(surface, exact);
  for (uint32_t v = 0; v < surface.vertices.size(); ++v)
    stored.vertices.push_back(
        encode_vertex_normal(exact.vertices[v], extreme_rays(stars.around(v))));
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    const Face& face = surface.faces[f];
    const math::Vec3 reported = mesh::unit_normal(
        surface.vertices[face[0]], surface.vertices[face[1]], surface.vertices[face[2]]);
    mesh::EdgeFolds folds{};
    for (uint32_t k = 0; k < 3; ++k) folds.fold[k] = encode_fold(surface, exact, f, k, reported);
    stored.edges.push_back(folds);
  }
  return stored;
}

}  // namespace firmtouch::tools
