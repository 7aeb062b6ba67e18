#pragma once
#include <stddef.h>
#include <stdint.h>

// How a curve lies in an asset, byte for byte (tools/FORMAT.md says it in words). The baker writes
// these structs, the firmware reads them in place: 24 bytes a sample.

namespace firmtouch::curve {

// Section types of one curve; all share its name.
constexpr uint32_t kHeadSection = 0x2001;
constexpr uint32_t kSamplesSection = 0x2002;  // Sample[sample_count], in the order of the curve
constexpr uint32_t kArcsSection = 0x2003;     // float[sample_count]: fraction of the length, 0 to 1
constexpr uint32_t kNodesSection = 0x2004;    // Node[sample_count], an implicit balanced k-d tree
constexpr uint32_t kRowsSection = 0x2005;     // uint32_t[sample_count]: row in the file; for tools
constexpr uint32_t kProbesSection = 0x2006;   // query::ProbeHead and its points

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
  uint32_t reserved[2];  // 0
};
static_assert(sizeof(Head) == 48 && alignof(Head) == 4);
static_assert(offsetof(Head, low_m) == 8 && offsetof(Head, length_m) == 36);

struct Sample {
  float x_m, y_m, z_m;
};
static_assert(sizeof(Sample) == 12);

/// One sample of the tree. The children of node i are nodes 2 i + 1 and 2 i + 2; levels are filled
/// from the left, so that no node says where its children are. Below the first lie the samples that
/// come before this one by (coordinate on the node's axis, index), below the second those after.
struct Node {
  uint32_t place;  // sample | axis << 30
  float reach_m;   // longest half segment at any sample of the subtree, rounded up
};
static_assert(sizeof(Node) == 8);

constexpr uint32_t kSampleMask = 0x3FFFFFFFu;
constexpr uint32_t sample_of(uint32_t place) { return place & kSampleMask; }
constexpr uint32_t axis_of(uint32_t place) { return place >> 30; }
constexpr uint32_t make_place(uint32_t sample, uint32_t axis) { return sample | (axis << 30); }
constexpr uint32_t first_child(uint32_t node) { return 2 * node + 1; }
constexpr uint32_t parent_of(uint32_t node) { return (node - 1) / 2; }

}  // namespace firmtouch::curve
