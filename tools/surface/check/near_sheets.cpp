#include "surface/check/near_sheets.hpp"

#include <algorithm>

#include "surface/check/mending.hpp"
#include "surface/extent.hpp"

namespace firmtouch::tools {
namespace {

// Of kUnresolved, as advised: reading the coordinates may take 1.5e-7 diagonals off at each side.
constexpr double kResolved = 2;
// Of kUnresolved: sheets count where they lie so near along this length, and farther than this from
// convex edges. Next to nothing is nearest to a corner alone, nothing inside to two convex edges.
constexpr double kRegion = 16;
// Of kUnresolved: along this length if they have a corner in common. Their gap opens from it by
// less than a normal may turn (bake/mesh/sign_proof.hpp).
constexpr double kSpike = 2000;
// Sine of the angle from which crossing sheets part at once: those are reported as crossings.
constexpr double kTransverse = 1e-3;
// Cosine of the angle from which faces look away from each other: rounding turns slivers that are
// square to others by less.
constexpr double kOpposite = -0.25;
constexpr double kFlat = 1e-3;  // sine of the turn of an edge that is as good as none
// Of kUnresolved: a hair so thin is as good as a sheet. A thicker one, 1e-7 of its length, is
// taken.
constexpr double kHair = 0.18;
constexpr size_t kMaxPlace = 64;  // faces of a flat place

}  // namespace

// A triangle after five cuts: 8 corners, however they round at most 19.
struct NearSheets::Polygon {
  Point at[20];
  uint32_t size = 0;

  // Leaves the part where dot(normal, p) >= offset.
  void cut(Point normal, double offset) {
    const Polygon whole = *this;
    size = 0;
    for (uint32_t k = 0; k < whole.size; ++k) {
      const Point a = whole.at[k], b = whole.at[(k + 1) % whole.size];
      const double above_a = dot(normal, a) - offset, above_b = dot(normal, b) - offset;
      if (above_a >= 0) at[size++] = a;
      if (above_a * above_b < 0) at[size++] = a + (b - a) * (above_a / (above_a - above_b));
    }
  }

  double diameter() const {
    double most = 0;
    for (uint32_t k = 0; k < size; ++k)
      for (uint32_t j = 0; j < k; ++j) most = std::max(most, length(at[k] - at[j]));
    return most;
  }
};

NearSheets::NearSheets(const Surface& surface, const NearFaces& near_faces,
                       const std::vector<uint32_t>& mates)
    : surface_(surface), near_faces_(near_faces), mates_(mates) {
  const Extent extent = extent_of(surface);
  unresolved_m_ = kUnresolved * length(extent.high - extent.low);
  normals_.reserve(surface.faces.size());
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    const Point normal = cross(point(f, 1) - point(f, 0), point(f, 2) - point(f, 0));
    const double size = length(normal);
    normals_.push_back(size > 0 ? normal * (1 / size) : Point{});
    const double longest_m =
        std::max({length(point(f, 1) - point(f, 0)), length(point(f, 2) - point(f, 1)),
                  length(point(f, 0) - point(f, 2))});
    is_needle_.push_back(size < unresolved_m_ * longest_m);
  }
}

void NearSheets::look_at(uint32_t f, const std::vector<uint32_t>& near) {
  for (const uint32_t g : near) {
    if (g <= f || !(dot(normals_[f], normals_[g]) < kOpposite)) continue;
    if (is_needle_[f] != is_needle_[g]) continue;
    if (is_clear_of_plane(f, g) || is_clear_of_plane(g, f)) continue;
    const uint32_t common = common_vertices(f, g);
    const double along_m = (common == 0 ? kRegion : kSpike) * unresolved_m_;
    if (common > 1 || (!lies_on(f, g, along_m) && !lies_on(g, f, along_m))) continue;
    found_.push_back({f, g});
    found_.push_back({g, f});
  }
}

void NearSheets::refuse(CheckReport& report) const {
  if (found_.empty()) return;
  const std::pair<uint32_t, uint32_t> first = *std::min_element(found_.begin(), found_.end());
  std::vector<uint32_t> faces;
  for (const auto& pair : found_) faces.push_back(pair.first);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  const auto text = [&](double length_m) { return surface_.frame.length_text(length_m); };
  report.refused.push_back("has " + counted(faces.size(), "face", "faces") + " within " +
                           text(unresolved_m_) + " of a face that looks the other way, first " +
                           named_face(surface_, first.first) + ", and " +
                           named_face(surface_, first.second) +
                           ": float32 cannot resolve which is nearer, so the sign is ambiguous "
                           "there; unite the sheets or "
                           "part them by " +
                           text(kResolved * unresolved_m_) + " in a modelling program");
}

uint32_t NearSheets::common_vertices(uint32_t f, uint32_t g) const {
  uint32_t count = 0;
  for (const uint32_t v : surface_.faces[f])
    for (const uint32_t w : surface_.faces[g]) count += v == w ? 1u : 0u;
  return count;
}

bool NearSheets::is_clear_of_plane(uint32_t f, uint32_t g) const {
  const double a = height(f, point(g, 0)), b = height(f, point(g, 1)), c = height(f, point(g, 2));
  return std::min({a, b, c}) > unresolved_m_ || std::max({a, b, c}) < -unresolved_m_;
}

bool NearSheets::is_convex_edge(uint32_t f, uint32_t k) const {
  const uint32_t mate = mates_[3 * f + k];
  if (mate == kNone) return false;
  const Point over = point(mate / 3, mate % 3 + 2) - point(f, k),
              along = point(f, k + 1) - point(f, k);
  const double depth_m = -dot(normals_[f], over);
  return depth_m > kHair * unresolved_m_ &&
         depth_m * length(along) > kFlat * length(cross(along, over));
}

// What of g lies over or under f, farther than the margin from convex edges of f.
NearSheets::Polygon NearSheets::beside(uint32_t f, uint32_t g, double margin_m) const {
  Polygon polygon{{point(g, 0), point(g, 1), point(g, 2)}, 3};
  for (uint32_t k = 0; k < 3; ++k) {
    const Point along = point(f, k + 1) - point(f, k);
    const Point inward = cross(normals_[f], along * (1 / length(along)));
    const double margin = margin_m > 0 && is_convex_edge(f, k) ? margin_m : 0;
    polygon.cut(inward, dot(inward, point(f, k)) + margin);
  }
  return polygon;
}

bool NearSheets::crosses(uint32_t f, uint32_t g) const {
  const Polygon polygon = beside(f, g, 0);
  bool any_above = false, any_below = false;
  for (uint32_t k = 0; k < polygon.size; ++k) {
    any_above = any_above || height(f, polygon.at[k]) > 0;
    any_below = any_below || height(f, polygon.at[k]) < 0;
  }
  return any_above && any_below;
}

bool NearSheets::crosses_any(uint32_t f) const {
  std::vector<uint32_t> near;
  near_faces_.within(f, 0, near);
  return std::any_of(near.begin(), near.end(),
                     [&](uint32_t g) { return common_vertices(f, g) == 0 && crosses(f, g); });
}

// Whether the mate of edge k of f goes on in the plane of `normal`: a needle has none of its own.
bool NearSheets::goes_on(uint32_t f, uint32_t k, Point normal) const {
  const uint32_t mate = mates_[3 * f + k];
  const Point along = point(f, k + 1) - point(f, k);
  const Point over = point(mate / 3, mate % 3 + 2) - point(f, k);
  const double depth_m = std::fabs(dot(normal, over));
  return depth_m <= kHair * unresolved_m_ ||
         depth_m * length(along) <= kFlat * length(cross(along, over));
}

// Faces that are in one plane with f, f among them.
std::vector<uint32_t> NearSheets::place_of(uint32_t f) const {
  std::vector<uint32_t> place{f};
  for (size_t i = 0; i < place.size() && place.size() < kMaxPlace; ++i) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t mate = mates_[3 * place[i] + k];
      if (mate == kNone || !goes_on(place[i], k, normals_[f])) continue;
      if (std::find(place.begin(), place.end(), mate / 3) == place.end()) place.push_back(mate / 3);
    }
  }
  return place;
}

// Whether all points lie beside one edge that the places of both faces share: slivers may part
// f and g from it, which are near each other there as the sides of any edge.
bool NearSheets::is_beside_common_edge(uint32_t f, uint32_t g, const Polygon& polygon) const {
  const std::vector<uint32_t> place = place_of(f), other = place_of(g);
  for (const uint32_t a : place) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t mate = mates_[3 * a + k];
      if (mate == kNone || goes_on(a, k, normals_[f])) continue;
      if (std::find(other.begin(), other.end(), mate / 3) == other.end()) continue;
      const Point along = point(a, k + 1) - point(a, k);
      const auto is_beside = [&](Point p) {
        return length(cross(along, p - point(a, k))) <= kRegion * unresolved_m_ * length(along);
      };
      if (std::all_of(polygon.at, polygon.at + polygon.size, is_beside)) return true;
    }
  }
  return false;
}

// Whether g lies so near along this length.
bool NearSheets::lies_on(uint32_t f, uint32_t g, double along_m) const {
  const double plane = dot(normals_[f], point(f, 0));
  Polygon polygon = beside(f, g, kRegion * unresolved_m_);
  polygon.cut(normals_[f], plane - unresolved_m_);
  polygon.cut(normals_[f] * -1, -plane - unresolved_m_);
  if (!(polygon.diameter() > along_m)) return false;
  if (is_beside_common_edge(f, g, polygon)) return false;
  const bool is_transverse = length(cross(normals_[f], normals_[g])) > kTransverse;
  return !is_transverse || !(crosses_any(f) || crosses_any(g));
}

}  // namespace firmtouch::tools
