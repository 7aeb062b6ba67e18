#include "host_sim/bench/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "bake/asset/asset_writer.hpp"
#include "bake/asset/probes.hpp"
#include "bake/curve/bake_curve.hpp"
#include "bake/mesh/bake_mesh.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {
namespace {

using tools::Face;

Solid box(Vec low, Vec high) {
  Solid solid;
  for (const double z : {low.z, high.z})
    for (const auto& [x, y] :
         {std::pair{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}})
      solid.vertices.push_back({x, y, z});
  solid.faces = {{0, 3, 2}, {0, 2, 1}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                 {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  return solid;
}

// A counterclockwise profile in x and z, with its triangles, drawn along y.
Solid extruded(const std::vector<std::pair<double, double>>& profile,
               const std::vector<Face>& triangles, double half_m) {
  Solid solid;
  const uint32_t n = static_cast<uint32_t>(profile.size());
  for (const double y : {-half_m, half_m})
    for (const auto& [x, z] : profile) solid.vertices.push_back({x, y, z});
  for (const Face& t : triangles) {
    solid.faces.push_back(t);
    solid.faces.push_back({n + t[0], n + t[2], n + t[1]});
  }
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t j = (i + 1) % n;
    solid.faces.push_back({i, n + i, j});
    solid.faces.push_back({j, n + i, n + j});
  }
  return solid;
}

std::string bytes_of(std::vector<tools::Section> sections, const tools::LinkageDevice* linkage) {
  if (linkage != nullptr)
    sections.push_back(
        tools::make_section(device::kLinkageSection, "linkage", tools::stored_bytes_of(*linkage)));
  const std::vector<uint8_t> bytes = tools::write_asset(std::move(sections)).bytes;
  return {bytes.begin(), bytes.end()};
}

std::vector<tools::Section> sections_of(const Solid& solid, const Rotation& rotation) {
  const tools::Surface surface = surface_of(solid, rotation);
  tools::MeshReport report;
  std::vector<tools::Section> sections = tools::bake_mesh(surface, "solid", {}, report);
  mesh::View mesh;
  if (!tools::open_baked(sections, "solid", mesh).ok())
    throw Refused("a shape of the bench: " + report.problem);
  sections.push_back(tools::mesh_probes(mesh, "solid"));
  return sections;
}

}  // namespace

Rotation::Rotation(Vec axis, double angle_rad) {
  const Vec u = unit(axis);
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const Vec along[3] = {u * u.x, u * u.y, u * u.z};
  const Vec around[3] = {{0, -u.z, u.y}, {u.z, 0, -u.x}, {-u.y, u.x, 0}};
  const Vec base[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 3; ++i) row_[i] = base[i] * c + around[i] * s + along[i] * (1 - c);
}

Rotation Rotation::after(const Rotation& first) const {
  Rotation all;
  for (int i = 0; i < 3; ++i) all.row_[i] = first.turn_back(row_[i]);
  return all;
}

Solid plate(double thickness_m) { return box({-0.04, -0.04, -thickness_m}, {0.04, 0.04, 0}); }

Solid two_walls() {
  return extruded({{-0.06, 0}, {-0.06, -0.03}, {0.03, -0.03}, {0.03, 0.04}, {0, 0.04}, {0, 0}},
                  {{0, 1, 2}, {0, 2, 5}, {5, 2, 3}, {5, 3, 4}}, 0.06);
}

Solid floor_and_wall() {
  return extruded({{-0.08, 0},
                   {-0.08, -0.04},
                   {0, -0.04},
                   {0.08, -0.04},
                   {0.08, 0.04},
                   {0.04, 0.04},
                   {0.04, 0},
                   {0, 0}},
                  {{0, 1, 7}, {1, 2, 7}, {7, 2, 6}, {2, 3, 6}, {6, 3, 4}, {6, 4, 5}}, 0.06);
}

Solid three_walls() {
  Solid solid;
  std::map<std::tuple<int, int, int>, uint32_t> index;
  const auto vertex = [&](const int(&p)[3]) {
    const auto [found, is_new] =
        index.insert({{p[0], p[1], p[2]}, static_cast<uint32_t>(index.size())});
    if (is_new) solid.vertices.push_back({0.04 * (p[0] - 1), 0.04 * (p[1] - 1), 0.04 * (p[2] - 1)});
    return found->second;
  };
  const auto is_full = [](const int(&cell)[3]) {
    for (const int c : cell)
      if (c < 0 || c > 1) return false;
    return cell[0] + cell[1] + cell[2] < 3;
  };
  for (int cell = 0; cell < 7; ++cell)
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        const int at[3] = {cell >> 2, cell >> 1 & 1, cell & 1};
        int beside[3] = {at[0], at[1], at[2]};
        beside[axis] += side == 1 ? 1 : -1;
        if (is_full(beside)) continue;
        const int u = (axis + 1) % 3, w = (axis + 2) % 3;
        uint32_t quad[4];
        for (int k = 0; k < 4; ++k) {
          int p[3] = {at[0], at[1], at[2]};
          p[axis] += side;
          p[side == 1 ? u : w] += k == 1 || k == 2;
          p[side == 1 ? w : u] += k >= 2;
          quad[k] = vertex(p);
        }
        solid.faces.push_back({quad[0], quad[1], quad[2]});
        solid.faces.push_back({quad[0], quad[2], quad[3]});
      }
  return solid;
}

Solid groove(double half_angle_rad) {
  const double w = 0.01 * std::tan(half_angle_rad), e = std::max(0.04, w + 0.02);
  return extruded({{-e, 0}, {-e, -0.03}, {e, -0.03}, {e, 0}, {w, 0}, {0, -0.01}, {-w, 0}},
                  {{0, 1, 6}, {6, 1, 5}, {5, 1, 2}, {5, 2, 4}, {4, 2, 3}}, 0.06);
}

Solid coarse_ball() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Solid solid;
  for (int i = 0; i < 12; ++i) {
    const double a = i % 2 == 0 ? 1 : -1, b = i % 4 < 2 ? g : -g;
    solid.vertices.push_back(i < 4 ? Vec{0, a, b} : i < 8 ? Vec{a, b, 0} : Vec{b, 0, a});
  }
  // An icosahedron's corners are 2 apart. Each face becomes four, twice.
  for (uint32_t i = 0; i < 12; ++i)
    for (uint32_t j = i + 1; j < 12; ++j)
      for (uint32_t k = j + 1; k < 12; ++k) {
        const Vec a = solid.vertices[i], b = solid.vertices[j], c = solid.vertices[k];
        if (norm(a - b) + norm(b - c) + norm(c - a) > 6.01) continue;
        const bool is_outward = dot(cross(b - a, c - a), a) > 0;
        solid.faces.push_back(is_outward ? Face{i, j, k} : Face{i, k, j});
      }
  for (int round = 0; round < 2; ++round) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middle;
    const auto between = [&](uint32_t i, uint32_t j) {
      const auto [found, is_new] =
          middle.insert({std::minmax(i, j), static_cast<uint32_t>(solid.vertices.size())});
      if (is_new) solid.vertices.push_back(unit(solid.vertices[i] + solid.vertices[j]));
      return found->second;
    };
    std::vector<Face> faces;
    for (const Face& f : solid.faces) {
      const uint32_t x = between(f[0], f[1]), y = between(f[1], f[2]), z = between(f[2], f[0]);
      for (const Face& part : {Face{f[0], x, z}, {x, f[1], y}, {z, y, f[2]}, {x, y, z}})
        faces.push_back(part);
    }
    solid.faces = faces;
  }
  for (Vec& v : solid.vertices) v = unit(v) * 0.02;
  return solid;
}

Solid slot(double width_m) {
  Solid solid = box({-0.05, -0.03, -0.02}, {-width_m / 2, 0.03, 0});
  const Solid other = box({width_m / 2, -0.03, -0.02}, {0.05, 0.03, 0});
  const uint32_t n = static_cast<uint32_t>(solid.vertices.size());
  solid.vertices.insert(solid.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Face& f : other.faces) solid.faces.push_back({n + f[0], n + f[1], n + f[2]});
  return solid;
}

tools::Surface surface_of(const Solid& solid, const Rotation& rotation) {
  tools::Surface surface;
  for (const Vec& v : solid.vertices) surface.vertices.push_back(tools::to_vec3(rotation.turn(v)));
  surface.faces = solid.faces;
  for (uint32_t i = 0; i < surface.faces.size(); ++i) surface.source.push_back(i);
  return surface;
}

std::string asset_of(const Solid& solid, const Rotation& rotation,
                     const tools::LinkageDevice* linkage) {
  return bytes_of(sections_of(solid, rotation), linkage);
}

std::string guide_of(const std::vector<Vec>& points_m, const Rotation& rotation,
                     const tools::LinkageDevice* linkage, const Solid* solid) {
  tools::CurvePoints points;
  for (const Vec& at_m : points_m) points.samples_m.push_back(tools::to_vec3(rotation.turn(at_m)));
  tools::CurveReport report;
  std::vector<tools::Section> sections = tools::bake_curve(points, "guide", report);
  curve::View curve;
  if (!tools::open_baked(sections, "guide", curve).ok())
    throw Refused("a guide of the bench: " + report.problem);
  sections.push_back(tools::curve_probes(curve, "guide"));
  if (solid != nullptr)
    for (tools::Section& section : sections_of(*solid, rotation))
      sections.push_back(std::move(section));
  return bytes_of(std::move(sections), linkage);
}

}  // namespace firmtouch::host_sim
