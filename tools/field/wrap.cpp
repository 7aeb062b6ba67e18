#include "field/wrap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "field/foot.hpp"
#include "field/triangle_tree.hpp"
#include "surface/winding_number.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kMaxNodes = 1 << 27;
constexpr double kCell = 0.55;      // of the distance: a cell's diagonal is 0.953 of it
constexpr uint32_t kBlock = 8;      // nodes along a side that share one distance query
constexpr double kNearNode = 0.05;  // of an edge: no vertex lies nearer to its ends
constexpr double kOver = 1 + 1e-4;  // on bounds: far above rounding

enum Node : uint8_t { kInside, kUnreached, kOutside };

class Wrapper {
 public:
  Wrapper(const Surface& soup, double distance_m, Point low, Point high)
      : soup_(soup), tree_(soup), distance_m_(distance_m), cell_m_(kCell * distance_m) {
    const Point margin{distance_m + 2 * cell_m_, distance_m + 2 * cell_m_,
                       distance_m + 2 * cell_m_};
    low_ = low - margin;
    const Point size = high + margin - low_;
    const double sizes[3] = {size.x, size.y, size.z};
    for (size_t k = 0; k < 3; ++k) count_[k] = std::ceil(sizes[k] / cell_m_) + 1;
  }

  double nodes() const { return count_[0] * count_[1] * count_[2]; }

  void classify() {
    for (size_t k = 0; k < 3; ++k) n_[k] = static_cast<uint32_t>(count_[k]);
    nodes_.assign(static_cast<size_t>(nodes()), kUnreached);
    for (uint32_t z = 0; z < n_[2]; z += kBlock)
      for (uint32_t y = 0; y < n_[1]; y += kBlock)
        for (uint32_t x = 0; x < n_[0]; x += kBlock) classify_block(x, y, z);
  }

  // From the corner of the grid, which is outside, along its axes. Result: nodes not reached.
  size_t flood() {
    std::vector<size_t> front{0};
    nodes_[0] = kOutside;
    const size_t step[3] = {1, n_[0], size_t{n_[0]} * n_[1]};
    while (!front.empty()) {
      const size_t at = front.back();
      front.pop_back();
      const size_t place[3] = {at % n_[0], at / step[1] % n_[1], at / step[2]};
      for (size_t k = 0; k < 3; ++k) {
        if (place[k] > 0) enter(at - step[k], front);
        if (place[k] + 1 < n_[k]) enter(at + step[k], front);
      }
    }
    return static_cast<size_t>(std::count(nodes_.begin(), nodes_.end(), kUnreached));
  }

  size_t triangles() const {
    static constexpr size_t kCut[5] = {0, 1, 2, 1, 0};  // by how many corners are outside
    size_t count = 0;
    each_tetrahedron([&](const Where(&corner)[4]) {
      count += kCut[std::count_if(corner, corner + 4, [&](auto at) { return is_outside(at); })];
    });
    return count;
  }

  Surface extract() {
    each_tetrahedron([&](const Where(&corner)[4]) { cut_tetrahedron(corner); });
    return std::move(wrapped_);
  }

 private:
  using Where = std::array<uint32_t, 3>;

  size_t index(const Where& at) const { return at[0] + n_[0] * (at[1] + size_t{n_[1]} * at[2]); }
  Point point(const Where& at) const {
    return low_ + Point{cell_m_ * at[0], cell_m_ * at[1], cell_m_ * at[2]};
  }

  double distance(Point p) {
    seed_ = tree_.nearest(tree_.local(p), seed_);
    const Face& face = soup_.faces[tree_.face_of(seed_)];
    return std::sqrt(
        foot_on(p, {to_point(soup_.vertices[face[0]]), to_point(soup_.vertices[face[1]]),
                    to_point(soup_.vertices[face[2]])})
            .distance2);
  }

  void classify_block(uint32_t x0, uint32_t y0, uint32_t z0) {
    const Where end{std::min(x0 + kBlock, n_[0]), std::min(y0 + kBlock, n_[1]),
                    std::min(z0 + kBlock, n_[2])};
    const Point low = point({x0, y0, z0}), high = point({end[0] - 1, end[1] - 1, end[2] - 1});
    const double reach = length(high - low) / 2 * kOver, middle = distance((low + high) * 0.5);
    const bool all_inside = middle + reach < distance_m_;
    if (middle - reach > distance_m_ * kOver) return;
    for (uint32_t z = z0; z < end[2]; ++z)
      for (uint32_t y = y0; y < end[1]; ++y)
        for (uint32_t x = x0; x < end[0]; ++x) {
          const Where at{x, y, z};
          if (all_inside || distance(point(at)) <= distance_m_) nodes_[index(at)] = kInside;
        }
  }

  void enter(size_t at, std::vector<size_t>& front) {
    if (nodes_[at] != kUnreached) return;
    nodes_[at] = kOutside;
    front.push_back(at);
  }

  bool is_outside(const Where& at) const { return nodes_[index(at)] == kOutside; }

  // Of the cells that the surface cuts.
  template <class Take>
  void each_tetrahedron(Take take) const {
    for (uint32_t z = 0; z + 1 < n_[2]; ++z)
      for (uint32_t y = 0; y + 1 < n_[1]; ++y)
        for (uint32_t x = 0; x + 1 < n_[0]; ++x)
          if (is_cut(x, y, z)) each_of_cell({x, y, z}, take);
  }

  bool is_cut(uint32_t x, uint32_t y, uint32_t z) const {
    for (uint32_t k = 1; k < 8; ++k)
      if (is_outside({x + (k & 1), y + (k >> 1 & 1), z + (k >> 2)}) != is_outside({x, y, z}))
        return true;
    return false;
  }

  // The six tetrahedra along the cell's diagonal: one for each order of the axes.
  template <class Take>
  static void each_of_cell(const Where& cell, Take& take) {
    static constexpr uint8_t kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                              {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (const auto& order : kOrders) {
      Where corner[4] = {cell, {}, {}, {}};
      for (uint32_t k = 0; k < 3; ++k) {
        corner[k + 1] = corner[k];
        ++corner[k + 1][order[k]];
      }
      take(corner);
    }
  }

  void cut_tetrahedron(const Where (&corner)[4]) {
    uint32_t in[4], out[4], ins = 0, outs = 0;
    for (uint32_t k = 0; k < 4; ++k) (is_outside(corner[k]) ? out[outs++] : in[ins++]) = k;
    if (ins == 0 || outs == 0) return;
    const auto at = [&](uint32_t i, uint32_t o) { return vertex(corner[in[i]], corner[out[o]]); };
    const Point outer = point(corner[out[0]]);
    if (ins == 2) {
      const uint32_t a = at(0, 0), b = at(0, 1), c = at(1, 1), d = at(1, 0);
      add({a, b, c}, outer);
      add({a, c, d}, outer);
    } else if (ins == 1) {
      add({at(0, 0), at(0, 1), at(0, 2)}, outer);
    } else {
      add({at(0, 0), at(1, 0), at(2, 0)}, outer);
    }
  }

  void add(Face face, Point outer) {
    const Point a = to_point(wrapped_.vertices[face[0]]);
    const Point normal =
        cross(to_point(wrapped_.vertices[face[1]]) - a, to_point(wrapped_.vertices[face[2]]) - a);
    if (dot(normal, outer - a) < 0) std::swap(face[1], face[2]);
    wrapped_.source.push_back(static_cast<uint32_t>(wrapped_.faces.size()));
    wrapped_.faces.push_back(face);
  }

  // One vertex an edge of the grid, whatever tetrahedra share it.
  uint32_t vertex(const Where& in, const Where& out) {
    const bool rises = in[0] <= out[0] && in[1] <= out[1] && in[2] <= out[2];
    const Where &low = rises ? in : out, &high = rises ? out : in;
    const uint64_t kind = (high[0] - low[0]) | (high[1] - low[1]) << 1 | (high[2] - low[2]) << 2;
    const auto added =
        vertex_of_.emplace(index(low) * 8 + kind, static_cast<uint32_t>(wrapped_.vertices.size()));
    if (added.second) wrapped_.vertices.push_back(to_vec3(crossing(point(in), point(out))));
    return added.first->second;
  }

  // Where the distance passes distance_m, by halving and the secant in turn.
  Point crossing(Point in, Point out) {
    double a = 0, b = 1, fa = distance(in) - distance_m_, fb = distance(out) - distance_m_;
    if (fa > 0) return (in + out) * 0.5;  // a filled hollow: any place will do
    for (int k = 0; k < 6; ++k) {
      const double t = k % 2 == 0 && fb > fa ? a - fa * (b - a) / (fb - fa) : (a + b) / 2;
      const double f = distance(in + (out - in) * t) - distance_m_;
      (f <= 0 ? a : b) = t;
      (f <= 0 ? fa : fb) = f;
    }
    return in + (out - in) * std::clamp((a + b) / 2, kNearNode, 1 - kNearNode);
  }

  const Surface& soup_;
  TriangleTree tree_;
  double distance_m_, cell_m_;
  Point low_;
  double count_[3];
  uint32_t n_[3] = {};
  uint32_t seed_ = kNoFace;
  std::vector<uint8_t> nodes_;
  std::unordered_map<uint64_t, uint32_t> vertex_of_;
  Surface wrapped_;
};

// On the vertices as they are stored.
size_t points_outside(const Surface& soup, const Surface& wrapped) {
  const WindingNumber winding(wrapped, {});
  std::vector<bool> is_seen(soup.vertices.size(), false);
  size_t outside = 0;
  for (const Face& face : soup.faces)
    for (const uint32_t v : face) {
      if (!is_seen[v] && winding.at(to_point(soup.vertices[v])) < 1) ++outside;
      is_seen[v] = true;
    }
  return outside;
}

}  // namespace

Surface wrap_surface(const Surface& soup, double distance_m, WrapReport& report,
                     size_t max_triangles) {
  report = {};
  report.cell_m = kCell * distance_m;
  Point low = to_point(soup.vertices[soup.faces[0][0]]), high = low;
  for (const Face& face : soup.faces)
    for (const uint32_t v : face) {
      const Point p = to_point(soup.vertices[v]);
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  Wrapper wrapper(soup, distance_m, low, high);
  const auto refuse = [&](const std::string& why, double times) {
    report.problem = "--wrap " + soup.frame.length_text(distance_m) + " needs " + why +
                     ": choose at least " + soup.frame.length_text(1.1 * times * distance_m);
    return Surface{};
  };
  if (!(wrapper.nodes() <= kMaxNodes))
    return refuse("too fine a grid", std::cbrt(wrapper.nodes() / kMaxNodes));
  wrapper.classify();
  report.voids = wrapper.flood();
  const size_t triangles = wrapper.triangles();
  if (triangles > max_triangles)
    return refuse(std::to_string(triangles) + " triangles, more than the " +
                      std::to_string(max_triangles) + " of an asset",
                  std::sqrt(static_cast<double>(triangles) / static_cast<double>(max_triangles)));
  Surface wrapped = wrapper.extract();
  wrapped.frame = soup.frame;
  if (points_outside(soup, wrapped) != 0)
    report.problem =
        "has points that its wrapping does not enclose: a defect of the wrapper, please report the "
        "input";
  return wrapped;
}

}  // namespace firmtouch::tools
