#pragma once
#include <vector>

#include "surface/point.hpp"

namespace firmtouch::lab {

/// Unit normal of the plane with the least squared distances to the points, either way.
tools::Point normal_of_best_plane(const std::vector<tools::Point>& points);

/// The point of the convex hull of `points` that is nearest to the origin: (0, 0, 0) where the hull
/// holds the origin.
/// Source: Gilbert, Johnson, Keerthi 1988, with the nearest point of each simplex by trying all its
///         faces.
tools::Point nearest_of_hull(const std::vector<tools::Point>& points);

}  // namespace firmtouch::lab
