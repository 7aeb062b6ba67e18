#include "spline/orientation.hpp"

#include <algorithm>

#include "spline/shared_borders.hpp"
#include "spline/shell_sides.hpp"

namespace firmtouch::tools {
namespace {

constexpr size_t kMaxNamed = 4;

constexpr int kFewVotes = 2;  // one may be a corner's

struct Joint {
  size_t to;
  bool turns;
};

// A shell from one surface on, with which of it are turned against that one.
struct Shell {
  std::vector<size_t> surfaces;
  bool is_one_sided = false, is_open = false;
};

class Shells {
 public:
  explicit Shells(const SplineModel& model) : joints_(model.surfaces.size()) {
    const SharedBorders shared = shared_borders(model);
    for (const auto& [pair, votes] : shared.votes) {
      if (votes.along >= kFewVotes) join(pair.first, pair.second, true);
      if (votes.against >= kFewVotes) join(pair.first, pair.second, false);
    }
    turned_.assign(model.surfaces.size(), 0);
    std::vector<char> seen(model.surfaces.size(), 0);
    for (size_t i = 0; i < model.surfaces.size(); ++i)
      if (seen[i] == 0) shells_.push_back(from(i, seen));
    for (Shell& shell : shells_)
      for (const size_t s : shell.surfaces) shell.is_open = shell.is_open || shared.is_open[s];
  }
  const std::vector<Shell>& all() const { return shells_; }
  void turn(const Shell& shell) {
    for (const size_t s : shell.surfaces) turned_[s] = turned_[s] == 0 ? 1 : 0;
  }
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

// Closed shells that lie otherwise than most: fewer surfaces are turned over than are left. Result:
// how many shells nothing is known of.
size_t turn_closed(SplineModel& model, Shells& shells) {
  std::vector<const Shell*> closed;
  std::vector<std::vector<size_t>> surfaces;
  for (const Shell& shell : shells.all()) {
    if (shell.is_one_sided || shell.is_open) continue;
    closed.push_back(&shell);
    surfaces.push_back(shell.surfaces);
  }
  size_t unknown = shells.all().size() - closed.size();
  if (closed.size() < 2) return unknown + closed.size();
  const std::vector<int> sides = sides_of_shells(model, surfaces);
  size_t out = 0, in = 0;
  for (size_t i = 0; i < closed.size(); ++i) {
    if (sides[i] == 0) ++unknown;
    (sides[i] > 0 ? out : in) += sides[i] != 0 ? surfaces[i].size() : 0;
  }
  const int fewer = in <= out ? -1 : 1;
  for (size_t i = 0; i < closed.size(); ++i)
    if (sides[i] == fewer) shells.turn(*closed[i]);
  return unknown + (out + in > 0 ? 1 : 0);
}

std::string named(const SplineModel& model, const std::vector<size_t>& which) {
  std::string text;
  for (size_t i = 0; i < which.size() && i < kMaxNamed; ++i)
    text += (i > 0 ? ", " : "") + model.surfaces[which[i]].where;
  if (which.size() > kMaxNamed)
    text += " and " + std::to_string(which.size() - kMaxNamed) + " more";
  return text;
}

}  // namespace

void orient(SplineModel& model) {
  if (!model.problem.empty() || model.surfaces.empty()) return;
  Shells shells(model);
  const auto apply = [&] {
    for (size_t i = 0; i < model.surfaces.size(); ++i)
      model.surfaces[i].is_turned = shells.is_turned(i);
  };
  apply();
  const size_t apart = turn_closed(model, shells);
  apply();
  std::vector<size_t> turned;
  for (size_t i = 0; i < model.surfaces.size(); ++i)
    if (shells.is_turned(i)) turned.push_back(i);
  if (!turned.empty())
    model.notes.push_back("turned over " + std::to_string(turned.size()) + " of " +
                          std::to_string(model.surfaces.size()) +
                          " surfaces, so that normals point to one side: " + named(model, turned));
  for (const Shell& shell : shells.all())
    if (shell.is_one_sided)
      model.notes.push_back("has a shell of one side, where normals cannot agree, left as it is: " +
                            named(model, shell.surfaces) +
                            "; cut it into two models to touch it from each side");
  if (apart > 1)
    model.notes.push_back(
        "its " + std::to_string(shells.all().size()) +
        " shells share no border and do not all enclose something, so that the file "
        "alone says which side of each is free: look at the normals if one feels "
        "turned");
}

}  // namespace firmtouch::tools
