#include "spline/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

// A border is cut into short segments. Where the middle of one lies on a segment of another surface's
// border, and of no second one's, both are shared there: their surfaces have their normals on one side where
// the borders, each gone along with its surface to the left, run against each other.

namespace firmtouch::tools {
namespace {

constexpr double kShared = 2e-5;  // of the extent
constexpr int kSegments = 8;      // of a border between two knots
constexpr int kCells = 50;        // of the extent
constexpr size_t kMostNamed = 4;

struct Border {
  size_t surface;
  int side;  // v = v0, u = u1, v = v1, u = u0
};

struct Segment {
  size_t border;
  double from, to;  // of the parameter that changes
  Point first, middle, last;
};

struct Votes {
  int along = 0, against = 0;
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
    for (const Segment& segment : segments_) ask(segment);
  }
  /// By the two surfaces, the lower first.
  const std::map<std::pair<size_t, size_t>, Votes>& votes() const { return votes_; }

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

  void ask(const Segment& own) {
    if (length(own.last - own.first) < 4 * near_) return;  // a pole has no direction
    const Point& p = own.middle;
    const uint64_t at = key(cell(p.x, low_.x), cell(p.y, low_.y), cell(p.z, low_.z));
    auto found = std::lower_bound(cells_.begin(), cells_.end(), std::make_pair(at, size_t{0}));
    const Segment* other = nullptr;
    for (; found != cells_.end() && found->first == at; ++found) {
      const Segment& s = segments_[found->second];
      if (s.border == own.border || length(s.last - s.first) < 4 * near_) continue;
      if (!may_hold(s, p) || off(s, p) > near_) continue;
      if (other != nullptr && other->border != s.border) return;  // three meet: none is the next
      other = &s;
    }
    if (other == nullptr) return;
    const size_t a = borders_[own.border].surface, b = borders_[other->border].surface;
    Votes& votes = votes_[{std::min(a, b), std::max(a, b)}];
    ++(dot(along(own), along(*other)) > 0 ? votes.along : votes.against);
  }

  const SplineModel& model_;
  std::vector<Border> borders_;
  std::vector<Segment> segments_;
  std::vector<std::pair<uint64_t, size_t>> cells_;
  std::map<std::pair<size_t, size_t>, Votes> votes_;
  Point low_;
  double near_ = 0, cell_ = 0;
};

constexpr int kFewVotes = 2;  // one may be a corner's

struct Joint {
  size_t to;
  bool turns;
};

// A shell from one surface on, with which of it are turned against that one.
struct Shell {
  std::vector<size_t> surfaces;
  bool is_one_sided = false;
};

class Shells {
 public:
  explicit Shells(const SplineModel& model) : joints_(model.surfaces.size()) {
    const Neighbours neighbours(model);
    for (const auto& [pair, votes] : neighbours.votes()) {
      if (votes.along >= kFewVotes) join(pair.first, pair.second, true);
      if (votes.against >= kFewVotes) join(pair.first, pair.second, false);
    }
    turned_.assign(model.surfaces.size(), 0);
    std::vector<char> seen(model.surfaces.size(), 0);
    for (size_t i = 0; i < model.surfaces.size(); ++i)
      if (seen[i] == 0) shells_.push_back(from(i, seen));
  }
  std::vector<Shell>& all() { return shells_; }
  bool is_turned(size_t surface) const { return turned_[surface] != 0; }

 private:
  void join(size_t a, size_t b, bool turns) {
    joints_[a].push_back({b, turns});
    if (a != b) joints_[b].push_back({a, turns});
  }

  Shell from(size_t first, std::vector<char>& seen) {
    Shell shell;
    shell.surfaces.push_back(first);
    seen[first] = 1;
    for (size_t k = 0; k < shell.surfaces.size(); ++k) {
      const size_t at = shell.surfaces[k];
      for (const Joint& joint : joints_[at]) {
        const char side = static_cast<char>((turned_[at] != 0) != joint.turns);
        if (seen[joint.to] == 0) {
          seen[joint.to] = 1;
          turned_[joint.to] = side;
          shell.surfaces.push_back(joint.to);
        } else if (turned_[joint.to] != side) {
          shell.is_one_sided = true;
        }
      }
    }
    size_t count = 0;
    for (const size_t s : shell.surfaces) count += turned_[s] != 0;
    const bool others = 2 * count > shell.surfaces.size();  // the fewer are turned
    for (const size_t s : shell.surfaces)
      turned_[s] = !shell.is_one_sided && (turned_[s] != 0) != others ? 1 : 0;
    std::sort(shell.surfaces.begin(), shell.surfaces.end());
    return shell;
  }

  std::vector<std::vector<Joint>> joints_;
  std::vector<char> turned_;
  std::vector<Shell> shells_;
};

std::string named(const SplineModel& model, const std::vector<size_t>& which) {
  std::string text;
  for (size_t i = 0; i < which.size() && i < kMostNamed; ++i)
    text += (i > 0 ? ", " : "") + model.surfaces[which[i]].where;
  if (which.size() > kMostNamed)
    text += " and " + std::to_string(which.size() - kMostNamed) + " more";
  return text;
}

}  // namespace

void orient(SplineModel& model) {
  if (!model.problem.empty() || model.surfaces.empty()) return;
  Shells shells(model);
  std::vector<size_t> turned;
  for (size_t i = 0; i < model.surfaces.size(); ++i) {
    model.surfaces[i].is_turned = shells.is_turned(i);
    if (shells.is_turned(i)) turned.push_back(i);
  }
  if (!turned.empty())
    model.notes.push_back(
        "turned over " + std::to_string(turned.size()) + " of " +
        std::to_string(model.surfaces.size()) +
        " surfaces, so that normals point to one side of each shell: " + named(model, turned));
  for (const Shell& shell : shells.all())
    if (shell.is_one_sided)
      model.notes.push_back("has a shell of one side, where normals cannot agree, left as it is: " +
                            named(model, shell.surfaces) +
                            "; cut it into two models to touch it from each side");
  if (shells.all().size() > 1)
    model.notes.push_back("its " + std::to_string(shells.all().size()) +
                          " shells share no border, so that the file alone says which side of each "
                          "is free: look at the normals if one feels turned");
}

}  // namespace firmtouch::tools
