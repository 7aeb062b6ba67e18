#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// A machined part as a CAD system exports it: flat faces of long thin triangles, millimetres with
/// few decimals.
struct CadPart {
  std::vector<Point> vertices_mm;  // rounded to the decimals
  std::vector<Face> faces;         // outward
  int decimals = 3;
};

/// The kinds of parts; `seed` modulo their number chooses one.
enum class CadKind : uint32_t { kPlate, kTurned, kGear, kSheet, kExtrusion };
constexpr uint32_t kCadKinds = 5;

/// The part of this seed: closed, manifold, outward. Every second round of kinds is turned askew
/// and has six decimals. The same bytes on every machine.
CadPart make_cad(uint64_t seed);

/// In float32 metres.
Surface to_surface(const CadPart& part);

/// The text of an OBJ file in millimetres, with as many decimals as the part has.
std::string to_obj(const CadPart& part);

}  // namespace firmtouch::tools
