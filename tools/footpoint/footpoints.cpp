#include "footpoint/footpoints.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::tools {
namespace {

constexpr double kSmooth = 1000;  // gaps: sine between tangents that are one

Point place_of(const ControlPoint& p) { return {p.x, p.y, p.z}; }

FootKind kind_of(const Root& root) {
  if (root.before < 0 && root.after > 0) return FootKind::kMin;
  return root.before > 0 && root.after < 0 ? FootKind::kMax : FootKind::kSaddle;
}

template <class Piece>
void grow(const std::vector<Piece>& pieces, Point& low, Point& high, bool& is_first) {
  for (const Piece& piece : pieces) {
    for (const ControlPoint& p : piece.points) {
      if (is_first) low = high = place_of(p);
      is_first = false;
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
}

double parameter_of(const BezierCurve& c, double t) { return c.t0 + t * (c.t1 - c.t0); }

}  // namespace

const char* name_of(FootKind kind) {
  constexpr const char* kNames[] = {"min", "max", "saddle", "end"};
  return kNames[static_cast<int>(kind)];
}

Footpoints::Footpoints(const std::vector<BezierCurve>& curves,
                       const std::vector<BezierPatch>& patches, double gap)
    : gap_(gap) {
  Point low, high;
  bool is_first = true;
  grow(curves, low, high, is_first);
  grow(patches, low, high, is_first);
  low_m_ = low, high_m_ = high;
  extent_m_ = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  for (const BezierCurve& c : curves) curves_.emplace_back(c);
  find_joints();
  for (const BezierPatch& p : patches) patches_.emplace_back(p);
  find_borders(patches, gap, extent_m_, borders_, corners_, joints_, neighbours_);
  for (const Border& b : borders_) border_curves_.emplace_back(b.curve);
  for (const Joint& j : joints_) joint_curves_.emplace_back(j.border.curve);
  find_vertices();
}

// A curve's ends and corners are listed; over smooth joints its equation goes on.
void Footpoints::find_joints() {
  follows_.assign(curves_.size(), {false, kNone, 1});
  next_.assign(curves_.size(), kNone);
  const auto corner = [this](const CurveSystem& c, bool at_end) {
    const Point at = place_of(at_end ? c.piece.points.back() : c.piece.points.front());
    corners_.push_back({at, c.piece.piece, at_end ? c.piece.t1 : c.piece.t0, 0});
  };
  size_t first = 0;  // of the entity
  for (size_t k = 0; k < curves_.size(); ++k) {
    if (curves_[k].piece.piece != curves_[first].piece.piece) first = k;
    const bool is_last =
        k + 1 == curves_.size() || curves_[k + 1].piece.piece != curves_[k].piece.piece;
    const size_t next = is_last ? first : k + 1;
    const CurveSystem &a = curves_[k], &b = curves_[next];
    const Point from = a.b.c.back(), to = b.b.c.front();
    const bool meets = length(place_of(a.piece.points.back()) - place_of(b.piece.points.front())) <=
                       gap_ * extent_m_;
    const double size = length(from) * length(to);
    if (meets && size > 0 && dot(from, to) > 0 &&
        length(cross(from, to)) <= kSmooth * gap_ * size) {
      follows_[next] = {true, k, length(to) / length(from)};
      next_[k] = next;
    } else {
      corner(a, true);
      if (!meets) corner(b, false);
    }
  }
}

void Footpoints::add_curves(Point p_m, std::vector<Footpoint>& found, bool& is_complete) const {
  std::vector<std::vector<double>> f;
  std::vector<double> noise;
  for (const CurveSystem& c : curves_) {
    f.push_back(c.coefficients(p_m));
    noise.push_back(c.noise(p_m));
  }
  const auto add = [&](size_t k, const Root& root) {
    const CurveSystem& c = curves_[k];
    const Point at = c.point(root.t);
    found.push_back(
        {kind_of(root), length(at - p_m), at, c.piece.piece, parameter_of(c.piece, root.t), 0});
  };
  for (size_t k = 0; k < f.size(); ++k) {
    if (!follows_[k].is_smooth) continue;
    const size_t before = follows_[k].piece;
    f[k].front() = follows_[k].ratio * f[before].back();
    if (std::fabs(f[k].front()) > noise[k] && std::fabs(f[before].back()) > noise[before]) continue;
    f[k].front() = f[before].back() = 0;
    const Root root{0, last_sign(f[before], noise[before]), first_sign(f[k], noise[k])};
    if (root.before * root.after < 0) add(k, root);
  }
  std::vector<Root> roots;
  for (size_t k = 0; k < f.size(); ++k) {
    bool is_zero = false;
    roots.clear();
    roots_of(f[k], noise[k], roots, is_zero);
    if (is_zero) {  // an arc about the query
      is_complete = false;
      roots.push_back({0.5, 0, 0});
    }
    for (const Root& root : roots) add(k, root);
  }
}

void Footpoints::roots_in(size_t k, Point p_m, std::vector<Root>& roots) const {
  std::vector<double> f = curves_[k].coefficients(p_m);
  const double noise = curves_[k].noise(p_m);
  // The value at a joint is the predecessor's, so that neighbours agree whose the foot-point is.
  if (follows_[k].is_smooth) {
    const CurveSystem& before = curves_[follows_[k].piece];
    f.front() =
        follows_[k].ratio * (before.a.c.back() - dot(p_m - before.origin, before.b.c.back()));
  }
  bool is_zero = false;
  roots.clear();
  roots_of(f, noise, roots, is_zero);
}

void Footpoints::add_patches(Point p_m, std::vector<Footpoint>& found, bool& is_complete) const {
  struct OnEdge {
    Footpoint foot;
    size_t patch;
  };
  std::vector<OnEdge> on_edges;  // of patches: a neighbour may find the same
  std::vector<SurfaceRoot> roots;
  for (size_t k = 0; k < patches_.size(); ++k) {
    roots.clear();
    size_t boxes = 0;
    patches_[k].solve(p_m, roots, boxes, is_complete, 1e-9 + 4 * gap_);
    const BezierPatch& s = patches_[k].patch;
    for (const SurfaceRoot& root : roots) {
      const Point at = patches_[k].point(root.u, root.v);
      const FootKind kind = !(root.det > 0)     ? FootKind::kSaddle
                            : root.diagonal > 0 ? FootKind::kMin
                                                : FootKind::kMax;
      const Footpoint foot{kind,
                           length(at - p_m),
                           at,
                           s.piece,
                           s.u0 + root.u * (s.u1 - s.u0),
                           s.v0 + root.v * (s.v1 - s.v0)};
      const double near = 1e-6 + 8 * gap_;
      const bool inside = root.u > near && root.u < 1 - near && root.v > near && root.v < 1 - near;
      bool is_known = false;
      for (const Corner& c : corners_)
        is_known |= length(c.at - at) <= (1e-9 + 4 * gap_) * extent_m_;
      for (const OnEdge& e : on_edges)
        is_known |= !inside && e.patch != k && e.foot.kind == kind &&
                    length(e.foot.point_m - at) <= (1e-6 + 16 * gap_) * extent_m_;
      if (is_known) continue;
      if (!inside) on_edges.push_back({foot, k});
      found.push_back(foot);
    }
  }
}

void Footpoints::add_borders(Point p_m, std::vector<Footpoint>& found, bool& is_complete) const {
  std::vector<Root> roots;
  for (size_t k = 0; k < borders_.size(); ++k) {
    const CurveSystem& c = border_curves_[k];
    bool is_zero = false;
    roots.clear();
    // A little beyond the ends: where borders meet smoothly, a foot-point is one of either's.
    const double more = 1e-9 + 4 * gap_;
    Scalars equation(c.a.degree_u, 0);
    equation.c = c.coefficients(p_m);
    roots_of(extended(equation, more).c, c.noise(p_m), roots, is_zero);
    for (Root& root : roots) root.t = std::clamp(root.t * (1 + 2 * more) - more, 0.0, 1.0);
    if (is_zero) {
      is_complete = false;
      roots.push_back({0.5, 0, 0});
    }
    for (const Root& root : roots) {
      const Border& b = borders_[k];
      const Point at = c.point(root.t);
      bool is_known = false;  // where two surfaces meet at an edge both have it
      for (const Footpoint& f : found)
        is_known |=
            f.kind == FootKind::kEnd && length(f.point_m - at) <= (1e-8 + 16 * gap_) * extent_m_;
      if (is_known) continue;
      found.push_back({FootKind::kEnd, length(at - p_m), at, c.piece.piece,
                       b.u0 + root.t * (b.u1 - b.u0), b.v0 + root.t * (b.v1 - b.v0)});
    }
  }
}

// The corners of patches, except those that are listed as corners.
void Footpoints::find_vertices() {
  const double tolerance = (1e-9 + gap_) * extent_m_;
  const auto vertex_of = [&](const Corner& corner) -> Vertex* {
    const auto is_at = [&](Point at) { return length(at - corner.at) <= tolerance; };
    for (const Corner& c : corners_)
      if (is_at(c.at)) return nullptr;
    for (Vertex& v : vertices_)
      if (is_at(v.corner.at)) return &v;
    vertices_.push_back({corner, {}, {}});
    return &vertices_.back();
  };
  for (size_t k = 0; k < patches_.size(); ++k) {
    const BezierPatch& s = patches_[k].patch;
    for (const double u : {0.0, 1.0})
      for (const double v : {0.0, 1.0})
        if (Vertex* vertex = vertex_of(
                {patches_[k].point(u, v), s.piece, u > 0 ? s.u1 : s.u0, v > 0 ? s.v1 : s.v0}))
          vertex->patches.push_back({k, u, v});
  }
  for (size_t k = 0; k < borders_.size(); ++k) {
    const Border& b = borders_[k];
    for (const bool at_end : {false, true})
      if (Vertex* vertex = vertex_of({border_curves_[k].point(at_end ? 1 : 0), b.curve.piece,
                                      at_end ? b.u1 : b.u0, at_end ? b.v1 : b.v0}))
        vertex->borders.push_back({k, at_end});
  }
}

// The distance rises on both sides of a joint, or falls on both.
void Footpoints::add_joints(Point p_m, std::vector<Footpoint>& found) const {
  std::vector<Root> roots;
  for (size_t k = 0; k < joints_.size(); ++k) {
    const Border& border = joints_[k].border;
    const Neighbour& over = joints_[k].over;
    const CurveSystem& c = joint_curves_[k];
    bool is_zero = false;
    roots.clear();
    roots_of(c.coefficients(p_m), c.noise(p_m), roots, is_zero);
    for (const Root& root : roots) {
      const double here = rise_into(border.patch, border.side, root.t, p_m);
      const double there =
          rise_into(over.patch, over.side, over.is_turned ? 1 - root.t : root.t, p_m);
      if (!(here * there > 0)) continue;
      const FootKind along = kind_of(root), across = here > 0 ? FootKind::kMin : FootKind::kMax;
      add_unknown({along == across ? along : FootKind::kSaddle, length(c.point(root.t) - p_m),
                   c.point(root.t), c.piece.piece, border.u0 + root.t * (border.u1 - border.u0),
                   border.v0 + root.t * (border.v1 - border.v0)},
                  found);
    }
  }
}

// The distance rises into all that meets, or falls.
void Footpoints::add_vertices(Point p_m, std::vector<Footpoint>& found) const {
  for (const Vertex& vertex : vertices_) {
    bool rises = true, falls = true;
    const auto meet = [&](double rise) { rises &= rise >= 0, falls &= rise <= 0; };
    for (const Vertex::BorderEnd& end : vertex.borders) {
      const CurveSystem& c = border_curves_[end.border];
      double f = 0, slope = 0;
      c.value(p_m, end.at_end ? 1 : 0, f, slope);
      meet(end.at_end ? -f : f);
    }
    for (const Vertex::PatchCorner& c : vertex.patches) {
      if (!vertex.borders.empty()) break;
      const SurfaceSystem& s = patches_[c.patch];
      for (const int k : {0, 1}) {
        const size_t i = c.u > 0 ? s.a[k].wide() - 1 : 0, j = c.v > 0 ? s.a[k].high() - 1 : 0;
        const double f = s.a[k].at(i, j) - dot(p_m - s.origin, s.b[k].at(i, j));
        meet((k == 0 ? c.u : c.v) > 0 ? -f : f);
      }
    }
    if (!rises && !falls) continue;
    const Corner& at = vertex.corner;
    const FootKind kind = rises ? FootKind::kMin : FootKind::kMax;
    add_unknown({vertex.borders.empty() ? kind : FootKind::kEnd, length(at.at - p_m), at.at,
                 at.piece, at.u, at.v},
                found);
  }
}

// Slope of the squared distance from a side of a patch into it, up to a factor.
double Footpoints::rise_into(size_t patch, int side, double t, Point p_m) const {
  const double fixed = side % 2;
  const bool is_row = side < 2;
  const SurfaceSystem::Values at =
      patches_[patch].values(p_m, is_row ? t : fixed, is_row ? fixed : t);
  return (is_row ? at.i : at.h) * (side % 2 == 0 ? 1 : -1);
}

// Patches have roots a little beyond their ends, too, and rounding alone makes no second foot-point
// there.
void Footpoints::add_unknown(const Footpoint& foot, std::vector<Footpoint>& found) const {
  for (const Footpoint& f : found)
    if (length(f.point_m - foot.point_m) <= (1e-6 + 16 * gap_) * extent_m_) return;
  found.push_back(foot);
}

std::vector<Footpoint> Footpoints::all(Point p_m, bool& is_complete) const {
  is_complete = true;
  std::vector<Footpoint> found;
  add_curves(p_m, found, is_complete);
  add_patches(p_m, found, is_complete);
  add_borders(p_m, found, is_complete);
  add_joints(p_m, found);
  add_vertices(p_m, found);
  for (const Corner& c : corners_)
    found.push_back({FootKind::kEnd, length(c.at - p_m), c.at, c.piece, c.u, c.v});
  std::stable_sort(found.begin(), found.end(), [](const Footpoint& a, const Footpoint& b) {
    return a.distance_m < b.distance_m;
  });
  return found;
}

}  // namespace firmtouch::tools
