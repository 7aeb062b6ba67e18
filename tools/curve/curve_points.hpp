#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "firmtouch/math/vec3.hpp"

namespace firmtouch::tools {

/// A curve in memory: what a reader gives and the baker takes. Float32 metres, in the order of the
/// file.
struct CurvePoints {
  std::vector<math::Vec3> samples_m;
  std::vector<uint32_t> rows;      // of each sample: its row in the file from 0, the header apart
  std::vector<uint32_t> lines;     // the same as lines of a text; empty: it is none
  bool is_smooth = false;          // cubic pieces between the samples rather than straight ones
  bool with_tree = false;          // bake the k-d tree, which nearest_constraint() reads
  uint32_t run_levels = 0;         // how often a run is halved; 0: as the baker chooses
  std::vector<std::string> notes;  // what was mended or passed over, for the report
  std::string problem;             // empty: usable; else file, line, what is wrong, how to mend it
};

/// Closes a ring whose last sample is the first within the rounding of its coordinates (2^-23 of
/// the largest one). Drops samples that repeat the one before them and refuses what cannot be a
/// guide: fewer than two different samples, a curve too small or too far for float32. `name` stands
/// in the messages.
void mend_curve(CurvePoints& points, const std::string& name);

}  // namespace firmtouch::tools
