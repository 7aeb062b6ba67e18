#include "host_sim/plant/spline_shape.hpp"

#include <algorithm>
#include <cmath>

#include "bake/spline/piece_point.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr int kCells = 12;      // sample cells per parameter of a piece
constexpr int kShownCells = 8;  // cells of two triangles per parameter of a piece
constexpr double kPi = 3.14159265358979323846;

double at(int i, int cells) { return 2.0 * i / cells - 1; }

// Squared distance after pattern search from (s, t), halving the step where no neighbour is nearer.
double refined2(const spline::View& model, uint32_t piece, double s, double t, Vec p_m) {
  const auto distance2 = [&](double at_s, double at_t) {
    const Vec off = spline_point(model, piece, at_s, at_t) - p_m;
    return dot(off, off);
  };
  double best = distance2(s, t);
  for (double step = 2.0 / kCells; step > 1e-9;) {
    double next = best, next_s = s, next_t = t;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const double to_s = std::clamp(s + i * step, -1.0, 1.0);
        const double to_t = std::clamp(t + j * step, -1.0, 1.0);
        const double d2 = distance2(to_s, to_t);
        if (d2 < next) next = d2, next_s = to_s, next_t = to_t;
      }
    if (next < best) {
      best = next, s = next_s, t = next_t;
    } else {
      step *= 0.5;
    }
  }
  return best;
}

// Signed solid angle of a triangle seen from `p` (Van Oosterom and Strackee 1983).
double solid_angle(Vec p, Vec a, Vec b, Vec c) {
  a = a - p, b = b - p, c = c - p;
  const double la = norm(a), lb = norm(b), lc = norm(c);
  const double below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return 2 * std::atan2(dot(a, cross(b, c)), below);
}

double winding(const Tessellation& tessellation, Vec p) {
  double sum = 0;
  for (const auto& t : tessellation.triangles)
    sum += solid_angle(p, tessellation.vertices[t[0]], tessellation.vertices[t[1]],
                       tessellation.vertices[t[2]]);
  return sum / (4 * kPi);
}

}  // namespace

Vec spline_point(const spline::View& model, uint32_t index, double s, double t) {
  const spline::Piece& piece = model.pieces()[index];
  return tools::point_of_piece(piece, model.coefficients().data() + piece.coefficients, s, t);
}

double spline_distance_m(const spline::View& surface, Vec p_m) {
  struct Start {
    double distance2, s, t;
    uint32_t piece;
  };
  std::vector<Start> starts;
  for (uint32_t piece = 0; piece < surface.pieces().size(); ++piece) {
    Start best{HUGE_VAL, 0, 0, piece};  // in one quarter of the piece
    for (int quarter = 0; quarter < 4; ++quarter) {
      best.distance2 = HUGE_VAL;
      for (int j = 0; j <= kCells / 2; ++j)
        for (int i = 0; i <= kCells / 2; ++i) {
          const double s = at(i + (quarter % 2) * kCells / 2, kCells);
          const double t = at(j + (quarter / 2) * kCells / 2, kCells);
          const Vec off = spline_point(surface, piece, s, t) - p_m;
          if (dot(off, off) < best.distance2) best = {dot(off, off), s, t, piece};
        }
      starts.push_back(best);
    }
  }
  std::sort(starts.begin(), starts.end(),
            [](const Start& a, const Start& b) { return a.distance2 < b.distance2; });
  double best2 = HUGE_VAL;
  for (size_t i = 0; i < std::min<size_t>(starts.size(), 6); ++i)
    best2 = std::min(best2, refined2(surface, starts[i].piece, starts[i].s, starts[i].t, p_m));
  return std::sqrt(best2);
}

Tessellation tessellate(const spline::View& surface) {
  Tessellation tessellation;
  for (uint32_t piece = 0; piece < surface.pieces().size(); ++piece) {
    const uint32_t first = static_cast<uint32_t>(tessellation.vertices.size());
    for (int j = 0; j <= kShownCells; ++j)
      for (int i = 0; i <= kShownCells; ++i)
        tessellation.vertices.push_back(
            spline_point(surface, piece, at(i, kShownCells), at(j, kShownCells)));
    const uint32_t row = kShownCells + 1;
    for (uint32_t j = 0; j < kShownCells; ++j)
      for (uint32_t i = 0; i < kShownCells; ++i) {
        const uint32_t a = first + j * row + i;
        tessellation.triangles.push_back({a, a + 1, a + row + 1});
        tessellation.triangles.push_back({a, a + row + 1, a + row});
      }
  }
  return tessellation;
}

Orientation orientation_of(const Tessellation& tessellation) {
  Vec low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const Vec& p : tessellation.vertices) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double aside_m = 0.02 * norm(high - low);
  size_t looks = 0, whole = 0, turned = 0;
  const size_t stride = std::max<size_t>(1, tessellation.triangles.size() / 64);
  for (size_t i = stride / 2; i < tessellation.triangles.size(); i += stride) {
    const auto& t = tessellation.triangles[i];
    const Vec a = tessellation.vertices[t[0]], b = tessellation.vertices[t[1]],
              c = tessellation.vertices[t[2]];
    const Vec n = cross(b - a, c - a);
    if (!(norm(n) > 0)) continue;
    const Vec aside = unit(n) * aside_m, middle = (a + b + c) * (1.0 / 3);
    const double before = winding(tessellation, middle + aside),
                 behind = winding(tessellation, middle - aside);
    ++looks;
    if (std::abs(before - std::round(before)) < 0.03 &&
        std::abs(behind - std::round(behind)) < 0.03)
      ++whole;
    if (std::abs(before) > std::abs(behind)) ++turned;
  }
  return {looks > 0 && whole == looks, 2 * turned > looks};
}

}  // namespace firmtouch::host_sim
