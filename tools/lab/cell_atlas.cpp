#include "lab/cell_atlas.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::lab {
namespace {

using Poly = std::vector<double>;  // Bernstein coefficients

double choose(size_t n, size_t k) {
  double product = 1;
  for (size_t i = 0; i < k; ++i)
    product = product * static_cast<double>(n - i) / static_cast<double>(i + 1);
  return product;
}

Poly times(const Poly& a, const Poly& b) {
  const size_t m = a.size() - 1, n = b.size() - 1;
  Poly c(m + n + 1, 0);
  for (size_t i = 0; i <= m; ++i)
    for (size_t j = 0; j <= n; ++j)
      c[i + j] += choose(m, i) * choose(n, j) / choose(m + n, i + j) * a[i] * b[j];
  return c;
}
Poly plus(const Poly& a, const Poly& b, double factor = 1) {
  Poly c = a;
  for (size_t i = 0; i < c.size(); ++i) c[i] += factor * b[i];
  return c;
}
Poly derived(const Poly& a) {
  Poly c;
  for (size_t i = 0; i + 1 < a.size(); ++i)
    c.push_back(static_cast<double>(a.size() - 1) * (a[i + 1] - a[i]));
  return c;
}
// Of the same degree as it was.
Poly raised(const Poly& a) {
  const auto n = static_cast<double>(a.size());
  Poly c(a.size() + 1, 0);
  for (size_t i = 0; i <= a.size(); ++i) {
    const double at = static_cast<double>(i) / n;
    c[i] = (i > 0 ? at * a[i - 1] : 0) + (i < a.size() ? (1 - at) * a[i] : 0);
  }
  return c;
}

// Over t0 to t1 of its range.
Poly restricted(const Poly& a, double t0, double t1) {
  Poly c = a;
  const auto blend = [](double p, double q, double t) { return (1 - t) * p + t * q; };
  for (size_t k = 1; k < c.size(); ++k)  // what is above t0
    for (size_t i = 0; i + k < c.size(); ++i) c[i] = blend(c[i], c[i + 1], t0);
  const double to = (t1 - t0) / (1 - t0);
  for (size_t k = 1; k < c.size(); ++k)  // what of that is below t1
    for (size_t i = c.size() - 1; i >= k; --i) c[i] = blend(c[i - 1], c[i], to);
  return c;
}

}  // namespace

double CellAtlas::Form::least(double x, double y) const {
  double low = HUGE_VAL;
  for (size_t i = 0; i < constant.size(); ++i)
    low = std::min(low, constant[i] + x * of_x[i] + y * of_y[i]);
  return low;
}

double CellAtlas::Form::most(double x, double y) const {
  double high = -HUGE_VAL;
  for (size_t i = 0; i < constant.size(); ++i)
    high = std::max(high, constant[i] + x * of_x[i] + y * of_y[i]);
  return high;
}

CellAtlas::CellAtlas(const tools::SplineCurve& curve, const Options& options)
    : options_(options), pieces_(bezier_pieces(curve)) {
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  for (uint32_t p = 0; p < pieces_.size(); ++p) {
    Poly nx, ny, w;
    for (const tools::ControlPoint& c : pieces_[p].points) {
      nx.push_back(c.w * c.x), ny.push_back(c.w * c.y), w.push_back(c.w);
      low[0] = std::min(low[0], c.x), high[0] = std::max(high[0], c.x);
      low[1] = std::min(low[1], c.y), high[1] = std::max(high[1], c.y);
    }
    for (int k = 0; k < kAtoms; ++k) {
      Atom a;
      a.piece = p, a.t0 = 1.0 * k / kAtoms, a.t1 = 1.0 * (k + 1) / kAtoms;
      a.nx = restricted(nx, a.t0, a.t1), a.ny = restricted(ny, a.t0, a.t1);
      a.w = restricted(w, a.t0, a.t1);
      a.is_first = p == 0 && k == 0, a.is_last = p + 1 == pieces_.size() && k + 1 == kAtoms;
      // With C = N / w, (C - P) . C' w^3 = (N - P w) . (N' w - N w').
      const Poly dw = raised(derived(a.w));
      const Poly gx = plus(times(raised(derived(a.nx)), a.w), times(a.nx, dw), -1);
      const Poly gy = plus(times(raised(derived(a.ny)), a.w), times(a.ny, dw), -1);
      a.slope.constant = plus(times(a.nx, gx), times(a.ny, gy));
      a.slope.of_x = times(a.w, gx), a.slope.of_y = times(a.w, gy);
      for (double& v : a.slope.of_x) v = -v;
      for (double& v : a.slope.of_y) v = -v;
      a.bend = {derived(a.slope.constant), derived(a.slope.of_x), derived(a.slope.of_y)};
      atoms_.push_back(a);
    }
  }
  const double side = std::max(high[0] - low[0], high[1] - low[1]) * (1 + 2 * options.margin);
  whole_ = {0.5 * (low[0] + high[0] - side), 0.5 * (low[1] + high[1] - side), side};
  std::vector<uint32_t> all;
  for (uint32_t i = 0; i < atoms_.size(); ++i) all.push_back(i);
  cells_.push_back({});
  fill(0, whole_, all);
}

// (|C - P|^2 - |y - P|^2) w^2 of a point y: affine in P.
CellAtlas::Form CellAtlas::distance_beyond(const Atom& a, double x, double y) const {
  const Poly w2 = times(a.w, a.w);
  Form form;
  form.constant = plus(plus(times(a.nx, a.nx), times(a.ny, a.ny)), w2, -(x * x + y * y));
  form.of_x = plus(times(a.nx, a.w), w2, -x);
  form.of_y = plus(times(a.ny, a.w), w2, -y);
  for (double& v : form.of_x) v *= -2;
  for (double& v : form.of_y) v *= -2;
  return form;
}

// Of what slopes one way all over a cell only a curve's end may be nearest; of what is bent
// downward nothing.
CellAtlas::Keep CellAtlas::keeps(const Atom& a, const Square& s) const {
  bool falls = true, rises = true, is_downward = true;
  for (int k = 0; k < 4; ++k) {
    const double x = s.x + (k % 2) * s.side, y = s.y + (k / 2) * s.side;
    falls = falls && a.slope.most(x, y) < 0;
    rises = rises && a.slope.least(x, y) > 0;
    is_downward = is_downward && a.bend.most(x, y) < 0;
  }
  if ((a.is_first && rises) || (a.is_last && falls)) return Keep::kAsPoint;
  if (falls || rises) return Keep::kNo;
  return is_downward && !a.is_first && !a.is_last ? Keep::kNo : Keep::kYes;
}

bool CellAtlas::is_convex(const Atom& a, const Square& s) const {
  for (int k = 0; k < 4; ++k)
    if (!(a.bend.least(s.x + (k % 2) * s.side, s.y + (k / 2) * s.side) > 0)) return false;
  return true;
}

std::vector<CellAtlas::Entry> CellAtlas::entries_of(const Square& cell,
                                                    const std::vector<uint32_t>& atoms,
                                                    const std::vector<Keep>& kept) const {
  std::vector<Entry> entries;
  for (size_t i = 0; i < atoms.size(); ++i) {
    const Atom& a = atoms_[atoms[i]];
    const bool is_point = kept[i] == Keep::kAsPoint;
    const bool is_certain = is_point || is_convex(a, cell);
    const bool joins = !entries.empty() && !is_point && !entries.back().is_point &&
                       entries.back().piece == a.piece && atoms[i] == atoms[i - 1] + 1;
    if (joins) {
      entries.back().t1 = a.t1;
      entries.back().is_certain = entries.back().is_certain && is_certain;
    } else {
      const double end = a.is_first ? a.t0 : a.t1;
      entries.push_back(
          {a.piece, is_point ? end : a.t0, is_point ? end : a.t1, is_certain, is_point});
    }
  }
  return entries;
}

void CellAtlas::fill(uint32_t at, const Square& s, std::vector<uint32_t> atoms) {
  // Points of the curve that are near a corner or the middle rule others out.
  for (int k = 0; k < 5 && atoms.size() > 1; ++k) {
    const double x = s.x + (k == 4 ? 0.5 : k % 2) * s.side;
    const double y = s.y + (k == 4 ? 0.5 : k / 2) * s.side;
    double best2 = HUGE_VAL;
    tools::Point near;
    for (const uint32_t i : atoms)
      for (int j = 0; j <= 2; ++j) {
        const Atom& a = atoms_[i];
        const tools::Point c = point_at(pieces_[a.piece], a.t0 + 0.5 * j * (a.t1 - a.t0));
        const double d2 = (c.x - x) * (c.x - x) + (c.y - y) * (c.y - y);
        if (d2 < best2) best2 = d2, near = c;
      }
    atoms.erase(
        std::remove_if(atoms.begin(), atoms.end(),
                       [&](uint32_t i) {
                         const Form beyond = distance_beyond(atoms_[i], near.x, near.y);
                         for (int c = 0; c < 4; ++c)
                           if (!(beyond.least(s.x + (c % 2) * s.side, s.y + (c / 2) * s.side) > 0))
                             return false;
                         return true;
                       }),
        atoms.end());
  }
  std::vector<uint32_t> kept;
  std::vector<Keep> how;
  for (const uint32_t i : atoms) {
    const Keep keep = keeps(atoms_[i], s);
    if (keep == Keep::kNo) continue;
    kept.push_back(i);
    how.push_back(keep);
  }
  const std::vector<Entry> entries = entries_of(s, kept, how);
  const bool is_certain =
      std::all_of(entries.begin(), entries.end(), [](const Entry& e) { return e.is_certain; });
  const int level = cells_[at].level;
  if ((is_certain && entries.size() <= options_.max_entries) || level == options_.levels) {
    cells_[at].first = static_cast<uint32_t>(entries_.size());
    cells_[at].count = static_cast<uint32_t>(entries.size());
    entries_.insert(entries_.end(), entries.begin(), entries.end());
    return;
  }
  const auto child = static_cast<uint32_t>(cells_.size());
  cells_[at].child = child;
  Cell below;
  below.level = level + 1;
  cells_.insert(cells_.end(), 4, below);
  for (uint32_t k = 0; k < 4; ++k)
    fill(child + k, {s.x + (k % 2) * 0.5 * s.side, s.y + (k / 2) * 0.5 * s.side, 0.5 * s.side},
         kept);
}

CellAtlas::Foot CellAtlas::solve(const Entry& entry, double start, double x, double y,
                                 double slack_m, uint32_t& evaluations) const {
  const tools::BezierCurve& piece = pieces_[entry.piece];
  Poly nx, ny, w;
  for (const tools::ControlPoint& c : piece.points)
    nx.push_back(c.w * c.x), ny.push_back(c.w * c.y), w.push_back(c.w);
  const auto value = [](const Poly& a, double t) { return restricted(a, t, 1)[0]; };
  Foot best{start, HUGE_VAL, 0, 0};
  // Of an uncertain entry each atom by itself.
  const int parts =
      entry.is_certain ? 1 : static_cast<int>(std::lround((entry.t1 - entry.t0) * kAtoms));
  for (int part = 0; part < parts; ++part) {
    double low = entry.t0 + (entry.t1 - entry.t0) * part / parts;
    double high = entry.t0 + (entry.t1 - entry.t0) * (part + 1) / parts;
    double t = start >= low && start <= high ? start : 0.5 * (low + high);
    for (int turn = 0; turn < 20; ++turn) {
      ++evaluations;
      const Poly dnx = derived(nx), dny = derived(ny), dw = derived(w);
      const double w0 = value(w, t), w1 = value(dw, t), w2 = value(derived(dw), t);
      const double cx = value(nx, t) / w0, cy = value(ny, t) / w0;
      const double ax = (value(dnx, t) - cx * w1) / w0, ay = (value(dny, t) - cy * w1) / w0;
      const double bx = (value(derived(dnx), t) - 2 * ax * w1 - cx * w2) / w0;
      const double by = (value(derived(dny), t) - 2 * ay * w1 - cy * w2) / w0;
      const double rx = cx - x, ry = cy - y, d2 = rx * rx + ry * ry;
      const double slope = rx * ax + ry * ay, bend = ax * ax + ay * ay + rx * bx + ry * by;
      if (d2 < best.distance2) {
        best = {t, d2, 0, 0};
        if (bend > 0) best.pace_x = ax / bend, best.pace_y = ay / bend;
      }
      (slope > 0 ? high : low) = t;
      double next = bend > 0 ? t - slope / bend : slope > 0 ? low : high;
      if (!(next > low)) next = slope < 0 && !(bend > 0) ? high : low;
      if (!(next < high)) next = high;
      // D falls by about slope^2 / (2 bend D).
      if (std::fabs(slope * (next - t)) <= 2 * slack_m * std::sqrt(d2)) break;
      t = next;
    }
  }
  return best;
}

CellAtlas::Answer CellAtlas::closest(double x, double y, double slack_m, Last& last) const {
  Answer answer;
  Square s = whole_;
  answer.is_inside = x >= s.x && y >= s.y && x <= s.x + s.side && y <= s.y + s.side;
  uint32_t at = 0;
  while (cells_[at].child != 0) {
    s.side *= 0.5;
    const bool right = x >= s.x + s.side, up = y >= s.y + s.side;
    s.x += right ? s.side : 0, s.y += up ? s.side : 0;
    at = cells_[at].child + (right ? 1 : 0) + (up ? 2 : 0);
  }
  Foot best{0, HUGE_VAL, 0, 0};
  uint32_t piece = 0;
  const double ahead = last.t + last.pace;
  for (uint32_t i = 0; i < cells_[at].count; ++i) {
    const Entry& entry = entries_[cells_[at].first + i];
    const bool is_last = entry.piece == last.piece && last.t >= entry.t0 && last.t <= entry.t1;
    const double start =
        is_last ? std::clamp(ahead, entry.t0, entry.t1) : 0.5 * (entry.t0 + entry.t1);
    const Foot foot = solve(entry, start, x, y, slack_m, answer.evaluations);
    if (foot.distance2 < best.distance2) best = foot, piece = entry.piece;
  }
  answer.entries = cells_[at].count;
  answer.distance_m = std::sqrt(best.distance2);
  last.pace =
      last.piece == UINT32_MAX ? 0 : best.pace_x * (x - last.x) + best.pace_y * (y - last.y);
  last.piece = piece, last.t = best.t, last.x = x, last.y = y;
  return answer;
}

size_t CellAtlas::leaves() const {
  return static_cast<size_t>(
      std::count_if(cells_.begin(), cells_.end(), [](const Cell& c) { return c.child == 0; }));
}

size_t CellAtlas::bytes() const { return 4 * cells_.size() + 4 * entries_.size(); }

CellAtlas::Shares CellAtlas::shares() const {
  Shares shares;
  for (const Cell& c : cells_) {
    if (c.child != 0) continue;
    const double area = std::ldexp(1.0, -2 * c.level);
    (c.count <= 1 ? shares.one : c.count == 2 ? shares.two : shares.more) += area;
    for (uint32_t i = 0; i < c.count; ++i)
      if (!entries_[c.first + i].is_certain) {
        shares.uncertain += area;
        break;
      }
  }
  return shares;
}

}  // namespace firmtouch::lab
