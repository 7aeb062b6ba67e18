#include "surface/make/make_cad.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "surface/ear_clip.hpp"
#include "surface/random.hpp"
#include "surface/turns.hpp"

namespace firmtouch::tools {
namespace {

int64_t micrometres(double length_mm) {
  return static_cast<int64_t>(std::floor(length_mm * 1000 + 0.5));
}
DrawingPoint drawn(double x_mm, double y_mm) { return {micrometres(x_mm), micrometres(y_mm)}; }

void add_arc(Outline& outline, double x_mm, double y_mm, double radius_mm, double from_turns,
             double to_turns, uint32_t pieces) {
  for (uint32_t k = 0; k <= pieces; ++k) {
    const double turns = from_turns + (to_turns - from_turns) * k / pieces;
    outline.push_back(
        drawn(x_mm + radius_mm * cosine_of_turns(turns), y_mm + radius_mm * sine_of_turns(turns)));
  }
}

Outline circle(double x_mm, double y_mm, double radius_mm, uint32_t pieces) {
  Outline outline;
  add_arc(outline, x_mm, y_mm, radius_mm, 0, 1, pieces);
  outline.pop_back();
  return outline;
}

Outline as_hole(Outline outline) {
  std::reverse(outline.begin(), outline.end());
  return outline;
}

// The prism over a drawing: both ends by `caps`, and a wall of two triangles an edge.
CadPart extrude(const std::vector<Outline>& loops, const std::vector<Face>& caps,
                double height_mm) {
  CadPart part;
  for (const double z_mm : {0.0, static_cast<double>(micrometres(height_mm)) / 1000})
    for (const Outline& loop : loops)
      for (const DrawingPoint& p : loop)
        part.vertices_mm.push_back(
            {static_cast<double>(p.x) / 1000, static_cast<double>(p.y) / 1000, z_mm});
  const uint32_t above = static_cast<uint32_t>(part.vertices_mm.size() / 2);
  for (const Face& f : caps) {
    part.faces.push_back({f[0], f[2], f[1]});
    part.faces.push_back({f[0] + above, f[1] + above, f[2] + above});
  }
  uint32_t first = 0;
  for (const Outline& loop : loops) {
    const uint32_t count = static_cast<uint32_t>(loop.size());
    for (uint32_t k = 0; k < count; ++k) {
      const uint32_t a = first + k, b = first + (k + 1) % count;
      part.faces.push_back({a, b, b + above});
      part.faces.push_back({a, b + above, a + above});
    }
    first += count;
  }
  return part;
}

CadPart extrude(const std::vector<Outline>& loops, double height_mm) {
  return extrude(loops, clip_ears(loops), height_mm);
}

// A rectangle with rounded or chamfered corners, and holes and slots in rows.
CadPart make_plate(Random& random) {
  const double width_mm = random.between(60, 200), depth_mm = random.between(40, 120);
  const double corner_mm = random.between(2, 9);
  const uint32_t corner_pieces = random.below(2) == 0 ? 1 : 4 + random.below(9);
  std::vector<Outline> loops(1);
  const double right_mm = width_mm - corner_mm, top_mm = depth_mm - corner_mm;
  add_arc(loops[0], right_mm, top_mm, corner_mm, 0, 0.25, corner_pieces);
  add_arc(loops[0], corner_mm, top_mm, corner_mm, 0.25, 0.5, corner_pieces);
  add_arc(loops[0], corner_mm, corner_mm, corner_mm, 0.5, 0.75, corner_pieces);
  add_arc(loops[0], right_mm, corner_mm, corner_mm, 0.75, 1, corner_pieces);
  const uint32_t columns = 2 + random.below(5), rows = 1 + random.below(4);
  const double pitch_x_mm = width_mm / columns, pitch_y_mm = depth_mm / rows;
  const double largest_mm = 0.42 * std::min(pitch_x_mm, pitch_y_mm) - 1;
  for (uint32_t i = 0; i < columns * rows; ++i) {
    const double x_mm = (i % columns + 0.5) * pitch_x_mm, y_mm = (i / columns + 0.5) * pitch_y_mm;
    const double radius_mm = random.between(0.25, 1) * largest_mm;
    const uint32_t pieces = 16 + 4 * random.below(17);
    if (random.below(4) != 0) {
      loops.push_back(as_hole(circle(x_mm, y_mm, radius_mm, pieces)));
      continue;
    }
    Outline slot;  // half as high as wide
    add_arc(slot, x_mm + radius_mm / 2, y_mm, radius_mm / 2, -0.25, 0.25, pieces / 2);
    add_arc(slot, x_mm - radius_mm / 2, y_mm, radius_mm / 2, 0.25, 0.75, pieces / 2);
    loops.push_back(as_hole(slot));
  }
  return extrude(loops, random.between(3, 12));
}

// Teeth with three points a flank about a bore with a keyway.
CadPart make_gear(Random& random) {
  const uint32_t teeth = 14 + random.below(40);
  const double module_mm = random.between(1, 2.5), pitch_mm = module_mm * teeth / 2;
  const double radius_mm[4] = {pitch_mm - 1.25 * module_mm, pitch_mm - 0.4 * module_mm,
                               pitch_mm + 0.4 * module_mm, pitch_mm + module_mm};
  const double half_turns[4] = {0.36, 0.29, 0.2, 0.12};  // of a tooth, in pitches
  std::vector<Outline> loops(1);
  for (uint32_t t = 0; t < teeth; ++t)
    for (int side = -1; side <= 1; side += 2)
      for (size_t k = 0; k < 4; ++k) {
        const size_t at = side < 0 ? k : 3 - k;
        const double turns = (t + side * half_turns[at]) / teeth;
        loops[0].push_back(
            drawn(radius_mm[at] * cosine_of_turns(turns), radius_mm[at] * sine_of_turns(turns)));
      }
  const double bore_mm = radius_mm[0] * random.between(0.2, 0.5);
  Outline bore;
  add_arc(bore, 0, 0, bore_mm, 0.04, 0.96, 24 + random.below(40));
  const double key_mm = bore_mm * sine_of_turns(0.04);
  bore.push_back(drawn(bore_mm * 1.25, -key_mm));
  bore.push_back(drawn(bore_mm * 1.25, key_mm));
  loops.push_back(as_hole(bore));
  return extrude(loops, random.between(4, 25));
}

// A strip with round bends of 30 to 90 degrees, this way and that way.
CadPart make_sheet(Random& random) {
  const double thickness_mm = random.between(0.8, 3);
  const uint32_t bends = 4 + 2 * random.below(4);
  double x_mm = 0, y_mm = 0, heading = 0;
  Outline one_side, other_side;
  const auto add_pair = [&] {
    const double across_x = -sine_of_turns(heading) * thickness_mm / 2,
                 across_y = cosine_of_turns(heading) * thickness_mm / 2;
    one_side.push_back(drawn(x_mm - across_x, y_mm - across_y));
    other_side.push_back(drawn(x_mm + across_x, y_mm + across_y));
  };
  const auto go = [&](double length_mm) {
    x_mm += length_mm * cosine_of_turns(heading);
    y_mm += length_mm * sine_of_turns(heading);
  };
  add_pair();
  double turned = 0;
  for (uint32_t k = 0; k < bends; ++k) {
    go(random.between(10, 35));
    add_pair();
    // Pairs of bends turn back what they turned, so that the strip never meets itself.
    const double turn = k % 2 == 0 ? random.between(1.0 / 12, 0.2) : turned;
    const double way = (k + 1) % 4 < 2 ? 1 : -1;
    turned = turn;
    const double radius_mm = thickness_mm * random.between(1, 2.5);
    const uint32_t pieces = 6 + random.below(15);
    const double step_mm = 2 * radius_mm * sine_of_turns(turn / pieces / 2);
    for (uint32_t i = 0; i < pieces; ++i) {
      heading += way * turn / pieces / 2;
      go(step_mm);
      heading += way * turn / pieces / 2;
      add_pair();
    }
  }
  go(random.between(10, 35));
  add_pair();
  Outline profile = one_side;
  profile.insert(profile.end(), other_side.rbegin(), other_side.rend());
  return extrude({profile}, random.between(30, 120));
}

// A bar whose ends are fans about a centre or a corner.
CadPart make_extrusion(Random& random) {
  const uint32_t pieces = 48 + 4 * random.below(90), lobes = 3 + random.below(5);
  const double radius_mm = random.between(8, 30);
  const bool is_round = random.below(2) == 0;
  const double lobe = is_round ? 0 : random.between(0.1, 0.25);
  Outline outline;
  for (uint32_t k = 0; k < pieces; ++k) {
    const double turns = static_cast<double>(k) / pieces;
    const double at_mm = radius_mm * (1 + lobe * cosine_of_turns(lobes * turns));
    outline.push_back(drawn(at_mm * cosine_of_turns(turns), at_mm * sine_of_turns(turns)));
  }
  std::vector<Face> caps;
  std::vector<Outline> loops{outline};
  const double height_mm = random.between(20, 150);
  if (is_round) {  // about a corner
    for (uint32_t k = 1; k + 1 < pieces; ++k) caps.push_back({0, k, k + 1});
    return extrude(loops, caps, height_mm);
  }
  CadPart part = extrude(loops, caps, height_mm);
  const uint32_t below = static_cast<uint32_t>(part.vertices_mm.size());
  part.vertices_mm.push_back({0, 0, 0});
  part.vertices_mm.push_back({0, 0, part.vertices_mm[pieces].z});
  for (uint32_t k = 0; k < pieces; ++k) {
    const uint32_t next = (k + 1) % pieces;
    part.faces.push_back({below, next, k});
    part.faces.push_back({below + 1, pieces + k, pieces + next});
  }
  return part;
}

// A shaft with steps, grooves and fillets; hollow, or with fans at its ends.
CadPart make_turned(Random& random) {
  struct Ring {
    double radius_mm, along_mm;
  };
  const uint32_t steps = 3 + random.below(6), around = 32 + 8 * random.below(13);
  const double bore_mm = random.below(2) == 0 ? 0 : random.between(1.5, 4);
  std::vector<Ring> rings;
  double along_mm = 0;
  for (uint32_t k = 0; k < steps; ++k) {
    const double radius_mm = random.between(6, 30), chamfer_mm = random.between(0.3, 1);
    const double length_mm = random.between(4, 40);
    rings.push_back({radius_mm - chamfer_mm, along_mm});
    rings.push_back({radius_mm, along_mm + chamfer_mm});
    rings.push_back({radius_mm, along_mm + length_mm - chamfer_mm});
    const uint32_t pieces = random.below(2) == 0 ? 1 : 5;
    for (uint32_t i = 1; i <= pieces; ++i) {
      const double turns = 0.25 * i / pieces;
      rings.push_back({radius_mm - chamfer_mm * (1 - cosine_of_turns(turns)),
                       along_mm + length_mm - chamfer_mm * (1 - sine_of_turns(turns))});
    }
    along_mm += length_mm;
    if (k + 1 < steps) along_mm += 0.05;  // a relief between the steps
  }
  if (bore_mm > 0) {
    rings.push_back({bore_mm, along_mm});
    rings.push_back({bore_mm, 0});
  }
  CadPart part;
  const auto add = [&](double radius_mm, double turns, double at_mm) {
    const DrawingPoint p =
        drawn(radius_mm * cosine_of_turns(turns), radius_mm * sine_of_turns(turns));
    part.vertices_mm.push_back({static_cast<double>(p.x) / 1000, static_cast<double>(p.y) / 1000,
                                static_cast<double>(micrometres(at_mm)) / 1000});
  };
  for (const Ring& ring : rings)
    for (uint32_t k = 0; k < around; ++k)
      add(ring.radius_mm, static_cast<double>(k) / around, ring.along_mm);
  const uint32_t count = static_cast<uint32_t>(rings.size());
  for (uint32_t r = 0; r + (bore_mm > 0 ? 0 : 1) < count; ++r)
    for (uint32_t k = 0; k < around; ++k) {
      const uint32_t next = (k + 1) % around, a = r * around, b = (r + 1) % count * around;
      part.faces.push_back({a + k, a + next, b + next});
      part.faces.push_back({a + k, b + next, b + k});
    }
  if (bore_mm > 0) return part;
  const uint32_t low = count * around;
  add(0, 0, 0);
  add(0, 0, along_mm);
  for (uint32_t k = 0; k < around; ++k) {
    const uint32_t next = (k + 1) % around;
    part.faces.push_back({low, next, k});
    part.faces.push_back({low + 1, (count - 1) * around + k, (count - 1) * around + next});
  }
  return part;
}

// By three angles, about x, y and z in turn.
void turn_askew(CadPart& part, Random& random) {
  double cosine[3], sine[3];
  for (size_t k = 0; k < 3; ++k) {
    const double turns = random.uniform();
    cosine[k] = cosine_of_turns(turns);
    sine[k] = sine_of_turns(turns);
  }
  for (Point& v : part.vertices_mm) {
    v = {v.x, v.y * cosine[0] - v.z * sine[0], v.y * sine[0] + v.z * cosine[0]};
    v = {v.x * cosine[1] + v.z * sine[1], v.y, v.z * cosine[1] - v.x * sine[1]};
    v = {v.x * cosine[2] - v.y * sine[2], v.x * sine[2] + v.y * cosine[2], v.z};
    for (double* x : {&v.x, &v.y, &v.z}) *x = std::floor(*x * 1e6 + 0.5) / 1e6;
  }
  part.decimals = 6;
}

// In the order of CadKind.
constexpr CadPart (*kMake[])(Random&) = {make_plate, make_turned, make_gear, make_sheet,
                                         make_extrusion};
static_assert(std::size(kMake) == kCadKinds);

}  // namespace

CadPart make_cad(uint64_t seed) {
  Random random(seed ^ 0x636164ull);
  CadPart part = kMake[seed % kCadKinds](random);
  if (seed / kCadKinds % 2 == 1) turn_askew(part, random);
  return part;
}

Surface to_surface(const CadPart& part) {
  Surface surface;
  for (const Point& v : part.vertices_mm) surface.vertices.push_back(to_vec3(v * 1e-3));
  surface.faces = part.faces;
  return surface;
}

std::string to_obj(const CadPart& part) {
  std::string text = "# millimetres\n";
  for (const Point& v : part.vertices_mm) {
    text += 'v';
    for (const double x : {v.x, v.y, v.z}) {
      char digits[40];
      const std::to_chars_result end =
          std::to_chars(digits, digits + sizeof digits, x, std::chars_format::fixed, part.decimals);
      text += ' ';
      text.append(digits, end.ptr);
    }
    text += '\n';
  }
  for (const Face& f : part.faces)
    text += "f " + std::to_string(f[0] + 1) + " " + std::to_string(f[1] + 1) + " " +
            std::to_string(f[2] + 1) + "\n";
  return text;
}

}  // namespace firmtouch::tools
