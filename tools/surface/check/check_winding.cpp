#include <algorithm>
#include <memory>

#include "surface/box_tree.hpp"
#include "surface/check/mending.hpp"
#include "surface/extent.hpp"
#include "surface/point.hpp"
#include "surface/triangle_distance.hpp"
#include "surface/winding_number.hpp"

namespace firmtouch::tools {
namespace {

// Of the diagonal. Reading the coordinates may take 1.5e-7 off at each of two shells.
constexpr double kReading = 3e-7;

void turn(Face& face) { std::swap(face[1], face[2]); }

double volume6(const Surface& surface, const Face& face, Point origin) {
  return dot(to_point(surface.vertices[face[0]]) - origin,
             cross(to_point(surface.vertices[face[1]]) - origin,
                   to_point(surface.vertices[face[2]]) - origin));
}

struct Shell {
  uint32_t first_face = kNone;
  uint32_t faces = 0, turned = 0;
  double volume6 = 0;
  Box box;
};

std::vector<Shell> measure(const Surface& surface, const std::vector<uint32_t>& component,
                           uint32_t components, const std::vector<bool>& turned) {
  std::vector<Shell> shells(components);
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    Shell& shell = shells[component[f]];
    if (shell.faces++ == 0) {
      shell.first_face = f;
      shell.box.low = shell.box.high = to_point(surface.vertices[surface.faces[f][0]]);
    }
    shell.turned += turned[f] ? 1u : 0u;
    for (const uint32_t v : surface.faces[f]) {
      const Point p = to_point(surface.vertices[v]);
      grow(shell.box, {p, p});
    }
    shell.volume6 += volume6(surface, surface.faces[f],
                             to_point(surface.vertices[surface.faces[shell.first_face][0]]));
  }
  return shells;
}

bool within(const Box& a, const Box& b, double margin) {
  return a.low.x > b.low.x - margin && a.low.y > b.low.y - margin && a.low.z > b.low.z - margin &&
         a.high.x < b.high.x + margin && a.high.y < b.high.y + margin &&
         a.high.z < b.high.z + margin;
}

// The faces of one shell with their own vertices, so that a query costs by its own size.
class ShellsAlone {
 public:
  ShellsAlone(const Surface& surface, const std::vector<uint32_t>& component, size_t shells)
      : surface_(surface), faces_(shells), index_(surface.vertices.size(), kNone) {
    for (uint32_t f = 0; f < surface.faces.size(); ++f) faces_[component[f]].push_back(f);
  }

  const std::vector<uint32_t>& faces(uint32_t shell) const { return faces_[shell]; }

  Surface alone(uint32_t shell) {
    Surface part;
    for (const uint32_t f : faces_[shell]) {
      Face face = surface_.faces[f];
      for (uint32_t& v : face) {
        if (index_[v] == kNone) {
          index_[v] = static_cast<uint32_t>(part.vertices.size());
          part.vertices.push_back(surface_.vertices[v]);
        }
        v = index_[v];
      }
      part.faces.push_back(face);
    }
    for (const uint32_t f : faces_[shell])
      for (const uint32_t v : surface_.faces[f]) index_[v] = kNone;
    return part;
  }

 private:
  const Surface& surface_;
  std::vector<std::vector<uint32_t>> faces_;
  std::vector<uint32_t> index_;  // of the vertices in the part at hand
};

// A shell and another one around it.
class Around {
 public:
  Around(const Surface& shell, double reading_m)
      : shell_(shell), winding_(shell_, {}), reading_m_(reading_m) {}

  bool has_inside(Point p) const { return winding_.at(p) != 0; }

  // Whether rounding may have moved the point through the shell.
  bool is_near(Point p) {
    if (!faces_) faces_ = std::make_unique<BoxTree>(boxes());
    const Point by{reading_m_, reading_m_, reading_m_};
    found_.clear();
    faces_->overlaps({p - by, p + by}, found_);
    return std::any_of(found_.begin(), found_.end(), [&](uint32_t f) {
      return distance2_to_triangle(p, corner(f, 0), corner(f, 1), corner(f, 2)) <=
             reading_m_ * reading_m_;
    });
  }

 private:
  Point corner(uint32_t f, uint32_t k) const {
    return to_point(shell_.vertices[shell_.faces[f][k]]);
  }
  std::vector<Box> boxes() const {
    std::vector<Box> boxes;
    for (uint32_t f = 0; f < shell_.faces.size(); ++f) {
      boxes.push_back({corner(f, 0), corner(f, 0)});
      for (uint32_t k = 1; k < 3; ++k) grow(boxes.back(), {corner(f, k), corner(f, k)});
    }
    return boxes;
  }

  Surface shell_;
  WindingNumber winding_;
  double reading_m_;
  std::unique_ptr<BoxTree> faces_;  // made where a vertex is not inside
  std::vector<uint32_t> found_;
};

enum class Nested { kNo, kYes, kUnsure };

// Whether all vertices of the faces lie inside. Those that rounding may have moved through the
// shell do not count; where no other is left, nothing is known.
Nested nested(const Surface& surface, const std::vector<uint32_t>& faces, Around& around) {
  bool all_inside = true, any_clear = false;
  for (const uint32_t f : faces) {
    for (const uint32_t v : surface.faces[f]) {
      const Point p = to_point(surface.vertices[v]);
      if (around.has_inside(p)) continue;
      if (!around.is_near(p)) return Nested::kNo;
      all_inside = false;
    }
  }
  if (all_inside) return Nested::kYes;
  for (const uint32_t f : faces)
    for (const uint32_t v : surface.faces[f])
      any_clear = any_clear || !around.is_near(to_point(surface.vertices[v]));
  return any_clear ? Nested::kYes : Nested::kUnsure;
}

struct Nesting {
  uint32_t depth = 0;  // in how many other shells it lies: where that is odd it bounds a cavity
  bool is_sure = true;
};

// Shells that cross one another are not nested.
std::vector<Nesting> nesting(const Surface& surface, const std::vector<uint32_t>& component,
                             const std::vector<Shell>& shells) {
  ShellsAlone parts(surface, component, shells.size());
  std::vector<Nesting> nestings(shells.size());
  std::vector<uint32_t> by_low(shells.size());
  const Extent extent = extent_of(surface);
  const double reading_m = kReading * length(extent.high - extent.low);
  for (uint32_t s = 0; s < by_low.size(); ++s) by_low[s] = s;
  const auto low = [&](uint32_t s) { return shells[s].box.low.x; };
  std::sort(by_low.begin(), by_low.end(), [&](uint32_t a, uint32_t b) {
    return low(a) < low(b) || (!(low(b) < low(a)) && a < b);
  });
  for (uint32_t outer = 0; outer < shells.size(); ++outer) {
    std::vector<uint32_t> candidates;
    auto next = std::upper_bound(by_low.begin(), by_low.end(), low(outer) - reading_m,
                                 [&](double x, uint32_t s) { return x < low(s); });
    for (; next != by_low.end() && low(*next) < shells[outer].box.high.x; ++next)
      if (*next != outer && within(shells[*next].box, shells[outer].box, reading_m))
        candidates.push_back(*next);
    if (candidates.empty()) continue;
    Around around(parts.alone(outer), reading_m);
    for (const uint32_t s : candidates) {
      const Nested is_nested = nested(surface, parts.faces(s), around);
      if (is_nested == Nested::kYes) ++nestings[s].depth;
      if (is_nested == Nested::kUnsure) nestings[s].is_sure = false;
    }
  }
  return nestings;
}

}  // namespace

uint32_t wind_alike(Surface& surface, std::vector<uint32_t>& component, std::vector<bool>& turned,
                    std::vector<std::string>& defects) {
  const std::vector<uint32_t> mates = Edges(surface.faces).mates();
  const uint32_t count = static_cast<uint32_t>(surface.faces.size());
  component.assign(count, kNone);
  turned.assign(count, false);
  uint32_t components = 0, one_sided = 0, first = kNone;
  std::vector<uint32_t> queue;
  for (uint32_t seed = 0; seed < count; ++seed) {
    if (component[seed] != kNone) continue;
    queue.assign(1, seed);
    component[seed] = components;
    uint32_t turns = 0;
    bool has_one_side = false;
    for (size_t at = 0; at < queue.size(); ++at) {
      const uint32_t f = queue[at];
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t h = 3 * f + k, mate = mates[h];
        if (mate == kNone) continue;
        const bool same_way = start_of(surface.faces, h) == start_of(surface.faces, mate);
        const bool must_turn = turned[f] != same_way;
        if (component[mate / 3] == kNone) {
          component[mate / 3] = components;
          turned[mate / 3] = must_turn;
          turns += must_turn ? 1u : 0u;
          queue.push_back(mate / 3);
        } else if (turned[mate / 3] != must_turn) {
          has_one_side = true;
          if (first == kNone) first = f;
        }
      }
    }
    if (has_one_side) ++one_sided;
    const bool keep_as_is = has_one_side;
    const bool turn_the_rest =
        turns > queue.size() - turns;  // the majority is right, until the volume decides
    for (const uint32_t f : queue) turned[f] = !keep_as_is && turned[f] != turn_the_rest;
    ++components;
  }
  for (uint32_t f = 0; f < count; ++f) {
    if (turned[f]) turn(surface.faces[f]);
  }
  if (one_sided != 0) {
    defects.push_back("has " + counted(one_sided, "piece", "pieces") +
                      " with one side alone, as a Moebius band, first near " +
                      named_face(surface, first) +
                      ": no winding makes an outside; model it as a solid");
  }
  return components;
}

void wind_outward(Surface& surface, const std::vector<uint32_t>& component, uint32_t components,
                  bool is_closed, std::vector<bool>& turned, CheckReport& report) {
  std::vector<Shell> shells = measure(surface, component, components, turned);
  std::vector<bool> inverted(components, false);
  if (is_closed) {
    const std::vector<Nesting> nestings = nesting(surface, component, shells);
    for (uint32_t s = 0; s < components; ++s) {
      if (!nestings[s].is_sure) continue;  // as the file has it
      const bool is_cavity = nestings[s].depth % 2 == 1;
      inverted[s] = is_cavity ? shells[s].volume6 > 0 : shells[s].volume6 < 0;
      if (inverted[s]) shells[s].turned = shells[s].faces - shells[s].turned;
    }
  }
  uint32_t odd_faces = 0, odd_shells = 0, first_odd = kNone, inside_out = 0, faces_of_those = 0,
           first_shell = kNone;
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    const Shell& shell = shells[component[f]];
    if (inverted[component[f]]) {
      turn(surface.faces[f]);
      turned[f] = !turned[f];
    }
    const bool mostly = shell.turned > shell.faces - shell.turned;
    if (turned[f] != mostly) {  // against the rest of its shell
      ++odd_faces;
      first_odd = std::min(first_odd, f);
    }
  }
  for (const Shell& shell : shells) {
    const bool mostly = shell.turned > shell.faces - shell.turned;
    if (shell.turned != 0 && shell.turned != shell.faces) ++odd_shells;
    if (!mostly) continue;
    ++inside_out;
    faces_of_those += shell.faces;
    first_shell = std::min(first_shell, shell.first_face);
  }
  if (odd_faces != 0) {
    report.mended.push_back("turned " + counted(odd_faces, "face", "faces") +
                            " wound against the rest of " + counted(odd_shells, "piece", "pieces") +
                            ", first " + named_face(surface, first_odd));
  }
  if (inside_out != 0) {
    report.mended.push_back("turned " + counted(inside_out, "piece", "pieces") + " of " +
                            counted(faces_of_those, "face", "faces") +
                            " wound inside out, first with " + named_face(surface, first_shell));
  }
}

}  // namespace firmtouch::tools
