#include "spline/shared_borders.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

// A border is cut into short segments. Where the middle of one lies on a segment of another
// surface's border, and of no second one's, both are shared there: their surfaces have their
// normals on one side where the borders, each gone along with its surface to the left, run against
// each other.

namespace firmtouch::tools {
namespace {

constexpr double kShared = 2e-5;  // of the extent
constexpr int kSegments = 8;      // of a border between two knots
constexpr int kCells = 50;        // of the extent

struct Border {
  size_t surface;
  int side;  // v = v0, u = u1, v = v1, u = u0
};

struct Segment {
  size_t border;
  double from, to;  // of the parameter that changes
  Point first, middle, last;
};

Point on(const SplineModel& model, const Border& border, double t) {
  const SplineSurface& s = model.surfaces[border.surface];
  switch (border.side) {
    case 0:
      return point_at(s, t, s.v0);
    case 1:
      return point_at(s, s.u1, t);
    case 2:
      return point_at(s, t, s.v1);
    default:
      return point_at(s, s.u0, t);
  }
}

class Neighbours {
 public:
  explicit Neighbours(const SplineModel& model) : model_(model) {
    for (size_t i = 0; i < model.surfaces.size(); ++i)
      for (int side = 0; side < 4; ++side) cut({i, side});
    measure();
    for (size_t i = 0; i < segments_.size(); ++i) put(i);
    std::sort(cells_.begin(), cells_.end());
    counted_.assign(borders_.size(), 0);
    shared_ = counted_;
    for (const Segment& segment : segments_) count_shared(segment);
  }
  /// By the two surfaces, the lower first.
  const std::map<std::pair<size_t, size_t>, BorderVotes>& votes() const { return votes_; }
  /// More than a quarter of a border of the surface is shared with none, or with two: one place may
  /// be crossed.
  bool is_open(size_t surface) const {
    for (size_t b = 4 * surface; b < 4 * surface + 4; ++b)
      if (4 * (counted_[b] - shared_[b]) > counted_[b]) return true;
    return false;
  }

 private:
  void cut(const Border& border) {
    const SplineSurface& s = model_.surfaces[border.surface];
    const bool is_along_u = border.side % 2 == 0;
    const std::vector<double>& knots = is_along_u ? s.knots_u : s.knots_v;
    const double low = is_along_u ? s.u0 : s.v0, high = is_along_u ? s.u1 : s.v1;
    for (size_t k = 0; k + 1 < knots.size(); ++k) {
      const double a = std::max(knots[k], low), b = std::min(knots[k + 1], high);
      if (!(a < b)) continue;
      for (int i = 0; i < kSegments; ++i) {
        const double from = a + (b - a) * i / kSegments, to = a + (b - a) * (i + 1) / kSegments;
        segments_.push_back({borders_.size(), from, to, on(model_, border, from),
                             on(model_, border, 0.5 * (from + to)), on(model_, border, to)});
      }
    }
    borders_.push_back(border);
  }

  void measure() {
    Point high = segments_.front().middle;
    low_ = high;
    for (const Segment& s : segments_)
      for (const Point& p : {s.first, s.middle, s.last}) {
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
    const double extent = std::max({high.x - low_.x, high.y - low_.y, high.z - low_.z});
    near_ = kShared * extent;
    cell_ = extent / kCells;
  }

  int64_t cell(double at, double low) const {
    return cell_ > 0 ? static_cast<int64_t>(std::floor((at - low) / cell_)) : 0;
  }
  static uint64_t key(int64_t x, int64_t y, int64_t z) {
    const auto bits = [](int64_t at) { return static_cast<uint64_t>(at + 1024) & 0xFFFFu; };
    return bits(x) << 32 | bits(y) << 16 | bits(z);
  }

  // Into every cell that it may reach, curved as it is.
  void put(size_t index) {
    const Segment& s = segments_[index];
    const Point chord = (s.first + s.last) * 0.5;
    const double more = 2 * length(s.middle - chord) + near_;
    const auto range = [&](double a, double b, double low) {
      return std::make_pair(cell(std::min(a, b) - more, low), cell(std::max(a, b) + more, low));
    };
    const auto x = range(s.first.x, s.last.x, low_.x), y = range(s.first.y, s.last.y, low_.y),
               z = range(s.first.z, s.last.z, low_.z);
    for (int64_t i = x.first; i <= x.second; ++i)
      for (int64_t j = y.first; j <= y.second; ++j)
        for (int64_t k = z.first; k <= z.second; ++k) cells_.push_back({key(i, j, k), index});
  }

  // How far a point is from a segment, by golden section.
  double off(const Segment& s, const Point& p) const {
    constexpr double kShare = 0.381966011250105;
    const auto distance = [&](double t) { return length(on(model_, borders_[s.border], t) - p); };
    double a = s.from, b = s.to;
    double low = a + kShare * (b - a), high = b - kShare * (b - a);
    double at_low = distance(low), at_high = distance(high);
    double least = std::min({at_low, at_high, length(s.first - p), length(s.last - p)});
    for (int turn = 0; turn < 32 && least > 0.1 * near_; ++turn) {
      if (at_low < at_high) {
        b = high, high = low, at_high = at_low;
        low = a + kShare * (b - a);
        at_low = distance(low);
      } else {
        a = low, low = high, at_low = at_high;
        high = b - kShare * (b - a);
        at_high = distance(high);
      }
      least = std::min({least, at_low, at_high});
    }
    return least;
  }

  // The curve bows from its chord by about as much as its middle does.
  bool may_hold(const Segment& s, const Point& p) const {
    const Point chord = s.last - s.first, way = p - s.first;
    const double t = std::clamp(dot(way, chord) / dot(chord, chord), 0.0, 1.0);
    return length(way - chord * t) <= 2 * length(s.middle - (s.first + s.last) * 0.5) + near_;
  }

  // Its surface to the left, seen from where the normal points.
  Point along(const Segment& s) const {
    const Point way = s.last - s.first;
    return borders_[s.border].side < 2 ? way : way * -1;
  }

  void count_shared(const Segment& own) {
    if (length(own.last - own.first) < 4 * near_) return;  // a pole has no direction
    ++counted_[own.border];
    shared_[own.border] += is_shared(own);
  }

  bool is_shared(const Segment& own) {
    const Point& p = own.middle;
    const uint64_t at = key(cell(p.x, low_.x), cell(p.y, low_.y), cell(p.z, low_.z));
    auto found = std::lower_bound(cells_.begin(), cells_.end(), std::make_pair(at, size_t{0}));
    const Segment* other = nullptr;
    for (; found != cells_.end() && found->first == at; ++found) {
      const Segment& s = segments_[found->second];
      if (s.border == own.border || length(s.last - s.first) < 4 * near_) continue;
      if (!may_hold(s, p) || off(s, p) > near_) continue;
      if (other != nullptr && other->border != s.border)
        return false;  // three meet: none is the next
      other = &s;
    }
    if (other == nullptr) return false;
    const size_t a = borders_[own.border].surface, b = borders_[other->border].surface;
    BorderVotes& votes = votes_[{std::min(a, b), std::max(a, b)}];
    ++(dot(along(own), along(*other)) > 0 ? votes.along : votes.against);
    return true;
  }

  const SplineModel& model_;
  std::vector<Border> borders_;
  std::vector<Segment> segments_;
  std::vector<std::pair<uint64_t, size_t>> cells_;
  std::map<std::pair<size_t, size_t>, BorderVotes> votes_;
  std::vector<size_t> counted_, shared_;  // segments of a border
  Point low_;
  double near_ = 0, cell_ = 0;
};

}  // namespace

SharedBorders shared_borders(const SplineModel& model) {
  const Neighbours neighbours(model);
  SharedBorders shared;
  shared.votes = neighbours.votes();
  for (size_t i = 0; i < model.surfaces.size(); ++i)
    shared.is_open.push_back(neighbours.is_open(i));
  return shared;
}

}  // namespace firmtouch::tools
