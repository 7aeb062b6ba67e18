#include "bake/spline/spline_guide.hpp"

#include <algorithm>
#include <cmath>

#include "firmtouch/spline/guide/arc.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kGoal = 1e-5;  // of the length
constexpr int kFine = 16;       // panels of a part, five points each

double length_of(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

// The speed of a stored piece, in double.
double speed_at(const spline::View& model, uint32_t index, double s) {
  const spline::Piece& piece = model.pieces()[index];
  const uint32_t stride = piece.is_rational != 0 ? 4 : 3;
  double value[4] = {0, 0, 0, 0}, first[4] = {0, 0, 0, 0};
  for (uint32_t k = piece.degree_u + 1u; k-- > 0;)
    for (uint32_t i = 0; i < stride; ++i) {
      first[i] = first[i] * s + value[i];
      value[i] = value[i] * s +
                 static_cast<double>(model.coefficients()[piece.coefficients + k * stride + i]);
    }
  if (piece.is_rational == 0) return length_of(first[0], first[1], first[2]);
  double d[3];
  for (size_t i = 0; i < 3; ++i) d[i] = (first[i] - value[i] / value[3] * first[3]) / value[3];
  return length_of(d[0], d[1], d[2]);
}

double length_between(const spline::View& model, uint32_t piece, double low, double high) {
  static const double kAt[5] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                0.9061798459386640};
  static const double kWeight[5] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                    0.4786286704993665, 0.2369268850561891};
  const double half = (high - low) / (2 * kFine);
  double sum = 0;
  for (int panel = 0; panel < kFine; ++panel) {
    const double middle = low + half * (2 * panel + 1);
    for (int i = 0; i < 5; ++i)
      sum += half * kWeight[i] * speed_at(model, piece, middle + half * kAt[i]);
  }
  return sum;
}

// `to_parts[i]` of the finest parts' ends, `step` apart.
std::vector<float> arcs_of(const std::vector<double>& finest, uint32_t step) {
  std::vector<float> arcs;
  for (size_t i = 0; i < finest.size(); i += step) arcs.push_back(static_cast<float>(finest[i]));
  return arcs;
}

// The worst difference from the finest lengths at the ends of the finest parts.
double error_of(const spline::GuideView& guide, const std::vector<double>& finest) {
  double worst_m = 0;
  for (size_t i = 0; i < finest.size(); ++i) {
    const uint32_t piece = std::min(static_cast<uint32_t>(i / spline::kMaxArcIntervals),
                                    guide.model().pieces().size() - 1);
    const double s = 2.0 * static_cast<double>(i - size_t{piece} * spline::kMaxArcIntervals) /
                         spline::kMaxArcIntervals -
                     1;
    const double reported_m =
        static_cast<double>(spline::Arcs(guide).at_m(piece, static_cast<float>(s)));
    worst_m = std::max(worst_m, std::abs(reported_m - finest[i]));
  }
  return worst_m / finest.back();
}

bool is_joined(const spline::View& model, uint32_t before, uint32_t after) {
  const math::Vec3 a = spline::position_of(model, before, 1),
                   b = spline::position_of(model, after, -1);
  const double gap_m = length_of(static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y),
                                 static_cast<double>(b.z - a.z));
  return gap_m <= 0x1p-20 * static_cast<double>(model.head().extent_m);
}

std::vector<spline::Chain> chains_of(const spline::View& model) {
  std::vector<spline::Chain> chains;
  const uint32_t pieces = model.pieces().size();
  for (uint32_t first = 0; first < pieces;) {
    uint32_t last = first;
    while (last + 1 < pieces && is_joined(model, last, last + 1)) ++last;
    const bool is_closed = is_joined(model, last, first);
    chains.push_back({static_cast<uint16_t>(first), static_cast<uint16_t>(is_closed ? 1 : 0)});
    first = last + 1;
  }
  return chains;
}

core::Bytes bytes_of(const Section& section) {
  return {section.bytes.data(), static_cast<uint32_t>(section.bytes.size())};
}

}  // namespace

std::vector<Section> bake_spline_guide(const spline::View& model, const std::string& name,
                                       SplineGuideReport& report) {
  report = {};
  if (model.is_surface()) return {};
  std::vector<double> finest = {0};
  for (uint32_t piece = 0; piece < model.pieces().size(); ++piece)
    for (uint32_t part = 0; part < spline::kMaxArcIntervals; ++part) {
      const double step = 2.0 / spline::kMaxArcIntervals, low = step * part - 1;
      finest.push_back(finest.back() + length_between(model, piece, low, low + step));
    }
  const std::vector<spline::Chain> chains = chains_of(model);
  const Section chains_section = make_section(spline::kChainsSection, name, chains);
  for (uint32_t parts = 1; parts <= spline::kMaxArcIntervals; parts *= 2) {
    const Section arcs_section =
        make_section(spline::kArcsSection, name, arcs_of(finest, spline::kMaxArcIntervals / parts));
    spline::GuideView guide;
    if (!spline::open_guide(model, {bytes_of(arcs_section), bytes_of(chains_section)}, guide).ok())
      continue;
    report.arc_error = error_of(guide, finest);
    if (report.arc_error > kGoal && parts < spline::kMaxArcIntervals) continue;
    report.is_guide = true;
    report.length_m = finest.back();
    report.chains = static_cast<uint32_t>(chains.size());
    for (const spline::Chain& chain : chains) report.closed_chains += chain.is_closed;
    report.parts = parts;
    report.bytes = arcs_section.bytes.size() + chains_section.bytes.size();
    return {arcs_section, chains_section};
  }
  return {};
}

}  // namespace firmtouch::tools
