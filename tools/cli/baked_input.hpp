#pragma once
#include <string>
#include <vector>

#include "bake/asset/section.hpp"
#include "cli/arguments.hpp"
#include "cli/model_input.hpp"
#include "cli/progress.hpp"
#include "curve/curve_points.hpp"
#include "hull/build_hull.hpp"

namespace firmtouch::cli {

/// What an asset is made for.
enum class Purpose {
  kFast,     // the least work a query on a controller
  kBounded,  // the least work of its worst query
  kSmall,    // the fewest bytes
  kDesktop   // the least time on a desktop's processor
};

struct BakeOptions {
  ModelOptions model;
  Purpose purpose = Purpose::kFast;
  uint32_t field_cells = 0;  // along the long axis; 0: no distance field
  uint32_t hull_faces = 0;   // 0: no hull
  bool has_tree = true;      // of the mesh; without it only a hull can be queried
  tools::HullOptions hull;
  bool keeps_triangles = false;  // else flat faces of long triangles are cut anew
  bool smooth = false;           // cubic pieces between a curve's samples
  bool curve_tree = false;       // also bake the k-d tree of a curve
  std::string teach;             // what a recorded run's guide is called
  double max_deviation_m = 0;    // of the guide from the run
  std::string text;              // as they stand in the provenance
  bool is_quiet = false;         // no progress bar: others bake at the same time
};

/// One input as sections of an asset, proven, with its probes and provenance, and what to report
/// about it.
struct BakedInput {
  std::vector<tools::Section> sections;
  std::vector<std::string> report;
};

/// Of the progress bar, where an input has 1.
constexpr double kShareOfHull = 2;

/// Each fails (bad input) with the file, the place, what is wrong, how often and how to mend it.
BakedInput bake_mesh_input(const std::string& path, const BakeOptions& options, Progress& progress);
BakedInput bake_curve_input(const std::string& path, const BakeOptions& options,
                            Progress& progress);
/// A recorded run, thinned to a guide named options.teach.
BakedInput bake_run_input(const std::string& path, const BakeOptions& options, Progress& progress);

/// Of its places, in the scene's coordinates.
Extent extent_of_run(const std::string& path);

/// What curve and run have in common, from the points on; `source` is the file's bytes.
BakedInput bake_points(const tools::CurvePoints& given, const std::string& path,
                       const std::string& name, const std::vector<uint8_t>& source,
                       const BakeOptions& options, Progress& progress);
BakedInput bake_spline_input(const std::string& path, const BakeOptions& options,
                             Progress& progress);

uint64_t bytes_of(const std::vector<tools::Section>& sections);
/// Where asset `name` comes from: file `path`, whose bytes are `source`, baked with `options`.
tools::Section provenance_of(const std::string& path, const std::string& name,
                             const std::vector<uint8_t>& source, const std::string& options = "");
/// A line of a report with two numbers.
std::string sentence(const char* format, double a, double b);

}  // namespace firmtouch::cli
