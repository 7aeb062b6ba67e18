#pragma once
#include <vector>

#include "bench/models.hpp"

namespace firmtouch::bench {

struct FloatSegment {
  math::Vec3 a_m, b_m;
};

/// Ends on two different sides of a box twice the model's: the set-up of Platis & Theoharis 2003.
std::vector<FloatSegment> across_box(const Model& model, size_t count, uint64_t seed);
/// Both ends anywhere in 1.1 times the model's box.
std::vector<FloatSegment> anywhere(const Model& model, size_t count, uint64_t seed);

/// Every crossing in double, sorted. Result: false where one grazes an edge or an end, so that
/// doubles do not decide.
bool all_crossings_in_double(const tools::Surface& surface, const FloatSegment& segment,
                             std::vector<double>& t);

}  // namespace firmtouch::bench
