#include "bake/mesh/sign_proof.hpp"

#include <algorithm>
#include <cmath>

#include "bake/mesh/stars.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/pseudonormal.hpp"
#include "surface/check/near_sheets.hpp"
#include "surface/winding_number.hpp"

namespace firmtouch::tools {
namespace {

// How far from a feature its side is compared: of the shortest edge there, far above rounding and
// far below the next sheet.
constexpr double kBeside = 1e-7;

// The triangles beside a thin one measure its edges by themselves, so that its height does not
// separate these below kUnresolved. By how much its normals may be wrong all the same: then only
// for queries within 0.15 rad of a side's normal, for which the distances to its edges differ by
// the whole height.
constexpr double kMaxConfused_rad = 0.15;

void take(SignProof::Kind& kind, uint32_t feature, double sine, double min_rad,
          const std::vector<bool>& excused) {
  if (!excused.empty() && excused[feature]) return;
  const double margin_rad = std::asin(std::max(-1.0, std::min(1.0, sine)));
  // Written so that NaN is weak.
  if (!(margin_rad >= kind.smallest_rad)) kind.smallest_rad = margin_rad;
  if (!(sine >= min_rad)) kind.weak.push_back(feature);
}

math::Vec3 reported_face_normal(const Surface& surface, uint32_t f) {
  const Face& face = surface.faces[f];
  return mesh::unit_normal(surface.vertices[face[0]], surface.vertices[face[1]],
                           surface.vertices[face[2]]);
}

Point reported_edge_normal(const Surface& surface, const Pseudonormals& stored, uint32_t h) {
  const Face& face = surface.faces[h / 3];
  const uint32_t k = h % 3;
  const math::Vec3 edge = surface.vertices[face[(k + 1) % 3]] - surface.vertices[face[k]];
  return to_point(mesh::decode_edge_normal(reported_face_normal(surface, h / 3), edge,
                                           stored.edges[h / 3].fold[k]));
}

double shortest_edge(const Surface& surface, const Face& face) {
  const Point a = to_point(surface.vertices[face[0]]), b = to_point(surface.vertices[face[1]]),
              c = to_point(surface.vertices[face[2]]);
  return std::min({length(b - a), length(c - b), length(a - c)});
}

// Whether the surface winds around the point as often as `told` says: once inside, never outside.
bool agrees(const WindingNumber& winding, Point at, bool reported_outside) {
  return winding.at(at) == (reported_outside ? 0 : 1);
}

// Triangles so thin that their features are taken for one another: each stored normal there must
// give the sign of the others' points too.
class Confusion {
 public:
  Confusion(const Surface& surface, const ExactNormals& exact, const Pseudonormals& stored)
      : surface_(surface),
        exact_(exact),
        stored_(stored),
        within_m_(confusion_m(surface)),
        unresolved_m_(kUnresolved * diagonal_m(surface.vertices)) {}

  bool is_thin(uint32_t f) const { return is_lower(f, within_m_); }
  // Whether distances do not separate its edges.
  bool is_unresolved(uint32_t f) const { return is_lower(f, unresolved_m_); }

  // Whether the firmware's own arithmetic (mesh/triangle.hpp) turns the height of the triangle, by
  // which it separates the features.
  bool loses_height(uint32_t f) const {
    const Face& face = surface_.faces[f];
    const Point base = corner(face, 1) - corner(face, 0), side = corner(face, 2) - corner(face, 0);
    const Point exact = side - base * (dot(side, base) / dot(base, base));
    const math::Vec3 a = surface_.vertices[face[0]], ab = surface_.vertices[face[1]] - a,
                     ac = surface_.vertices[face[2]] - a;
    const Point reported = to_point(ac - ab * (dot(ab, ac) * (1.0f / dot(ab, ab))));
    return !(dot(reported, exact) > 0.99 * length(reported) * length(exact));
  }

  // Around a thin face only directions across its length are in question; the surface turns there
  // from one to the other of the faces beside it, whatever the thin one's own normal is.
  double thin_margin(uint32_t f) const {
    const Face& face = surface_.faces[f];
    const Point base = corner(face, 1) - corner(face, 0), along = base * (1 / length(base));
    std::vector<Point> sides;
    collect(f, along, sides);
    double least = 1;
    const auto check = [&](Point reported) {
      for (const Point& normal : sides)
        least = std::min(least, edge_margin(normal, normal, reported));
    };
    check(to_point(reported_face_normal(surface_, f)));
    for (uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
      const Point edge = corner(face, h % 3 + 1) - corner(face, h % 3);
      if (length(cross(edge, along)) > kAlong * length(edge)) continue;
      check(reported_edge_normal(surface_, stored_, h));
      check(reported_edge_normal(surface_, stored_, exact_.mates[h]));
    }
    const double at = dot(corner(face, 2) - corner(face, 0), along);
    if (at > within_m_ && at < length(base) - within_m_)
      check(to_point(mesh::decode_vertex_normal(stored_.vertices[face[2]])));
    return least;
  }

 private:
  static constexpr double kAlong = 1e-3;
  static constexpr int kRings = 3;  // thin faces beside thin faces

  Point corner(const Face& face, uint32_t k) const {
    return to_point(surface_.vertices[face[k % 3]]);
  }
  bool is_lower(uint32_t f, double height_m) const {
    const Face& face = surface_.faces[f];
    const Point base = corner(face, 1) - corner(face, 0), side = corner(face, 2) - corner(face, 0);
    return !(length(cross(base, side)) > height_m * length(base));
  }

  void collect(uint32_t f, Point along, std::vector<Point>& sides) const {
    std::vector<uint32_t> ring{f}, seen{f};
    for (int depth = 0; depth < kRings && !ring.empty(); ++depth) {
      std::vector<uint32_t> next;
      for (const uint32_t thin : ring) {
        for (uint32_t h = 3 * thin; h < 3 * thin + 3; ++h) {
          const uint32_t g = exact_.mates[h] / 3;
          if (std::find(seen.begin(), seen.end(), g) != seen.end()) continue;
          seen.push_back(g);
          if (is_thin(g))
            next.push_back(g);
          else if (std::fabs(dot(exact_.faces[g], along)) <= kAlong)
            sides.push_back(exact_.faces[g]);
        }
      }
      ring = next;
    }
  }

  const Surface& surface_;
  const ExactNormals& exact_;
  const Pseudonormals& stored_;
  double within_m_, unresolved_m_;
};

}  // namespace

double confusion_m(const Surface& surface) {
  double longest2 = 0;
  for (const Face& face : surface.faces) {
    const Point edge = to_point(surface.vertices[face[1]]) - to_point(surface.vertices[face[0]]);
    longest2 = std::max(longest2, dot(edge, edge));
  }
  return 0x1p-24 * (13 * diagonal_m(surface.vertices) + 21 * std::sqrt(longest2));
}

SignProof prove_signs(const Surface& surface, const ExactNormals& exact,
                      const Pseudonormals& stored, double min_rad, const Excused& excused) {
  SignProof proof;
  const Stars stars(surface, exact);
  const Confusion confusion(surface, exact, stored);
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    const bool is_thin = confusion.is_thin(f);
    const double thin_margin = is_thin ? confusion.thin_margin(f) : 1;
    if (!(thin_margin >= min_rad)) proof.slivers.push_back(f);
    const bool is_confused =
        is_thin && !(thin_margin >= -kMaxConfused_rad) && confusion.is_unresolved(f);
    if (is_confused || (is_thin && confusion.loses_height(f))) {
      // Not excused where it crosses others: its sides would reach far beyond the place.
      take(proof.faces, f, thin_margin, min_rad, {});
    } else {
      take(proof.faces, f, dot(to_point(reported_face_normal(surface, f)), exact.faces[f]), min_rad,
           excused.faces);
    }
    for (uint32_t h = 3 * f; h < 3 * f + 3; ++h)
      take(proof.edges, h,
           edge_margin(exact.faces[f], exact.faces[exact.mates[h] / 3],
                       reported_edge_normal(surface, stored, h)),
           min_rad, excused.edges);
  }
  for (uint32_t v = 0; v < surface.vertices.size(); ++v)
    take(proof.vertices, v,
         vertex_margin(extreme_rays(stars.around(v)),
                       to_point(mesh::decode_vertex_normal(stored.vertices[v]))),
         min_rad, excused.vertices);
  return proof;
}

DifferingSides compare_with_winding(const Surface& surface, const ExactNormals& exact,
                                    const Pseudonormals& stored) {
  const WindingNumber winding(surface, {});
  DifferingSides differing;
  std::vector<double> reach(surface.vertices.size(), HUGE_VAL);
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    const Face& face = surface.faces[f];
    const double shortest = shortest_edge(surface, face), lift = kBeside * shortest;
    const auto corner = [&](uint32_t k) { return to_point(surface.vertices[face[k % 3]]); };
    for (const uint32_t v : face) reach[v] = std::min(reach[v], kBeside * shortest);
    const auto both_sides_agree = [&](Point spot, Point normal, Point reported) {
      const bool is_up = dot(normal, reported) >= 0;
      return agrees(winding, spot + normal * lift, is_up) &&
             agrees(winding, spot - normal * lift, !is_up);
    };
    ++differing.compared;
    if (!both_sides_agree((corner(0) + corner(1) + corner(2)) * (1.0 / 3), exact.faces[f],
                          to_point(reported_face_normal(surface, f))))
      differing.faces.push_back(f);
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t h = 3 * f + k;
      if (exact.mates[h] < h) continue;
      // Of an edge only the side of its wedge is ever nearest to it.
      Point normal = exact.of_edge(h);
      const double size = length(normal);
      if (!(size > 0)) continue;
      normal = normal * (1 / size);
      const Point along = corner(k + 1) - corner(k);
      const bool is_convex = dot(cross(exact.faces[f], exact.faces[exact.mates[h] / 3]), along) > 0;
      const Point ray = normal * (is_convex ? 1.0 : -1.0);
      ++differing.compared;
      if (!agrees(winding, (corner(k) + corner(k + 1)) * 0.5 + ray * lift,
                  dot(ray, reported_edge_normal(surface, stored, h)) >= 0))
        differing.edges.push_back(h);
    }
  }
  const Stars stars(surface, exact);
  for (uint32_t v = 0; v < surface.vertices.size(); ++v) {
    const std::vector<SideRay> rays = extreme_rays(stars.around(v));
    const Point at = to_point(surface.vertices[v]),
                reported = to_point(mesh::decode_vertex_normal(stored.vertices[v]));
    if (!rays.empty()) ++differing.compared;
    // The rays of a flat vertex have no inside between them: each is looked at by itself.
    const bool all_agree = std::all_of(rays.begin(), rays.end(), [&](const SideRay& ray) {
      return agrees(winding, at + ray.direction * reach[v], dot(reported, ray.direction) >= 0);
    });
    if (!all_agree) differing.vertices.push_back(v);
  }
  return differing;
}

}  // namespace firmtouch::tools
