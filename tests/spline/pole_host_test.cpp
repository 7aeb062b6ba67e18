// Pieces with an edge that is one point.
#include <algorithm>
#include <cmath>
#include <vector>

#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/pole.hpp"
#include "harness/test.hpp"
#include "spline/baked_model.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace spline_test;
using math::Vec3;
using query::kUnlimited;

double wide(float value) { return static_cast<double>(value); }

// A cubic by a cubic in powers, of which one edge is a point: axis 0 or 1 ends there, at 1 or at -1.
struct Tapering {
  float c[48];
  uint32_t axis;
  bool is_high;

  static uint32_t place(uint32_t axis, uint32_t across, uint32_t along) {
    return 3 * (axis == 0 ? 4 * along + across : 4 * across + along);
  }
  Tapering(tools::Random& random, bool is_round) {
    axis = random.below(2);
    is_high = random.below(2) == 0;
    const double turn = random.between(0.2, 0.8);
    for (uint32_t i = 0; i < 4; ++i)
      for (uint32_t j = 1; j < 4; ++j)
        for (uint32_t k = 0; k < 3; ++k)
          c[place(axis, j, i) + k] = static_cast<float>(
              random.between(-1, 1) / (is_round ? 16.0 : 2.0) / static_cast<double>(i + j));
    if (is_round) {  // a sector of a disc, about
      const double sine[4] = {0, turn, 0, -turn * turn * turn / 6};
      const double cosine[4] = {1, 0, -turn * turn / 2, 0};
      for (uint32_t i = 0; i < 4; ++i) {
        c[place(axis, 1, i)] += static_cast<float>(sine[i]);
        c[place(axis, 1, i) + 1] += static_cast<float>(cosine[i]);
      }
    }
    const float sign = is_high ? 1.0f : -1.0f;
    for (uint32_t i = 0; i < 4; ++i)
      for (uint32_t k = 0; k < 3; ++k) {
        const float sum =
            sign * (c[place(axis, 1, i) + k] + c[place(axis, 3, i) + k]) + c[place(axis, 2, i) + k];
        c[place(axis, 0, i) + k] = i == 0 ? 0.25f : -sum;
      }
  }
  tools::Point at(double across, double along) const {
    double sum[3] = {0, 0, 0}, to_i = 1;
    for (uint32_t i = 0; i < 4; ++i, to_i *= along) {
      double to_j = to_i;
      for (uint32_t j = 0; j < 4; ++j, to_j *= across)
        for (uint32_t k = 0; k < 3; ++k) sum[k] += to_j * wide(c[place(axis, j, i) + k]);
    }
    return {sum[0], sum[1], sum[2]};
  }
};

constexpr float kMaxOff = 1e-6f;

}  // namespace

TEST(NoPointOfAPartAboutAPoleIsNearerThanItsBound) {
  tools::Random random(5);
  int bounds = 0, tight = 0;
  for (int i = 0; i < 20000; ++i) {
    const bool is_round = i % 2 == 0;
    const Tapering piece(random, is_round);
    const tools::Point pole = piece.at(piece.is_high ? 1 : -1, 0);
    const double away = std::exp(random.between(-6, 1.5));
    const tools::Point q{pole.x + random.bell() * away * (is_round ? 0.02 : 1),
                         pole.y + random.bell() * away * (is_round ? 0.02 : 1),
                         pole.z + random.bell() * away};
    const Vec3 q_m = tools::to_vec3(q);
    spline::Pole found;
    CHECK(found.begin(piece.c, q_m, piece.axis, piece.is_high, kMaxOff));
    const double wide_t = std::ldexp(1.0, -static_cast<int>(random.below(5)));
    const double t_low = -1 + 2 * wide_t * random.below(static_cast<uint32_t>(1 / wide_t));
    const double deep = std::ldexp(2.0, -static_cast<int>(random.below(6)));
    float foot = -1;
    const double reported =
        wide(found.lower_m(static_cast<float>(t_low), static_cast<float>(t_low + 2 * wide_t),
                           static_cast<float>(deep), foot));
    CHECK(foot >= 0.0f && wide(foot) <= deep);
    double least = HUGE_VAL, size = 0;
    for (int a = 0; a <= 24; ++a)
      for (int b = 0; b <= 48; ++b) {
        const double y = deep * std::pow(b / 48.0, 3), t = t_low + 2 * wide_t * a / 24;
        const tools::Point off = piece.at(piece.is_high ? 1 - y : y - 1, t) - tools::to_point(q_m);
        least = std::min(least, std::sqrt(dot(off, off)));
        size = std::max(size, std::sqrt(dot(off, off)));
      }
    CHECK_LE(reported, least);
    bounds += reported > 0 ? 1 : 0;
    tight += reported > least * (1 - 1e-4) ? 1 : 0;
  }
  CHECK(bounds > 8000);
  CHECK(tight > 4000);
}

// An edge that is a point but for what is allowed: its own points are not nearer than the bound either.
TEST(WhatAnEdgeIsMoreThanAPointIsTakenOffTheBound) {
  constexpr float kOff = 0.02f;
  tools::Random random(7);
  int bounds = 0;
  for (int i = 0; i < 4000; ++i) {
    Tapering piece(random, true);
    for (uint32_t row = 1; row < 4; ++row)
      for (uint32_t k = 0; k < 3; ++k)
        piece.c[Tapering::place(piece.axis, 0, row) + k] +=
            kOff / 16 * static_cast<float>(random.between(-1, 1));
    const double end = piece.is_high ? 1 : -1;
    const tools::Point pole = piece.at(end, 0);
    const tools::Point q{pole.x + random.bell() * 0.1, pole.y + random.bell() * 0.1,
                         pole.z + random.bell() * 0.1};
    const Vec3 q_m = tools::to_vec3(q);
    spline::Pole found;
    CHECK(found.begin(piece.c, q_m, piece.axis, piece.is_high, kOff));
    float foot;
    const double reported = wide(found.lower_m(-1, 1, 0x1p-10f, foot));
    double least = HUGE_VAL;
    for (int a = 0; a <= 64; ++a) {
      const tools::Point off = piece.at(end, a / 32.0 - 1) - tools::to_point(q_m);
      least = std::min(least, std::sqrt(dot(off, off)));
    }
    CHECK_LE(reported, least);
    bounds += reported > 0 ? 1 : 0;
  }
  CHECK(bounds > 3000);
}

TEST(AnEdgeThatIsNoPointIsNoPole) {
  tools::Random random(6);
  for (int i = 0; i < 1000; ++i) {
    Tapering piece(random, true);
    spline::Pole found;
    const auto is_pole = [&](uint32_t edge) {
      return found.begin(piece.c, Vec3{}, edge >> 1, (edge & 1u) != 0, kMaxOff);
    };
    const uint32_t own = piece.axis << 1 | (piece.is_high ? 1u : 0u);
    for (uint32_t edge = 0; edge < 4; ++edge) CHECK(is_pole(edge) == (edge == own));
    const uint32_t row = 1 + random.below(3), k = random.below(3);
    piece.c[Tapering::place(piece.axis, 0, row) + k] += random.below(2) == 0 ? 1e-5f : -1e-5f;
    CHECK(!is_pole(own));
  }
}

// Four sectors about a pole, past which the queries go at the distance where all of it is nearly as near, and on through it.
TEST(AlongAPathPastAPoleWarmAnswersAreThoseAlone) {
  uint32_t wrong = 0, inexact = 0, dear = 0;
  for (uint32_t seed = 0; seed < 6; ++seed) {
    tools::Random random(seed + 70);
    const double depth = random.between(-0.3, 0.3), rise = random.between(-0.2, 0.2);
    std::vector<tools::SplineSurface> sectors;
    constexpr double kArc = 0.5522847498;
    const double x[4] = {1, 1, kArc, 0}, y[4] = {0, kArc, 1, 1};
    for (int turn = 0; turn < 4; ++turn) {
      tools::SplineSurface s;
      s.degree_u = s.degree_v = 3;
      s.count_u = s.count_v = 4;
      s.knots_u = s.knots_v = {0, 0, 0, 0, 1, 1, 1, 1};
      s.u1 = s.v1 = 1;
      const double c[4] = {1, 0, -1, 0}, n[4] = {0, 1, 0, -1};
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
          const double r = j / 3.0, z = j < 2 ? 0 : (j == 2 ? depth : depth + rise);
          s.points.push_back(
              {r * (c[turn] * x[i] - n[turn] * y[i]), r * (n[turn] * x[i] + c[turn] * y[i]), z, 1});
        }
      sectors.push_back(s);
    }
    const BakedModel baked(of(sectors));
    spline::Hint hint;
    const double slant = random.between(-0.1, 0.1), off = random.between(-0.01, 0.01);
    for (int i = 0; i < 300; ++i) {
      const double at = 0.4 - i * 0.8 / 300;
      const Vec3 p = tools::to_vec3({at, slant * at + off, (depth > 0 ? 1.4 : -1.4) + 0.3 * at});
      const spline::Closest warm = closest_point(baked.view, p, kUnlimited, hint);
      spline::Hint cold;
      const spline::Closest alone = closest_point(baked.view, p, kUnlimited, cold);
      const double truth = wide(alone.distance_m);
      wrong +=
          std::fabs(wide(warm.distance_m) - truth) <= 2.1e-6 * (baked.report.extent_m + truth) &&
                  wide(warm.certificate.lower_m) <= truth
              ? 0u
              : 1u;
      inexact += warm.certificate.exact && alone.certificate.exact ? 0u : 1u;
      dear += warm.evaluations > 6 ? 1u : 0u;
    }
  }
  CHECK_EQ(wrong, 0u);
  CHECK_EQ(inexact, 0u);
  CHECK(dear > 20);  // the bound is asked for
}
