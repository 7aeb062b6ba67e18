#include "bench/brute_truth.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <set>

#include "batch/parallel.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "surface/random.hpp"
#include "surface/triangle_distance.hpp"

namespace firmtouch::bench {
namespace {

using tools::distance2_to_triangle;
using tools::Point;

double square(Point p) { return dot(p, p); }

// Half the solid angle of the triangle seen from p. Source: van Oosterom & Strackee 1983.
double half_solid_angle(Point u, Point v, Point w) {
  const double lu = length(u), lv = length(v), lw = length(w);
  return std::atan2(dot(u, cross(v, w)),
                    lu * lv * lw + dot(u, v) * lw + dot(v, w) * lu + dot(w, u) * lv);
}

std::vector<BruteTruth> truths(const Model& model, const std::vector<math::Vec3>& points,
                               const std::function<void(const std::string&)>& on_progress) {
  const BruteForce force(model.surface, model.view.is_signed());
  std::vector<BruteTruth> result(points.size());
  double reported = 0;
  tools::in_parallel(
      points.size(), tools::processors(),
      [&](uint64_t i) { result[i] = force.at(tools::to_point(points[i])); },
      [&](double done) {
        if (!on_progress || done < reported + 0.05) return;
        reported = done;
        on_progress("brute force on " + model.name + ", " +
                    std::to_string(static_cast<int>(100 * done)) + " %");
      });
  return result;
}

// Faces of the file at which the surface crosses itself, or where the corners give another sign.
std::set<uint32_t> crossing_faces(const Model& model) {
  std::set<uint32_t> vertices, faces;
  for (const tools::Crossings::Place& place : model.report.signs.crossings.places) {
    vertices.insert(place.vertices.begin(), place.vertices.end());
    for (const auto& edge : place.edges) vertices.insert({edge.first, edge.second});
    for (const uint32_t f : place.faces)
      vertices.insert(model.surface.faces[f].begin(), model.surface.faces[f].end());
  }
  for (uint32_t f = 0; f < model.surface.faces.size(); ++f)
    for (const uint32_t v : model.surface.faces[f])
      if (vertices.count(v) != 0)
        faces.insert(f < model.surface.source.size() ? model.surface.source[f] : f);
  return faces;
}

uint32_t file_face(const Model& model, uint32_t triangle) {
  for (const tools::Section& section : model.sections) {
    uint32_t face = 0;
    if (section.type != mesh::kSourceSection) continue;
    std::memcpy(&face, section.bytes.data() + 4 * triangle, 4);
    return face;
  }
  return triangle;
}

std::string place_of(const mesh::Closest& c, math::Vec3 p, uint32_t face) {
  char text[200];
  std::snprintf(text, sizeof(text), "(%.9g, %.9g, %.9g m), returned %.3g m from face %u",
                static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z),
                static_cast<double>(c.distance_m), face);
  return text;
}

}  // namespace

BruteForce::BruteForce(const tools::Surface& surface, bool with_winding)
    : with_winding_(with_winding) {
  for (const tools::Face& face : surface.faces) {
    Triangle t{tools::to_point(surface.vertices[face[0]]),
               tools::to_point(surface.vertices[face[1]]),
               tools::to_point(surface.vertices[face[2]]),
               {},
               0};
    t.centre = (t.a + t.b + t.c) * (1.0 / 3);
    t.radius_m = std::sqrt(std::max(
                     {square(t.a - t.centre), square(t.b - t.centre), square(t.c - t.centre)})) *
                 (1 + 1e-12);
    triangles_.push_back(t);
  }
}

BruteTruth BruteForce::at(Point p) const {
  double best2 = HUGE_VAL, best = HUGE_VAL, winding = 0;
  for (const Triangle& t : triangles_) {
    if (with_winding_) winding += half_solid_angle(t.a - p, t.b - p, t.c - p);
    const double reach = best * (1 + 1e-12) + t.radius_m;
    if (square(p - t.centre) > reach * reach) continue;
    const double distance2 = distance2_to_triangle(p, t.a, t.b, t.c);
    if (distance2 < best2) best2 = distance2, best = std::sqrt(best2);
  }
  return {best, winding / (2 * M_PI)};
}

std::vector<math::Vec3> truth_points(const Model& model, size_t count, uint64_t seed) {
  tools::Random random(seed);
  std::vector<math::Vec3> points = random_points(model, count - count / 2, seed);
  const auto any = [&] {
    return Point{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
  };
  for (size_t i = 0; points.size() < count; ++i) {
    const tools::Face& face =
        model.surface.faces[random.below(static_cast<uint32_t>(model.surface.faces.size()))];
    const auto corner = [&](size_t k) { return tools::to_point(model.surface.vertices[face[k]]); };
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    if (i % 3 == 1) v = 0;
    if (i % 3 == 2) u = v = 0;
    const double most = i % 5 == 4 ? 4 : -1;
    const double reach =
        model.diagonal_m() * std::pow(10.0, random.between(i % 5 == 4 ? -1 : -7, most));
    points.push_back(tools::to_vec3(corner(0) + (corner(1) - corner(0)) * u +
                                    (corner(2) - corner(0)) * v + any() * reach));
  }
  return points;
}

TruthReport measure_truth(const Model& model, size_t count,
                          const std::function<void(const std::string&)>& on_progress) {
  constexpr size_t kShown = 5;
  const std::vector<math::Vec3> points = truth_points(model, count);
  const std::vector<BruteTruth> truth = truths(model, points, on_progress);
  const std::set<uint32_t> crossing = crossing_faces(model);
  TruthReport report;
  report.points = points.size();
  mesh::Hint hint;
  for (size_t i = 0; i < points.size(); ++i) {
    const mesh::Closest c = model.wide.closest_point(points[i], query::kUnlimited, hint);
    const double scale = std::max(model.diagonal_m(), truth[i].distance_m),
                 reported = std::fabs(static_cast<double>(c.distance_m));
    report.worst_error =
        std::max(report.worst_error, std::fabs(reported - truth[i].distance_m) / scale);
    report.not_exact += c.certificate.exact ? 0u : 1u;
    if (!(static_cast<double>(c.certificate.lower_m) <= truth[i].distance_m + 1e-12 * scale))
      ++report.bounds_above_truth;
    if (!model.view.is_signed() || !(truth[i].distance_m > 2e-6 * model.diagonal_m())) continue;
    if (c.certificate.sign == 0) {
      ++report.unknown_sides;
      continue;
    }
    if ((c.certificate.sign < 0) == (truth[i].winding > 0.5)) continue;
    const uint32_t face = file_face(model, c.triangle);
    const bool is_either = crossing.count(face) != 0;
    std::vector<std::string>& places = is_either ? report.either_places : report.wrong_places;
    ++(is_either ? report.either_side : report.wrong_sides);
    if (places.size() < kShown) places.push_back(place_of(c, points[i], face));
  }
  return report;
}

}  // namespace firmtouch::bench
