#include "surface/read/stl_facets.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "surface/read/weld.hpp"

namespace firmtouch::tools {
namespace {

// A stored normal more than 60 degrees from the winding's is reported: rounding alone does that
// only to needles that have hardly a direction, and a mirrored or turned part shows all of them.
constexpr double kOdd = 0.5;

bool is_point(const Point& p) { return p.x - p.x <= 0 && p.y - p.y <= 0 && p.z - p.z <= 0; }

// Scaled so that neither tiny nor huge coordinates leave the range of double in a product.
Point scaled(const Point& p) {
  const double size = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  return size > 0 ? Point{p.x / size, p.y / size, p.z / size} : Point{};
}

}  // namespace

bool StlFacets::add(const Point& normal, const Point (&corners)[3], const Place& place) {
  std::vector<int64_t> polygon;
  for (const Point& corner : corners) {
    const double xyz[3] = {corner.x, corner.y, corner.z};
    polygon.push_back(static_cast<int64_t>(sink_.vertex_count()));
    if (!sink_.add_vertex(xyz, place)) return false;
  }
  const uint64_t facet = count_++;
  const Point n = scaled(normal),
              wound =
                  scaled(cross(scaled(corners[1] - corners[0]), scaled(corners[2] - corners[0])));
  const double size = length(n) * length(wound), along = dot(n, wound);
  if (is_point(n) && is_point(wound) && size > 0 && along < kOdd * size) {
    if (opposite_ + oblique_ == 0) first_odd_ = facet;
    ++(along < -kOdd * size ? opposite_ : oblique_);
  }
  return sink_.add_polygon(polygon, place);
}

void StlFacets::finish() {
  if (sink_.failed()) return;
  if (opposite_ + oblique_ != 0) {
    sink_.note("passed over stored normals: of " + std::to_string(count_) + " facets " +
               std::to_string(opposite_) + " have one opposite to the winding of their corners, " +
               std::to_string(oblique_) + " one more than 60 degrees off it, first facet " +
               std::to_string(first_odd_) + " (from 0); the winding counts");
  }
  weld_corners(sink_.surface());
}

}  // namespace firmtouch::tools
