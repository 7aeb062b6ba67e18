#include "bake/pseudonormals.hpp"

#include <algorithm>
#include <cmath>

#include "firmtouch/mesh/pseudonormal.hpp"

namespace firmtouch::tools {
namespace {

struct D3 {
  double x = 0, y = 0, z = 0;
};
D3 operator+(D3 a, D3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
D3 operator-(D3 a, D3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
D3 operator*(D3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
double dot(D3 a, D3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
D3 cross(D3 a, D3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(D3 a) { return std::sqrt(dot(a, a)); }
D3 unit(D3 a) {
  const double l = length(a);
  return l > 0 ? a * (1 / l) : D3{};
}
D3 wide(math::Vec3 v) { return {double{v.x}, double{v.y}, double{v.z}}; }
math::Vec3 narrow(D3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
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
double arc_sine(double s) { return 2 * arc_tangent(s / (1 + std::sqrt(std::max(0.0, 1 - s * s)))); }

// Of two unit vectors, exact near 0 and near pi.
double angle_between(D3 a, D3 b) {
  return 2 * arc_tangent(length(a - b) / std::max(length(a + b), 1e-300));
}

uint32_t encode_vertex_normal(D3 n) {
  const double sum = std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z);
  double u = n.x / sum, v = n.y / sum;
  if (n.z < 0) {
    const double folded = (1 - std::fabs(v)) * (u < 0 ? -1 : 1);
    v = (1 - std::fabs(u)) * (v < 0 ? -1 : 1);
    u = folded;
  }
  const auto code = [](double x) {
    return static_cast<uint32_t>(static_cast<int32_t>(std::floor(x * 32767 + 0.5)) + 32767);
  };
  return code(u) | code(v) << 16;
}

struct Halfedge {
  uint32_t from, to, face, edge;
};

// The face on the other side of each edge, by sorting the edges' ends.
std::vector<std::array<uint32_t, 3>> neighbours(const Surface& surface) {
  std::vector<Halfedge> edges;
  for (uint32_t f = 0; f < surface.faces.size(); ++f)
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t a = surface.faces[f][k], b = surface.faces[f][(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), f, k});
    }
  std::sort(edges.begin(), edges.end(), [](const Halfedge& a, const Halfedge& b) {
    return std::array<uint32_t, 3>{a.from, a.to, a.face} <
           std::array<uint32_t, 3>{b.from, b.to, b.face};
  });
  std::vector<std::array<uint32_t, 3>> others(surface.faces.size());
  for (size_t i = 0; i + 1 < edges.size(); i += 2) {
    others[edges[i].face][edges[i].edge] = edges[i + 1].face;
    others[edges[i + 1].face][edges[i + 1].edge] = edges[i].face;
  }
  return others;
}

// Smallest angle between the plane across `stored` and the directions r from which the vertex is
// the closest point: those with r . e <= 0 for every edge e. The least is reached on a ray of that
// cone, across two of the edges.
double vertex_margin(const std::vector<D3>& edges, D3 exact, D3 stored) {
  double least = 2;
  for (size_t i = 0; i < edges.size(); ++i)
    for (size_t j = i + 1; j < edges.size(); ++j) {
      D3 r = unit(cross(edges[i], edges[j]));
      if (dot(r, r) < 0.5) continue;
      for (int turn = 0; turn < 2; ++turn, r = r * -1.0) {
        bool in_cone = true;
        for (const D3& e : edges) in_cone = in_cone && dot(r, e) <= 1e-12;
        if (!in_cone) continue;
        const double side = dot(exact, r) < 0 ? -1 : 1;
        least = std::min(least, side * dot(stored, r));
      }
    }
  return least;
}

// The same where many faces meet, as at the tip of a finely cut cone: the normals of the faces are
// what the rays come down to at a convex or concave corner.
double fan_margin(const std::vector<D3>& face_normals, D3 exact, D3 stored) {
  double least = 2;
  for (const D3& n : face_normals)
    if (dot(exact, n) > 0) least = std::min(least, dot(stored, n));
  return least;
}

}  // namespace

Pseudonormals make_pseudonormals(const Surface& surface) {
  const size_t faces = surface.faces.size(), vertices = surface.vertices.size();
  std::vector<D3> normals(faces), sums(vertices);
  std::vector<std::vector<D3>> stars(vertices);  // unit edges that leave each vertex
  std::vector<std::vector<D3>> fans(vertices);   // normals of its faces
  const auto corner = [&](size_t f, size_t k) {
    return wide(surface.vertices[surface.faces[f][k % 3]]);
  };
  for (size_t f = 0; f < faces; ++f) {
    normals[f] = unit(cross(corner(f, 1) - corner(f, 0), corner(f, 2) - corner(f, 0)));
    for (size_t k = 0; k < 3; ++k) {
      const D3 next = unit(corner(f, k + 1) - corner(f, k)),
               last = unit(corner(f, k + 2) - corner(f, k));
      D3& sum = sums[surface.faces[f][k]];
      sum = sum + normals[f] * angle_between(next, last);
      stars[surface.faces[f][k]].push_back(next);
      fans[surface.faces[f][k]].push_back(normals[f]);
    }
  }

  Pseudonormals result;
  double least_vertex = 1, least_edge = 1;
  constexpr size_t kLargestStar = 200;  // the margin's search is cubic in the valence
  for (uint32_t v = 0; v < vertices; ++v) {
    const D3 exact = length(sums[v]) > 0 ? unit(sums[v]) : D3{0, 0, 1};
    result.vertices.push_back(encode_vertex_normal(exact));
    const D3 stored = wide(mesh::decode_vertex_normal(result.vertices[v]));
    const double margin = stars[v].size() <= kLargestStar ? vertex_margin(stars[v], exact, stored)
                                                          : fan_margin(fans[v], exact, stored);
    if (margin < least_vertex) least_vertex = margin, result.worst_vertex = v;
  }

  const std::vector<std::array<uint32_t, 3>> others = neighbours(surface);
  for (uint32_t f = 0; f < faces; ++f) {
    mesh::EdgeFolds folds{};
    for (size_t k = 0; k < 3; ++k) {
      const D3 edge = unit(corner(f, k + 1) - corner(f, k)), across = cross(edge, normals[f]);
      const D3 exact = normals[f] + normals[others[f][k]];
      const double along = dot(exact, normals[f]), out = dot(exact, across);
      const double sum = std::fabs(along) + std::fabs(out);
      const double s = sum > 0 ? out / sum : 1;  // a fold of no thickness: straight out
      folds.fold[k] = static_cast<int16_t>(std::floor(s * 32767 + 0.5));
      const D3 stored =
          wide(mesh::decode_edge_normal(narrow(normals[f]), narrow(edge), folds.fold[k]));
      const double margin = std::min(dot(stored, normals[f]), dot(stored, normals[others[f][k]]));
      if (margin < least_edge) least_edge = margin, result.worst_face = f;
    }
    result.edges.push_back(folds);
  }
  result.smallest_vertex_margin_rad = arc_sine(least_vertex);
  result.smallest_edge_margin_rad = arc_sine(least_edge);
  return result;
}

}  // namespace firmtouch::tools
