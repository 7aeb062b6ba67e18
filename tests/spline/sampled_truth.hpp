#pragma once
// The nearest point of a spline file by dense sampling and refinement in double, from the file's
// own knots: shares nothing with what is baked.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "spline/spline.hpp"

namespace firmtouch::spline_test {

class SampledTruth {
 public:
  explicit SampledTruth(const tools::SplineModel& model, int samples_a_knot = 48) : model_(model) {
    for (size_t e = 0; e < model.curves.size(); ++e) {
      const tools::SplineCurve& c = model.curves[e];
      for (const double t : parameters(c.knots, c.t0, c.t1, samples_a_knot)) add(e, t, 0);
    }
    for (size_t e = 0; e < model.surfaces.size(); ++e) {
      const tools::SplineSurface& s = model.surfaces[e];
      const auto us = parameters(s.knots_u, s.u0, s.u1, samples_a_knot / 4);
      const auto vs = parameters(s.knots_v, s.v0, s.v1, samples_a_knot / 4);
      for (const double v : vs)
        for (const double u : us) add(e, u, v);
    }
  }

  double distance(const tools::Point& p) const {
    std::vector<std::pair<double, size_t>> near;
    for (size_t i = 0; i < points_.size(); ++i) {
      const tools::Point off = points_[i] - p;
      near.push_back({dot(off, off), i});
    }
    const size_t kept = std::min<size_t>(model_.surfaces.empty() ? 24 : 12, near.size());
    std::nth_element(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(kept) - 1,
                     near.end());
    double best2 = HUGE_VAL;
    for (size_t i = 0; i < kept; ++i) best2 = std::min(best2, refined(p, near[i].second));
    return std::sqrt(best2);
  }
  const std::vector<tools::Point>& points() const { return points_; }

 private:
  struct Place {
    size_t entity;
    double u, v;
  };

  static std::vector<double> parameters(const std::vector<double>& knots, double low, double high,
                                        int each) {
    std::vector<double> made;
    for (size_t i = 0; i + 1 < knots.size(); ++i) {
      const double a = std::max(knots[i], low), b = std::min(knots[i + 1], high);
      if (!(b > a)) continue;
      for (int k = 0; k <= each; ++k) made.push_back(a + (b - a) * k / each);
    }
    return made;
  }
  tools::Point at(const Place& place) const {
    return model_.surfaces.empty() ? point_at(model_.curves[place.entity], place.u)
                                   : point_at(model_.surfaces[place.entity], place.u, place.v);
  }
  void add(size_t entity, double u, double v) {
    places_.push_back({entity, u, v});
    points_.push_back(at(places_.back()));
  }
  // Downhill from a sample, by a pattern that shrinks.
  double refined(const tools::Point& p, size_t from) const {
    Place place = places_[from];
    const bool is_surface = !model_.surfaces.empty();
    double range = 0;
    if (is_surface) {
      const auto& s = model_.surfaces[place.entity];
      range = std::max(s.u1 - s.u0, s.v1 - s.v0);
    } else {
      range = model_.curves[place.entity].t1 - model_.curves[place.entity].t0;
    }
    const auto squared = [&](const Place& q) {
      const tools::Point off = at(q) - p;
      return dot(off, off);
    };
    double best2 = squared(place);
    for (double step = range / 64; step > range * 1e-9; step *= 0.5)
      for (bool moved = true; moved;) {
        moved = false;
        for (int i = -1; i <= 1; ++i)
          for (int j = is_surface ? -1 : 0; j <= (is_surface ? 1 : 0); ++j) {
            Place next = place;
            next.u += step * i;
            next.v += step * j;
            const double found2 = squared(next);  // the parameter is taken into its range
            if (!(found2 < best2)) continue;
            best2 = found2;
            place = next;
            moved = true;
          }
      }
    return best2;
  }

  const tools::SplineModel& model_;
  std::vector<Place> places_;
  std::vector<tools::Point> points_;
};

}  // namespace firmtouch::spline_test
