#pragma once
#include <stddef.h>
#include <stdint.h>

// How a curve lies in an asset, byte for byte (tools/FORMAT.md says it in words). The baker writes
// these structs, the firmware reads them in place: 21 bytes a sample of a fine curve.

namespace firmtouch::curve {

// Section types of one curve; all share its name. 0x2004 and 0x2009 belonged to earlier layouts.
constexpr uint32_t kHeadSection = 0x2001;
constexpr uint32_t kSamplesSection = 0x2002;  // Sample[sample_count], in the order of the curve
constexpr uint32_t kArcsSection = 0x2003;     // float[sample_count]: fraction of the length, 0 to 1
constexpr uint32_t kRowsSection = 0x2005;     // uint32_t[sample_count]: row in the file; for tools
constexpr uint32_t kProbesSection = 0x2006;   // query::ProbeHead and its points
constexpr uint32_t kPlacesSection = 0x2007;   // uint32_t[sample_count], an implicit k-d tree
constexpr uint32_t kBoxesSection = 0x2008;    // Box[2 * run_count - 1], an implicit tree of runs
constexpr uint32_t kRunsSection = 0x200A;     // Run[run_count], in the order of the curve
constexpr uint32_t kRadiiSection = 0x200B;    // uint16_t[run_count][parts of a run + 1]

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
// levels are filled from the left, so that no node says where its children are. Node i is a word,
// sample | axis << 30: below the first child lie the samples that come before this one by
// (coordinate on the node's axis, index), below the second those after.
constexpr uint32_t kSampleMask = 0x3FFFFFFFu;
constexpr uint32_t sample_of(uint32_t place) { return place & kSampleMask; }
constexpr uint32_t axis_of(uint32_t place) { return place >> 30; }
constexpr uint32_t make_place(uint32_t sample, uint32_t axis) { return sample | (axis << 30); }
constexpr uint32_t first_child(uint32_t node) { return 2 * node + 1; }
constexpr uint32_t parent_of(uint32_t node) { return (node - 1) / 2; }

// Runs of consecutive segments, for everything exact: run r holds the segments from r * run_segments
// on, the last run what is left. A run is halved again and again down to parts of kPartSegments; each
// part lies within a stored radius of the straight line between its ends: near a curve of fine samples
// that is far tighter than any box. Where samples are few a box is cheaper.
constexpr uint32_t kPartSegments = 4;
constexpr uint32_t kMinRunLevels = 2, kMaxRunLevels = 8;
constexpr uint32_t run_segments_of(uint32_t levels) { return kPartSegments << levels; }
constexpr uint32_t parts_of(uint32_t levels) { return (2u << levels) - 1; }
constexpr uint32_t run_of(uint32_t segment, uint32_t levels) { return segment >> (levels + 2); }
constexpr uint32_t run_count_of(uint32_t sample_count, uint32_t levels) {
  return (sample_count - 2 + run_segments_of(levels)) >> (levels + 2);
}

// Boxes lie on a grid of 15-bit coordinates, so that two of them fit a word and squares of
// differences fit 32 bits.
constexpr uint32_t kGridMax = 32767;

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

// Radii of part k of run r: entry r * (parts + 1) + k, the upper half of a float32 in metres, rounded
// up; 0 for a part that is empty, and for the last entry of each run. Parts 2 k + 1 and 2 k + 2 are the
// halves of part k.

}  // namespace firmtouch::curve
