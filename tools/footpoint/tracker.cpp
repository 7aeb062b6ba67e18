#include "footpoint/tracker.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::tools {
namespace {

void add(std::vector<uint32_t>& pieces, size_t piece) {
  const auto wanted = static_cast<uint32_t>(piece);
  if (std::find(pieces.begin(), pieces.end(), wanted) == pieces.end()) pieces.push_back(wanted);
}

double reach(Point gradient, Point half) {
  return std::fabs(gradient.x * half.x) + std::fabs(gradient.y * half.y) +
         std::fabs(gradient.z * half.z);
}

}  // namespace

Tracker::Tracker(const Footpoints& feet, const CriticalGrid& grid, TrackerOptions options)
    : feet_(feet), grid_(grid), options_(options), borders_(feet.borders().size()) {
  for (size_t k = 0; k < feet.curves().size(); ++k) {
    if (feet.previous_of(k) == Footpoints::kNone) gates_.push_back({k, false, 0});
    if (feet.next_of(k) == Footpoints::kNone) gates_.push_back({k, true, 0});
  }
}

Point Tracker::place_of(const Track& track) const {
  const size_t curves = feet_.curves().size();
  return track.piece < curves ? feet_.curves()[track.piece].point(track.u)
                              : feet_.patches()[track.piece - curves].point(track.u, track.v);
}

int Tracker::sign_at(const Gate& gate, Point p_m) const {
  const CurveSystem& c = feet_.curves()[gate.piece];
  const double a = gate.at_end ? c.a.c.back() : c.a.c.front();
  const double f = a - dot(p_m - c.origin, gate.at_end ? c.b.c.back() : c.b.c.front());
  return f > 0 ? 1 : f < 0 ? -1 : 0;
}

void Tracker::find_gate_events(Point p_m, std::vector<uint32_t>& pieces) {
  for (Gate& gate : gates_) {
    const int sign = sign_at(gate, p_m);
    if (sign != gate.sign && options_.watches_ends) add(pieces, gate.piece);
    gate.sign = sign;
  }
}

// Borders are solved anew for each move; where one of their foot-points begins to point to the
// other side, a foot-point of the surface has passed over the border.
void Tracker::find_border_events(Point p_m, std::vector<uint32_t>& pieces) {
  std::vector<Root> roots;
  border_distance_m_ = 1e300;
  for (size_t k = 0; k < borders_.size(); ++k) {
    const CurveSystem& c = feet_.border_curves()[k];
    const Border& border = feet_.borders()[k];
    BorderState now;
    bool is_zero = false;
    roots.clear();
    roots_of(c.coefficients(p_m), c.noise(p_m), roots, is_zero);
    for (const Root& root : roots) {
      const Point at = c.point(root.t);
      const double distance = length(at - p_m);
      if (distance < border_distance_m_) border_distance_m_ = distance, border_nearest_m_ = at;
      const bool is_row = border.side < 2;
      const double fixed = border.side % 2;
      const SurfaceSystem::Values values = feet_.patches()[border.patch].values(
          p_m, is_row ? root.t : fixed, is_row ? fixed : root.t);
      ((is_row ? values.i : values.h) > 0 ? now.inward : now.outward)++;
    }
    const bool changed = now.inward != borders_[k].inward || now.outward != borders_[k].outward;
    if (changed && options_.watches_ends) add(pieces, feet_.curves().size() + border.patch);
    borders_[k] = now;
  }
}

// The published test of a crossing: whether (1) and (2) have a common zero for a point of the box
// about the move, by subdivision of the piece.
bool Tracker::may_be_critical(size_t piece, Point p_m) const {
  const CurveSystem& system = feet_.curves()[piece];
  const Point half = (p_m - at_) * 0.5, middle = at_ + half - system.origin;
  struct Part {
    Scalars low, high;  // of F over the box
    int depth;
  };
  Part whole{Scalars(system.a.degree_u, 0), Scalars(system.a.degree_u, 0), 0};
  for (size_t k = 0; k < system.a.c.size(); ++k) {
    const double value = system.a.c[k] - dot(middle, system.b.c[k]);
    const double slack = reach(system.b.c[k], half);
    whole.low.c[k] = value - slack, whole.high.c[k] = value + slack;
  }
  std::vector<Part> stack{whole};
  while (!stack.empty()) {
    Part part = std::move(stack.back());
    stack.pop_back();
    const size_t n = part.low.c.size();
    bool above = true, below = true, rises = true, falls = true;
    for (size_t k = 0; k < n; ++k) above &= part.low.c[k] > 0, below &= part.high.c[k] < 0;
    for (size_t k = 0; k + 1 < n; ++k) {
      rises &= part.low.c[k + 1] > part.high.c[k];
      falls &= part.high.c[k + 1] < part.low.c[k];
    }
    if (above || below || rises || falls) continue;
    if (part.depth == 6) return true;
    Part right = part;
    split_u(part.low, right.low);
    split_u(part.high, right.high);
    part.depth = right.depth = part.depth + 1;
    stack.push_back(std::move(part));
    stack.push_back(std::move(right));
  }
  const size_t next = feet_.next_of(piece), previous = feet_.previous_of(piece);
  return (next != Footpoints::kNone && joint_may_be_critical(piece, next, p_m)) ||
         (previous != Footpoints::kNone && joint_may_be_critical(previous, piece, p_m));
}

// Where curvature jumps: whether the move may cross the joint's normal between both centres of
// curvature.
bool Tracker::joint_may_be_critical(size_t from, size_t to, Point p_m) const {
  const CurveSystem &a = feet_.curves()[from], &b = feet_.curves()[to];
  const Point half = (p_m - at_) * 0.5, middle = at_ + half;
  const auto sign = [&](double value, Point gradient, Point origin) {
    const double v = value - dot(middle - origin, gradient), slack = reach(gradient, half);
    return v > slack ? 1 : v < -slack ? -1 : 0;
  };
  if (sign(b.a.c.front(), b.b.c.front(), b.origin) != 0) return false;
  return sign(a.a_slope.c.back(), a.b_slope.c.back(), a.origin) *
             sign(b.a_slope.c.front(), b.b_slope.c.front(), b.origin) !=
         1;
}

void Tracker::find_critical(Point p_m, std::vector<uint32_t>& pieces) {
  const size_t curves = feet_.curves().size(), all = curves + feet_.patches().size();
  std::vector<uint32_t> listed;
  if (!options_.uses_grid || !grid_.cells_between(at_, p_m, cells_)) {  // or outside of it
    for (size_t k = 0; k < all; ++k) listed.push_back(static_cast<uint32_t>(k));
  } else {
    for (const size_t cell : cells_)
      for (const uint32_t piece : grid_.pieces_in(cell)) add(listed, piece);
  }
  counts_.pruned += listed.empty();
  for (const uint32_t piece : listed) {
    if (piece >= curves) {
      add(pieces, piece);
    } else if (may_be_critical(piece, p_m)) {
      // A foot-point born beside a joint may pass it within the same move.
      add(pieces, piece);
      if (feet_.next_of(piece) != Footpoints::kNone) add(pieces, feet_.next_of(piece));
      if (feet_.previous_of(piece) != Footpoints::kNone) add(pieces, feet_.previous_of(piece));
    }
  }
}

bool Tracker::march_curve(Track& track, Point p_m, bool& has_left) {
  const Point motion = p_m - at_;
  double f = 0, slope = 0;
  feet_.curves()[track.piece].value(at_, track.u, f, slope);
  const Point gradient = feet_.curves()[track.piece].gradient(track.u) * -1.0;  // of F by P
  double step = 0;
  if (options_.predictor == Predictor::kFixedPoint)
    step = -dot(gradient, motion) / slope;
  else
    step = -slope * dot(gradient, motion) / (dot(gradient, gradient) + slope * slope);
  int crossings = 0;
  for (int iteration = 0; iteration < 12; ++iteration) {
    if (!(std::fabs(step) < 1)) return false;
    track.u += step;
    const bool beyond = track.u > 1, before = track.u < 0;
    if (beyond || before) {
      const size_t next = beyond ? feet_.next_of(track.piece) : feet_.previous_of(track.piece);
      has_left = next == Footpoints::kNone;
      if (has_left) return true;
      track.piece = static_cast<uint32_t>(next);
      track.u = beyond ? 0 : 1;
      if (++crossings > 4) return true;  // the joint itself, from both sides
    }
    feet_.curves()[track.piece].value(p_m, track.u, f, slope);
    step = -f / slope;
    ++counts_.iterations;
    if (std::fabs(step) < 1e-10) {
      track.u = std::clamp(track.u + step, 0.0, 1.0);
      return true;
    }
  }
  return false;
}

// Over an edge into the patch beyond, from the place where it was left.
bool Tracker::cross_patch(Track& track, bool& has_left) const {
  const size_t curves = feet_.curves().size();
  const double out[4] = {-track.v, track.v - 1, -track.u, track.u - 1};
  const int side = static_cast<int>(std::max_element(out, out + 4) - out);
  const Neighbour& over = feet_.over(track.piece - curves, side);
  has_left = over.patch == Neighbour::kNone;
  if (has_left) return true;
  const double along = std::clamp(side < 2 ? track.u : track.v, 0.0, 1.0);
  const double s = over.is_turned ? 1 - along : along, fixed = over.side % 2;
  track = {static_cast<uint32_t>(curves + over.patch), over.side < 2 ? s : fixed,
           over.side < 2 ? fixed : s};
  return true;
}

bool Tracker::march_patch(Track& track, Point p_m, bool& has_left) {
  const size_t curves = feet_.curves().size();
  const Point motion = p_m - at_;
  const SurfaceSystem* system = &feet_.patches()[track.piece - curves];
  SurfaceSystem::Values j = system->values(at_, track.u, track.v);
  Point by_h, by_i;
  system->gradients(track.u, track.v, by_h, by_i);
  double du = 0, dv = 0;
  if (options_.predictor == Predictor::kFixedPoint) {
    const double h = dot(by_h, motion), i = dot(by_i, motion), det = j.h_u * j.i_v - j.h_v * j.i_u;
    du = (h * j.i_v - i * j.h_v) / det, dv = (j.h_u * i - j.i_u * h) / det;
  } else {
    // Gradients in five variables, made orthonormal; the parts along u and v of the projection.
    double g[5] = {-by_h.x, -by_h.y, -by_h.z, j.h_u, j.h_v};
    double k[5] = {-by_i.x, -by_i.y, -by_i.z, j.i_u, j.i_v};
    const auto inner = [](const double* a, const double* b) {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4];
    };
    const double m[5] = {motion.x, motion.y, motion.z, 0, 0};
    const double size = std::sqrt(inner(g, g));
    for (double& x : g) x /= size;
    const double share = inner(g, k);
    for (int n = 0; n < 5; ++n) k[n] -= share * g[n];
    const double rest = std::sqrt(inner(k, k));
    for (double& x : k) x /= rest;
    du = -g[3] * inner(g, m) - k[3] * inner(k, m), dv = -g[4] * inner(g, m) - k[4] * inner(k, m);
  }
  int crossings = 0;
  for (int iteration = 0; iteration < 16; ++iteration) {
    if (!(std::fabs(du) < 1 && std::fabs(dv) < 1)) return false;
    track.u += du, track.v += dv;
    if (track.u < -1e-9 || track.u > 1 + 1e-9 || track.v < -1e-9 || track.v > 1 + 1e-9) {
      if (++crossings > 6) return false;
      if (!cross_patch(track, has_left)) return false;
      if (has_left) return true;
      system = &feet_.patches()[track.piece - curves];
    }
    j = system->values(p_m, track.u, track.v);
    const double det = j.h_u * j.i_v - j.h_v * j.i_u;
    du = (j.h_v * j.i - j.i_v * j.h) / det, dv = (j.i_u * j.h - j.h_u * j.i) / det;
    ++counts_.iterations;
    if (std::fabs(du) + std::fabs(dv) < 1e-10) return true;
  }
  return false;
}

void Tracker::solve(std::vector<uint32_t>& pieces, Point p_m) {
  const size_t curves = feet_.curves().size();
  const auto is_solved = [&](const Track& t) {
    return std::find(pieces.begin(), pieces.end(), t.piece) != pieces.end();
  };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), is_solved), tracks_.end());
  std::vector<Root> roots;
  std::vector<SurfaceRoot> places;
  for (const uint32_t piece : pieces) {
    ++counts_.solves;
    if (piece < curves) {
      feet_.roots_in(piece, p_m, roots);
      for (const Root& root : roots) tracks_.push_back({piece, root.t, 0});
      continue;
    }
    size_t boxes = 0;
    bool is_complete = true;
    places.clear();
    feet_.patches()[piece - curves].solve(p_m, places, boxes, is_complete);
    for (const SurfaceRoot& root : places) tracks_.push_back({piece, root.u, root.v});
  }
}

void Tracker::solve_all(Point p_m) {
  std::vector<uint32_t> pieces;
  for (size_t k = 0; k < feet_.curves().size() + feet_.patches().size(); ++k)
    pieces.push_back(static_cast<uint32_t>(k));
  tracks_.clear();
  solve(pieces, p_m);
}

// Two that Newton took to one place: one of them is lost.
bool Tracker::has_doubles() const {
  for (size_t i = 0; i < tracks_.size(); ++i)
    for (size_t j = i + 1; j < tracks_.size(); ++j)
      if (tracks_[i].piece == tracks_[j].piece && std::fabs(tracks_[i].u - tracks_[j].u) < 1e-8 &&
          std::fabs(tracks_[i].v - tracks_[j].v) < 1e-8)
        return true;
  return false;
}

void Tracker::find_nearest(Point p_m) {
  distance_m_ = border_distance_m_, nearest_m_ = border_nearest_m_;
  const auto offer = [&](Point at) {
    const double distance = length(at - p_m);
    if (distance < distance_m_) distance_m_ = distance, nearest_m_ = at;
  };
  for (const Track& track : tracks_) offer(place_of(track));
  for (const Corner& corner : feet_.corners()) offer(corner.at);
}

void Tracker::start(Point p_m) {
  std::vector<uint32_t> ignored;
  solve_all(p_m);
  find_gate_events(p_m, ignored);
  find_border_events(p_m, ignored);
  at_ = p_m;
  find_nearest(p_m);
}

void Tracker::move(Point p_m) {
  ++counts_.moves;
  std::vector<uint32_t> pieces;
  find_critical(p_m, pieces);
  find_gate_events(p_m, pieces);
  find_border_events(p_m, pieces);
  const size_t curves = feet_.curves().size();
  std::vector<Track> kept;
  bool has_failed = false;
  for (Track track : tracks_) {
    const bool is_solved = std::find(pieces.begin(), pieces.end(), track.piece) != pieces.end();
    bool has_left = false;
    ++counts_.marches;
    const bool arrived = track.piece < curves ? march_curve(track, p_m, has_left)
                                              : march_patch(track, p_m, has_left);
    has_failed |= !arrived && !is_solved;
    if (arrived && !has_left) kept.push_back(track);
  }
  tracks_ = std::move(kept);
  if (!pieces.empty()) solve(pieces, p_m);
  if (has_failed || has_doubles()) {
    ++counts_.anomalies;
    solve_all(p_m);
  }
  at_ = p_m;
  find_nearest(p_m);
}

}  // namespace firmtouch::tools
