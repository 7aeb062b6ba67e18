#include "spline/spline_sink.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kMaxWeights = 1e6;  // the largest over the smallest; float32 keeps the rest

std::string text_of(double value) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

}  // namespace

SplineDefect check_knots(const std::vector<double>& knots, int degree, size_t points,
                         const char* which) {
  const std::string name(which);
  if (degree < 1 || degree > kMaxDegree)
    return {"its degree is " + std::to_string(degree) +
                ", but degrees from 1 to 5 are read: approximate it by a lower one at export",
            0};
  const auto order = static_cast<size_t>(degree) + 1;
  if (points < order)
    return {"has " + std::to_string(points) + " control points, but degree " +
                std::to_string(degree) + " needs at least " + std::to_string(order) +
                ": export it again",
            0};
  if (knots.size() != points + order)
    return {"has " + std::to_string(knots.size()) + " " + name + "s, but needs " +
                std::to_string(points + order) + ": export it again",
            0};
  size_t times = 1;
  for (size_t k = 0; k < knots.size(); ++k) {
    const std::string one =
        name + " " + std::to_string(k) + " (from 0), " + text_of(knots[k]) + ",";
    if (!(knots[k] - knots[k] <= 0)) return {one + " is not a finite number: export it again", k};
    if (k > 0 && !(knots[k - 1] <= knots[k]))
      return {one + " is less than the one before, " + text_of(knots[k - 1]) +
                  ": knots must not decrease; export it again",
              k};
    times = k > 0 && knots[k - 1] < knots[k] ? 1 : times + (k > 0);
    if (times > order)
      return {one + " stands " + std::to_string(times) + " times, but degree " +
                  std::to_string(degree) + " allows " + std::to_string(order) +
                  ": remove repeated knots, or cut it in two there",
              k};
  }
  if (!(knots[order - 1] < knots[points]))
    return {"its " + name + "s leave no range: " + name + " " + std::to_string(order - 1) +
                " and " + name + " " + std::to_string(points) + " are equal; export it again",
            order - 1};
  return {};
}

SplineDefect check_weights(const std::vector<ControlPoint>& points) {
  double least = points.front().w, most = least;
  for (size_t i = 0; i < points.size(); ++i) {
    const double w = points[i].w;
    if (!(w > 0) || !(w - w <= 0))
      return {"weight " + std::to_string(i) + " (from 0) is " + text_of(w) +
                  ": weights must be greater than 0; mend or export it again",
              i};
    least = w < least ? w : least;
    most = w > most ? w : most;
  }
  if (!(most <= kMaxWeights * least))
    return {"its weights differ by a factor of " + text_of(most / least) +
                ", more than 1e6: insert knots or approximate it at export",
            0};
  return {};
}

}  // namespace firmtouch::tools
