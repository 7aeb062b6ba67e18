#pragma once
#include <cstdint>

namespace firmtouch::tools {

/// A point of the half plane that turns about the axis.
struct SectionPoint {
  double radius_m;
  double height_m;
};

/// The knob's shape as a closed section that changes with the angle around the axis. What a seed
/// decides is here.
class PartShape {
 public:
  explicit PartShape(uint64_t seed);

  /// The pieces of the section in order: up the bore, over the collar, the face and the rim, back
  /// along the bottom.
  enum Piece : uint32_t {
    kBore,
    kBoreChamfer,
    kCollarTop,
    kCollarChamfer,
    kCollarWall,
    kFillet,
    kInnerFace,
    kGroove,
    kOuterFace,
    kRim,
    kWall,
    kFootChamfer,
    kFoot,
    kBoreFoot,
    kPieces
  };

  /// The point at fraction `along` (0 to 1) of a piece, at `turns` around the axis. Pieces meet
  /// exactly end to start.
  SectionPoint at(Piece piece, double along, double turns) const;

  /// The groove's centre line on its floor.
  SectionPoint groove_floor(double turns) const;

 private:
  double rim_radius_m(double turns) const;
  double groove_radius_m(double turns) const;
  double face_height_m(double radius_m, double turns) const;
  SectionPoint corner(uint32_t index, double turns) const;

  uint32_t rim_lobes_, groove_lobes_, wave_lobes_;
  double rim_lobe_m_, groove_lobe_m_, wave_m_;
  double groove_phase_, wave_phase_;
};

}  // namespace firmtouch::tools
