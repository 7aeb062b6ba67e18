#include "surface/make/part_shape.hpp"

#include "surface/make/make_part.hpp"
#include "surface/random.hpp"
#include "surface/turns.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kBoreRadius_m = 0.008, kCollarRadius_m = 0.0155, kCollarHeight_m = 0.026;
constexpr double kChamfer_m = 0.001, kFilletRadius_m = 0.005, kRimRadius_m = 0.003;
constexpr double kMeanRim_m = 0.0470, kMeanGroove_m = 0.0322, kMeanFace_m = 0.0125,
                 kDome_m = 0.0025;

SectionPoint between(SectionPoint a, SectionPoint b, double along) {
  return {a.radius_m + (b.radius_m - a.radius_m) * along,
          a.height_m + (b.height_m - a.height_m) * along};
}

}  // namespace

// The ranges keep the groove (24 to 41 mm from the axis) clear of fillet (20.5 mm) and rim (42 mm).
PartShape::PartShape(uint64_t seed) {
  Random random(seed ^ 0x6B6E6F62ull);
  rim_lobes_ = 7 + random.below(4);
  groove_lobes_ = 3 + random.below(3);
  wave_lobes_ = 2 + random.below(2);
  rim_lobe_m_ = random.between(0.0012, 0.0018);
  groove_lobe_m_ = random.between(0.0030, 0.0045);
  wave_m_ = random.between(0.0018, 0.0028);
  groove_phase_ = random.uniform();
  wave_phase_ = random.uniform();
}

double PartShape::rim_radius_m(double turns) const {
  return kMeanRim_m + rim_lobe_m_ * cosine_of_turns(rim_lobes_ * turns);
}

double PartShape::groove_radius_m(double turns) const {
  return kMeanGroove_m + groove_lobe_m_ * cosine_of_turns(groove_lobes_ * turns + groove_phase_);
}

// A shallow dome, and waves that grow from nothing at the collar to their full height at the rim.
double PartShape::face_height_m(double radius_m, double turns) const {
  const double share = (radius_m - kCollarRadius_m) / (kMeanRim_m - kCollarRadius_m);
  const double x = share < 0 ? 0 : share > 1 ? 1 : share;
  const double grown = x * x * (3 - 2 * x);
  return kMeanFace_m + kDome_m * (1 - x * x) +
         wave_m_ * grown * cosine_of_turns(wave_lobes_ * turns + wave_phase_);
}

SectionPoint PartShape::groove_floor(double turns) const {
  const double radius_m = groove_radius_m(turns);
  return {radius_m, face_height_m(radius_m, turns) - kGrooveDepth_m};
}

// Where piece `index` begins.
SectionPoint PartShape::corner(uint32_t index, double turns) const {
  const double groove_m = groove_radius_m(turns), rim_m = rim_radius_m(turns);
  const auto on_face = [&](double radius_m) {
    return SectionPoint{radius_m, face_height_m(radius_m, turns)};
  };
  switch (index % kPieces) {
    case kBore:
      return {kBoreRadius_m, kChamfer_m};
    case kBoreChamfer:
      return {kBoreRadius_m, kCollarHeight_m - kChamfer_m};
    case kCollarTop:
      return {kBoreRadius_m + kChamfer_m, kCollarHeight_m};
    case kCollarChamfer:
      return {kCollarRadius_m - kChamfer_m, kCollarHeight_m};
    case kCollarWall:
      return {kCollarRadius_m, kCollarHeight_m - kChamfer_m};
    case kFillet:
      return {kCollarRadius_m,
              face_height_m(kCollarRadius_m + kFilletRadius_m, turns) + kFilletRadius_m};
    case kInnerFace:
      return on_face(kCollarRadius_m + kFilletRadius_m);
    case kGroove:
      return on_face(groove_m - kGrooveHalfWidth_m);
    case kOuterFace:
      return on_face(groove_m + kGrooveHalfWidth_m);
    case kRim:
      return on_face(rim_m - kRimRadius_m);
    case kWall:
      return {rim_m, face_height_m(rim_m - kRimRadius_m, turns) - kRimRadius_m};
    case kFootChamfer:
      return {rim_m, kChamfer_m};
    case kFoot:
      return {rim_m - kChamfer_m, 0};
    default:
      return {kBoreRadius_m + kChamfer_m, 0};
  }
}

SectionPoint PartShape::at(Piece piece, double along, double turns) const {
  const SectionPoint start = corner(piece, turns);
  if (!(along > 0)) return start;
  const SectionPoint end = corner(piece + 1u, turns);
  if (piece == kFillet) {  // a quarter circle about a centre above the face
    return {end.radius_m - kFilletRadius_m * cosine_of_turns(along / 4),
            start.height_m - kFilletRadius_m * sine_of_turns(along / 4)};
  }
  if (piece == kRim) {
    return {start.radius_m + kRimRadius_m * sine_of_turns(along / 4),
            end.height_m + kRimRadius_m * cosine_of_turns(along / 4)};
  }
  SectionPoint point = between(start, end, along);
  if (piece == kGroove) {  // half an ellipse hung from the face
    point.radius_m = groove_radius_m(turns) - kGrooveHalfWidth_m * cosine_of_turns(along / 2);
    point.height_m =
        face_height_m(point.radius_m, turns) - kGrooveDepth_m * sine_of_turns(along / 2);
  }
  if (piece == kInnerFace || piece == kOuterFace)
    point.height_m = face_height_m(point.radius_m, turns);
  return point;
}

}  // namespace firmtouch::tools
