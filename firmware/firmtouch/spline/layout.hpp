#pragma once
#include <stddef.h>
#include <stdint.h>

// How spline curves or surfaces lie in an asset, byte for byte (tools/FORMAT.md says it in words).
// The baker writes these structs, the firmware reads them in place.

namespace firmtouch::spline {

// Section types of one spline model; all share its name.
constexpr uint32_t kHeadSection = 0x6001;
constexpr uint32_t kPiecesSection = 0x6002;        // Piece[piece_count]
constexpr uint32_t kCoefficientsSection = 0x6003;  // float[coefficient_count]
constexpr uint32_t kNodesSection = 0x6006;         // Box[piece_count - 1]: surfaces only
// Of curves: Point[point_count], and behind them float[point_count], their z, none if flat;
// Corner[point_count].
constexpr uint32_t kPointsSection = 0x6007;
constexpr uint32_t kProbesSection = 0x6008;  // query::ProbeHead and its points
constexpr uint32_t kBendsSection = 0x6009;   // CurveBend[piece_count]; PatchBend, one a cell
// Of a guide: how long it is, and which of its pieces follow each other.
constexpr uint32_t kArcsSection = 0x600A;    // float[parts * piece_count + 1]
constexpr uint32_t kChainsSection = 0x600B;  // Chain[1 or more]
constexpr uint32_t kGridsSection = 0x600C;   // Grid[piece_count]: surfaces only
// Bytes of a unit. Of curves uint8_t[2^levels - 1 + leaf_count], one a node; of surfaces
// uint8_t[3 * leaf_count - 2 * piece_count]: radii, overlaps.
constexpr uint32_t kRadiiSection = 0x600D;
constexpr uint32_t kLeavesSection = 0x600E;  // uint16_t[leaf_count], pieces: curves only

constexpr uint32_t kMaxDegree = 5;
constexpr uint32_t kMaxLeaves = 65535;      // indices are of 16 bits
constexpr uint32_t kMaxPatches = 32768;     // a surface's pieces
constexpr uint32_t kMaxLevels = 29;         // of a tree: 17 over leaves or pieces, 12 in a piece
constexpr uint32_t kMaxHalvings = 8;        // of a curve's piece, to a leaf
constexpr uint32_t kMaxHalvingsAcross = 6;  // of a surface's, on each axis

// Between these limits squares and fourth powers of all lengths stay finite and normal in float32.
constexpr float kMaxCoordinate_m = 1e6f;
constexpr float kMinExtent_m = 0x1p-20f;  // 1e-6 m: a model smaller than that has a wrong unit

struct Head {
  uint32_t is_surface;   // 1: surfaces, 0: curves
  uint32_t is_rational;  // 1: a piece of it is: then what `exact` promises is wider
  uint32_t piece_count;
  uint32_t leaf_count;
  uint32_t coefficient_count;
  uint32_t point_count;
  float low_m[3];  // box of all control points of all leaves
  float high_m[3];
  float extent_m;        // at most the longest side of the shape itself
  float loss_m;          // by how much the stored shape, and a point computed of it, may be off
  uint32_t worst_steps;  // seen by the baker's search: a default budget, never a bound
  float radius_unit_m;   // of a curve's nodes; of surfaces 0
};
static_assert(sizeof(Head) == 64 && offsetof(Head, low_m) == 24 && offsetof(Head, loss_m) == 52);

/// A polynomial or rational piece over s (and t) from -1 to 1: with the powers about 0, x(s) =
/// origin + sum of c[k] s^k; rational: origin + (sum of c[k] s^k) / (sum of w[k] s^k). A surface
/// has c[i, j] s^i t^j, the power of s fastest. Coefficients are x, y, z, and w where it is
/// rational.
struct Piece {
  uint32_t coefficients;       // index of the first float
  uint8_t degree_u, degree_v;  // degree_v: 0 for a curve
  uint8_t is_rational;
  uint8_t level_u : 4, level_v : 4;  // halvings to its leaves
  uint32_t entity;                   // of the file, in its order
  float origin_m[3];
  float middle_u, half_u;  // the entity's own parameter: middle + half s
  float middle_v, half_v;  // 0 for a curve
};
static_assert(sizeof(Piece) == 40 && offsetof(Piece, origin_m) == 12);

/// Leaves of curves are the parts of each piece in turn, from its first one on; between two pieces
/// that do not meet stands one that is none.
constexpr uint32_t kNoLeaf = 0xFFFF;  // in the place of a piece

/// On a curve's piece the fourth derivative of half the squared distance D^2 / 2, by its s, is
/// nowhere below -(fixed + turning D), where D is the distance to any point of the piece. As
/// computed there, the second derivative and two thirds of the third together are off by at most
/// noise + noise_turning D.
struct CurveBend {
  float fixed_m2, turning_m, noise_m2, noise_turning_m;
  uint32_t first_leaf;
};
static_assert(sizeof(CurveBend) == 20);

/// On a cell of a surface, which holds leaves, of the fourth derivatives of D^2 / 2 by the piece's
/// s and t, ssss, ssst, sstt, sttt and tttt, the second and fourth are at most fixed + turning D in
/// size, the others nowhere below -(fixed + turning D): as bytes of its Grid's units.
struct PatchBend {
  uint8_t fixed[5], turning[5];
};
static_assert(sizeof(PatchBend) == 10);

/// How a surface's piece is cut into 2^level_u x 2^level_v leaves, and what holds them. Corners of
/// leaves lie in rows, (2^level_u + 1) x (2^level_v + 1). A byte b of a unit is the float32 whose
/// bits are the unit's + b 2^20: eight steps to every doubling.
struct Grid {
  uint32_t first_corner;
  uint32_t
      first_leaf;  // its leaves follow in rows; its radii begin at 2 first_leaf - its own number
  uint32_t first_cell;  // its cells follow in rows
  uint32_t cell_level;  // a cell is so many halvings on each axis, or as many as there are
  float step_m;         // of its corners, from the piece's origin: a power of two
  float radius_unit_m, fixed_unit_m2, turning_unit_m;
};
static_assert(sizeof(Grid) == 32);

struct Corner {
  int16_t x, y, z;
};
static_assert(sizeof(Corner) == 6);

/// Leaf i of a curve lies about the straight line from point i to the next.
struct Point {
  float x_m, y_m;
};
static_assert(sizeof(Point) == 8);

/// The tree over a curve's leaves: node 1 is the root, the children of node i are 2 i and 2 i + 1,
/// and leaf i is node 2^levels + i. What would hold no leaf is no node; its byte is 0. The others'
/// leaves lie within the radius of the straight line from the first one's first point to the last
/// one's last.
struct CurveLevels {
  uint32_t levels = 0;
  uint32_t leaf_count = 0;

  explicit CurveLevels(uint32_t leaves)
      : levels(leaves > 1 ? 32u - static_cast<uint32_t>(__builtin_clz(leaves - 1)) : 0),
        leaf_count(leaves) {}
  uint32_t first_node() const { return 1u << levels; }  // of the leaves
  uint32_t node_count() const { return first_node() - 1 + leaf_count; }
  /// Of what is below a node: from the first leaf to before the end.
  struct Leaves {
    uint32_t first, end;
  };
  Leaves below(uint32_t node) const {
    const uint32_t above = levels_below(node);
    const uint32_t first = (node << above) - first_node(), end = first + (1u << above);
    return {first, end < leaf_count ? end : leaf_count};
  }
  uint32_t levels_below(uint32_t node) const {
    return levels + static_cast<uint32_t>(__builtin_clz(node)) - 31u;
  }
  /// How many leaves a full tree has below a node.
  uint32_t width_of(uint32_t node) const { return 1u << levels_below(node); }
};

/// Node i of the tree over a surface's pieces, of piece_count leaves: only the inner ones are
/// stored. The third axis is the product of the two; the axes are a little shorter than unit
/// vectors, so that no distance seen along them is longer than it is.
struct Box {
  float centre_m[3];
  float axis[2][3];
  float half_m[3];
};
static_assert(sizeof(Box) == 48);

constexpr uint32_t first_child(uint32_t node) { return 2 * node + 1; }
constexpr uint32_t parent_of(uint32_t node) { return (node - 1) / 2; }
constexpr uint32_t sibling_of(uint32_t node) { return (node & 1u) != 0 ? node + 1 : node - 1; }

/// Why opening rejects; the numbers never change. tools/FORMAT.md prints the same text.
enum Rule : uint16_t {
  // The head is absent or not 64 bytes long.
  kRuleHeadSize = 601,
  // A count of the head is out of range.
  kRuleCounts = 602,
  // A flag of the head is above 1.
  kRuleFlags = 603,
  // A section does not hold what the head says: pieces (0), coefficients (1), leaves (2), nodes
  // (4), points (5), bends (6), grids (7), radii (8).
  kRuleSectionSize = 604,
  // The box is inverted or extends beyond 1e6 m.
  kRuleHeadBox = 605,
  // The extent is below 2^-20 m or above the box's longest side.
  kRuleExtent = 606,
  // loss_m is below 0 or above 2 (rational: 5) times 2^-24 of the extent.
  kRuleLoss = 607,
  // worst_steps is 0.
  kRuleWorstSteps = 608,
  // radius_unit_m of curves is outside 2^-100 to 2^60, of surfaces not 0.
  kRuleRadiusUnit = 609,
  // A degree is out of range.
  kRuleDegree = 611,
  // A piece is rational and the head says that none is, or a level is above 8 (a curve's level_v:
  // above 0; a surface's: above 6).
  kRuleLevel = 612,
  // Coefficients do not follow those of the previous piece, leave the section, or belong to no
  // piece.
  kRuleCoefficients = 613,
  // A coefficient is beyond 6.4e7 or NaN.
  kRuleCoefficientRange = 614,
  // Leaves of a curve are not those of each piece in order, with at most one empty leaf between
  // two pieces, or belong to no piece.
  kRuleCurveLeaves = 615,
  // An origin is beyond 2e6 m or a parameter beyond 1e30, or one is NaN.
  kRulePieceRange = 616,
  // A point lies outside the head's box.
  kRulePointOutside = 617,
  // A centre or half side of a box is out of range, or its axes could lengthen a vector; of
  // curves: an absent node has a radius.
  kRuleNode = 618,
  // The weight may fall to half of its middle's on a leaf, a cell, or a sixteenth of a curve's
  // piece.
  kRuleWeight = 619,
  // A stored bend is below what the 8 x 8 parts of its cell, or the sixteen parts of its piece,
  // require, or above 2^90.
  kRuleBends = 620,
  // A point of the leaf may lose more than loss_m.
  kRuleLeafLoss = 621,
  // A leaf leaves the head's box.
  kRuleLeafOutside = 622,
  // A leaf leaves a node above it, or its half of a patch's quad.
  kRuleEnclosure = 623,
  // cell_level is above 6, or corners, leaves or cells of a grid do not follow those of the
  // previous piece, leave the section, or belong to no piece.
  kRuleGrid = 624,
  // A step is not a power of two or outside 2^-100 to 2^20, or a unit is outside 2^-100 to 2^60.
  kRuleGridUnit = 625,
  // A flat curve (points without z) has a coefficient of z that is not 0, or origins whose z
  // differ.
  kRuleFlat = 626,
  // The arcs are not `parts` times the pieces and one, or belong to surfaces.
  kRuleGuideArcsSize = 641,
  // There is no chain, a chain's first piece does not exist or does not rise from 0, or a flag is
  // above 1.
  kRuleGuideChains = 642,
  // An arc falls, is NaN or above 1e9, the first is not 0, or the last not above 0.
  kRuleGuideArcs = 643,
  // An arc differs from its length by three Gauss points by more than a sixteenth and 2^-18 of
  // extent and arc.
  kRuleGuideArcLength = 644,
  // A piece does not begin within 2^-19 of the extent of where the previous piece of its chain (of
  // a closed chain: the last) ends.
  kRuleGuideJoint = 645,
};

}  // namespace firmtouch::spline
