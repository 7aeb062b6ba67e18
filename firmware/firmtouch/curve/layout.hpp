#pragma once
#include <stddef.h>
#include <stdint.h>

#include "firmtouch/query/box_grid.hpp"

// How a curve lies in an asset, byte for byte (tools/FORMAT.md says it in words). The baker writes
// these structs, the firmware reads them in place: 17 bytes a sample of a fine curve.

namespace firmtouch::curve {

// Section types of one curve; all share its name. 0x2004 and 0x2009 belonged to earlier layouts.
constexpr uint32_t kHeadSection = 0x2001;
constexpr uint32_t kSamplesSection = 0x2002;  // Sample[sample_count], in the order of the curve
constexpr uint32_t kArcsSection = 0x2003;     // float[sample_count]: fraction of the length, 0 to 1
constexpr uint32_t kRowsSection = 0x2005;     // uint32_t[sample_count]: row in the file; for tools
constexpr uint32_t kProbesSection = 0x2006;   // query::ProbeHead and its points
// uint32_t[sample_count], an implicit k-d tree; optional, only nearest_constraint() reads it.
constexpr uint32_t kTreeSection = 0x2007;
constexpr uint32_t kBoxesSection = 0x2008;  // Box[2 * run_count - 1], an implicit tree of runs
constexpr uint32_t kRunsSection = 0x200A;   // Run[run_count], in the order of the curve
constexpr uint32_t kRadiiSection = 0x200B;  // uint16_t[run_count][parts of a run + 1]

// A balanced tree of kMaxSamples has this many levels; a search keeps one entry a level.
constexpr uint32_t kMaxLevels = 22;
constexpr uint32_t kMaxSamples = (1u << kMaxLevels) - 1;

// Squares of all differences stay finite and normal in float32 between these limits.
constexpr float kMaxCoordinate_m = 1e9f;    // in size, each of x, y, z
constexpr float kMinSpacing_m = 0x1p-40f;   // 1e-12 m between consecutive samples
constexpr float kMinDiagonal_m = 0x1p-20f;  // 1e-6 m: a curve smaller than that has a wrong unit

struct Head {
  uint32_t sample_count;
  uint32_t is_closed;  // 1: the last sample is the first one again
  float low_m[3];      // bounding box of the samples, exact
  float high_m[3];
  float diagonal_m;      // of that box, rounded down
  float length_m;        // along the curve
  float longest_half_m;  // half of the longest segment, rounded up
  float cell_m;          // of the grid, a power of two
  float grid_low_m[3];   // coordinate 0 of the grid
  uint32_t is_smooth;    // 1: cubic pieces between the samples, 0: straight ones
  uint32_t run_levels;   // halvings of a run down to its smallest parts
};
static_assert(sizeof(Head) == 68 && alignof(Head) == 4);
static_assert(offsetof(Head, low_m) == 8 && offsetof(Head, grid_low_m) == 48);

struct Sample {
  float x_m, y_m, z_m;
};
static_assert(sizeof(Sample) == 12);

// The k-d tree of samples, for the N nearest. The children of node i are nodes 2 i + 1 and 2 i + 2;
// levels are filled from the left, so that no node stores where its children are. Node i is a word,
// sample | axis << 30. Below the first child lie the samples that precede this one by (coordinate
// on the node's axis, index), below the second those that follow.
constexpr uint32_t kSampleMask = 0x3FFFFFFFu;
constexpr uint32_t sample_of(uint32_t node) { return node & kSampleMask; }
constexpr uint32_t axis_of(uint32_t node) { return node >> 30; }
constexpr uint32_t make_node(uint32_t sample, uint32_t axis) { return sample | (axis << 30); }
constexpr uint32_t first_child(uint32_t node) { return 2 * node + 1; }
constexpr uint32_t parent_of(uint32_t node) { return (node - 1) / 2; }

// Runs of consecutive segments, for everything exact: run r holds the segments from r *
// run_segments on, the last run what is left. A run is halved again and again down to parts of
// kPartSegments; each part lies within a stored radius of the straight line between its ends: near
// a curve of fine samples that is far tighter than any box. Where samples are few a box is cheaper.
constexpr uint32_t kPartSegments = 4;
constexpr uint32_t kMinRunLevels = 2, kMaxRunLevels = 8;
constexpr uint32_t run_segments_of(uint32_t levels) { return kPartSegments << levels; }
constexpr uint32_t parts_of(uint32_t levels) { return (2u << levels) - 1; }
constexpr uint32_t run_of(uint32_t segment, uint32_t levels) { return segment >> (levels + 2); }
constexpr uint32_t run_count_of(uint32_t sample_count, uint32_t levels) {
  return (sample_count - 2 + run_segments_of(levels)) >> (levels + 2);
}

using query::kGridMax;  // boxes lie on a grid of 15-bit coordinates

/// Box i of the tree of runs: node i for i < run_count - 1, else leaf i - (run_count - 1). Children
/// as above, so the sibling of box i is box i + 1 (i odd) or i - 1.
struct Box {
  uint32_t side[3];  // by axis: low | (kGridMax - high) << 16
};
static_assert(sizeof(Box) == 12);

/// Run i, and leaf i.
struct Run {
  uint32_t leaf;  // of run i
  uint32_t run;   // of leaf i
};
static_assert(sizeof(Run) == 8);

// Radii of part k of run r: entry r * (parts + 1) + k, the upper half of a float32 in metres,
// rounded up; 0 for a part that is empty, and for the last entry of each run. Parts 2 k + 1 and 2 k
// + 2 are the halves of part k.

/// Why opening rejects; the numbers never change. tools/FORMAT.md prints the same text.
enum Rule : uint16_t {
  // The head is absent or not 68 bytes long.
  kRuleHeadSize = 201,
  // There are fewer than 2 samples or more than 2^22 - 1.
  kRuleSampleCount = 202,
  // is_smooth is neither 0 nor 1.
  kRuleSmoothFlag = 203,
  // is_closed is neither 0 nor 1.
  kRuleClosedFlag = 204,
  // The sample section does not hold sample_count samples.
  kRuleSamplesSize = 205,
  // The arc section does not hold sample_count values.
  kRuleArcsSize = 206,
  // There is a k-d tree, and it does not hold sample_count nodes.
  kRuleTreeSize = 207,
  // The head's box is inverted or reaches beyond 1e9 m.
  kRuleHeadBox = 208,
  // The diagonal is not that of the box, to the bit, or is below 2^-20 m.
  kRuleDiagonal = 209,
  // The length is below half the diagonal or above 2^60 m.
  kRuleLength = 210,
  // A sample is NaN or lies outside the head's box.
  kRuleSampleOutside = 211,
  // The head's box has a side that no sample touches.
  kRuleLooseBox = 212,
  // The ends meet although is_closed is 0, or do not meet although it is 1.
  kRuleClosure = 213,
  // An arc position is outside 0 to 1, or is not 0 at the first sample or not 1 at the last.
  kRuleArcRange = 214,
  // A sample is less than 2^-40 m from the previous one.
  kRuleSpacing = 215,
  // An arc position is less than the previous one.
  kRuleArcOrder = 216,
  // An arc position differs by more than a millionth of the length from the one computed from the
  // samples.
  kRuleArcValue = 217,
  // A node of the k-d tree names no sample or no axis.
  kRuleTreeNode = 218,
  // A sample is on the wrong side of the plane of an ancestor in the k-d tree.
  kRuleTreeOrder = 219,
  // The box, run or radius section does not hold as many entries as sample_count and run_levels
  // require.
  kRuleRunsSize = 221,
  // The grid does not meet the conditions of its bounds: the cell is no power of two from 2^-60
  // to 2^60 (0); the grid spans more than 4 extents (1); it leaves less than 0.124 extents free
  // about the box, or more than one below it (2 to 4).
  kRuleGrid = 222,
  // longest_half_m is not, to the bit, that of the samples.
  kRuleLongestHalf = 223,
  // A box is inverted or off the grid.
  kRuleBoxRange = 224,
  // A box is not inside its parent's.
  kRuleBoxNesting = 225,
  // Runs and leaves do not correspond one to one.
  kRuleRunOrder = 226,
  // A sample or a cubic piece is not inside the box of its run.
  kRuleRunBox = 227,
  // A radius is not, to the bit, the derived one.
  kRuleRadius = 228,
  // The last radius of a run is not 0.
  kRuleRadiusPadding = 229,
  // The boxes of a smooth curve leave less than 0.12 of the extent free at an end of the grid.
  kRuleSmoothMargin = 230,
  // run_levels is below 2 or above 8.
  kRuleRunLevels = 231,
};

}  // namespace firmtouch::curve
