#include "bake/curve/bake_curve.hpp"

#include <algorithm>
#include <cmath>

#include "bake/curve/curve_runs.hpp"
#include "bake/curve/curve_tree.hpp"
#include "firmtouch/curve/derived.hpp"

namespace firmtouch::tools {
namespace {

double distance_m(const curve::Sample& a, const curve::Sample& b) {
  const double x = double{a.x_m} - double{b.x_m}, y = double{a.y_m} - double{b.y_m},
               z = double{a.z_m} - double{b.z_m};
  return std::sqrt(x * x + y * y + z * z);
}

std::vector<float> arc_positions(const std::vector<curve::Sample>& samples, CurveReport& report) {
  std::vector<double> travelled_m(samples.size());
  report.shortest_segment_m = HUGE_VAL;
  for (size_t i = 1; i < samples.size(); ++i) {
    const double segment_m = distance_m(samples[i - 1], samples[i]);
    travelled_m[i] = travelled_m[i - 1] + segment_m;
    report.shortest_segment_m = std::min(report.shortest_segment_m, segment_m);
    report.longest_segment_m = std::max(report.longest_segment_m, segment_m);
  }
  report.length_m = travelled_m.back();
  std::vector<float> arcs(samples.size());
  for (size_t i = 0; i < samples.size(); ++i)
    arcs[i] = static_cast<float>(travelled_m[i] / report.length_m);
  return arcs;
}

curve::Head make_head(const std::vector<curve::Sample>& samples, double length_m) {
  curve::Head head{};
  head.sample_count = static_cast<uint32_t>(samples.size());
  head.is_closed = !(distance_m(samples.front(), samples.back()) > 0) ? 1 : 0;
  for (size_t k = 0; k < 3; ++k) head.low_m[k] = head.high_m[k] = (&samples[0].x_m)[k];
  for (const curve::Sample& s : samples) {
    for (size_t k = 0; k < 3; ++k) {
      head.low_m[k] = std::min(head.low_m[k], (&s.x_m)[k]);
      head.high_m[k] = std::max(head.high_m[k], (&s.x_m)[k]);
    }
  }
  head.diagonal_m = curve::diagonal_m(head);
  head.length_m = static_cast<float>(length_m);
  for (size_t i = 1; i < samples.size(); ++i)
    head.longest_half_m =
        std::max(head.longest_half_m, curve::half_segment_m(samples[i - 1], samples[i]));
  return head;
}

// How far the pieces' Bezier points lie beyond the samples' box, in its extents.
float beyond_of(const std::vector<curve::Sample>& samples, const curve::Head& head) {
  const curve::Track track{samples.data(), head.sample_count, head.is_closed != 0};
  float max_m = 0, extent_m = 0;
  for (size_t k = 0; k < 3; ++k) {
    extent_m = std::max(extent_m, head.high_m[k] - head.low_m[k]);
    for (uint32_t s = 0; s + 1 < head.sample_count; ++s) {
      const curve::Cubic c = curve::cubic_of(track, s);
      for (const math::Vec3& off : {c.c1, c.c2}) {
        const float at_m = (&samples[s].x_m)[k] + (&off.x)[k];
        max_m = std::max({max_m, head.low_m[k] - at_m, at_m - head.high_m[k]});
      }
    }
  }
  return max_m / extent_m;
}

// A sample is stored up to u of its distance from the origin off, with u = 2^-24. That turns a
// short step, whose direction is nearly the tangent of a long piece beside it (curve/cubic.hpp,
// slope_at()). A slope that turns by an angle moves a Bezier point by a third of the piece times as
// much, and the piece by 4/9 of that.
void find_turned(const std::vector<curve::Sample>& samples, const std::vector<uint32_t>& rows,
                 bool is_closed, CurveReport& report) {
  const auto size_m = [](const curve::Sample& s) { return distance_m(s, {0, 0, 0}); };
  const size_t last = samples.size() - 1;
  for (size_t i = is_closed ? 0 : 1; i < last; ++i) {
    const size_t i_before = i == 0 ? last - 1 : i - 1;
    const curve::Sample &at = samples[i], &before = samples[i_before], &after = samples[i + 1];
    const double before_m = distance_m(before, at), after_m = distance_m(at, after);
    const bool is_first_short = before_m < after_m;
    const double step_m = std::min(before_m, after_m), piece_m = std::max(before_m, after_m);
    const double lost_m = 0x1p-24 * (size_m(at) + size_m(is_first_short ? before : after));
    const double turned_m = 4.0 / 27 * lost_m / step_m * piece_m * piece_m / (step_m + piece_m);
    if (turned_m <= report.turned_m) continue;
    report.turned_m = turned_m;
    report.turned_step_m = step_m;
    report.turned_piece_m = piece_m;
    report.turned_row = rows[is_first_short ? i_before : i];
  }
}

bool has_gaps(const std::vector<uint32_t>& rows) {
  for (size_t i = 0; i < rows.size(); ++i)
    if (rows[i] != i) return true;
  return false;
}

uint32_t levels_of(uint32_t count) {
  uint32_t levels = 0;
  for (; count != 0; count /= 2) ++levels;
  return levels;
}

}  // namespace

std::vector<Section> bake_curve(const CurvePoints& points, const std::string& name,
                                CurveReport& report) {
  report = {};
  CurvePoints mended = points;  // a caller's own points may not have been looked at
  if (mended.rows.size() != mended.samples_m.size()) {
    mended.rows.resize(mended.samples_m.size());
    for (size_t i = 0; i < mended.rows.size(); ++i) mended.rows[i] = static_cast<uint32_t>(i);
  }
  mend_curve(mended, name);
  report.problem = mended.problem;
  if (!report.problem.empty()) return {};

  std::vector<curve::Sample> samples;
  samples.reserve(mended.samples_m.size());
  for (const math::Vec3& s : mended.samples_m) samples.push_back({s.x, s.y, s.z});
  const std::vector<float> arcs = arc_positions(samples, report);
  curve::Head head = make_head(samples, report.length_m);
  head.is_smooth = mended.is_smooth ? 1 : 0;
  head.run_levels =
      mended.run_levels != 0 ? mended.run_levels : choose_run_levels(head.sample_count);
  if (!choose_grid(head, mended.is_smooth ? beyond_of(samples, head) : 0)) {
    report.problem = name +
                     (mended.is_smooth ? ": too few samples for smooth pieces, or the" : ": the") +
                     " curve lies too far from the origin for its size: float32 does not separate "
                     "its points; move it nearer to the origin";
    return {};
  }
  if (mended.is_smooth) find_turned(samples, mended.rows, head.is_closed != 0, report);
  std::vector<Section> sections;
  sections.push_back(make_section(curve::kHeadSection, name, &head, 1));
  sections.push_back(make_section(curve::kSamplesSection, name, samples));
  sections.push_back(make_section(curve::kArcsSection, name, arcs));
  const CurveRuns runs = build_curve_runs(samples, head);
  sections.push_back(make_section(curve::kBoxesSection, name, runs.boxes));
  sections.push_back(make_section(curve::kRunsSection, name, runs.runs));
  sections.push_back(make_section(curve::kRadiiSection, name, runs.radii));
  for (const Section& section : sections) report.tick_bytes += section.bytes.size();
  report.bytes = report.tick_bytes;
  if (mended.with_tree) {
    sections.push_back(make_section(curve::kTreeSection, name, build_curve_tree(samples)));
    report.bytes += sections.back().bytes.size();
  }
  if (has_gaps(mended.rows)) {
    sections.push_back(make_section(curve::kRowsSection, name, mended.rows));
    report.bytes += sections.back().bytes.size();
  }
  report.samples = head.sample_count;
  report.levels = levels_of(2 * curve::run_count_of(head.sample_count, head.run_levels) - 1);
  report.is_closed = head.is_closed == 1;

  curve::View view;
  const core::Verdict verdict = open_baked(sections, name, view);
  if (!verdict.ok()) {
    report.problem = name + ": the baked curve breaks rule R" + std::to_string(verdict.rule) +
                     " at element " + std::to_string(verdict.element) +
                     ": this is a defect of the baker; please report it with the file";
    return {};
  }
  return sections;
}

}  // namespace firmtouch::tools
