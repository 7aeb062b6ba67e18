#pragma once
#include <map>
#include <string>
#include <vector>

#include "bake/materials/materials_file.hpp"
#include "cli/arguments.hpp"
#include "surface/extent.hpp"
#include "surface/surface.hpp"

namespace firmtouch::cli {

/// A length that the user gives: metres, or a share of the model's diagonal.
struct Length {
  double value = 0;  // 0: not given
  bool is_share = false;
};

/// How the inputs become metres, and what is done to a mesh that cannot be touched as it is.
struct ModelOptions {
  tools::FileFrame frame;                            // without size and centre
  std::map<std::string, tools::FileFrame> frame_of;  // of the inputs with a unit of their own
  double size_m = 0;      // of the first model's largest side; 0: as it is
  bool centre = false;    // the middle of the first model's box to the origin
  tools::Point origin_m;  // of the asset, which stored coordinates count from
  bool is_signed = true;
  bool close_holes = false;
  bool mend = false;
  Length wrap;
  bool has_decimal_commas = false;  // in curves
  tools::Materials materials;       // of triangles; without a table they are not read
  std::string material_numbers;     // a file that says which; "": the model does

  tools::FileFrame frame_for(const std::string& path) const;
};

/// A command's own options with those that say the above behind the first.
std::vector<Option> with_model_options(std::vector<Option> own);
/// Of these. `text`: as they stand in the provenance, appended.
ModelOptions model_options(const Arguments& arguments, std::string& text);

/// "bone.stl:mm" as path and unit where no file has the whole name. The units go to `options`.
std::vector<std::string> inputs_with_units(const std::vector<std::string>& words,
                                           ModelOptions& options);

/// Settles --size and --centre by the box of `path`, which is read for that.
void settle_size(const std::string& path, ModelOptions& options);

using tools::Extent;

/// Of a model as its file's reader gives it; what is wrong with it is said when it is read again.
Extent extent_of(const std::string& path, const ModelOptions& options);

/// A model read, checked and mended.
struct SoundSurface {
  tools::Surface surface;
  std::vector<uint32_t> vertex_source;  // of each vertex: its index in the file
  std::vector<std::string> reported;    // a sentence for each thing mended or let through
};

/// Fails (bad input) with the file, the place, what is wrong, how often and how to mend it.
SoundSurface sound_surface(const std::string& path, std::vector<uint8_t> bytes,
                           const ModelOptions& options);

}  // namespace firmtouch::cli
