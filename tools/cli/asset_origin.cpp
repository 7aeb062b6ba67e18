#include "cli/asset_origin.hpp"

#include <optional>

#include "bake/asset/origin.hpp"
#include "bake/asset/provenance.hpp"
#include "cli/baked_input.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "cli/loaded_asset.hpp"
#include "firmtouch/curve/layout.hpp"
#include "firmtouch/mesh/layout.hpp"
#include "firmtouch/spline/layout.hpp"

namespace firmtouch::cli {
namespace {

bool has_geometry(const asset::Container& asset) {
  for (const uint32_t head : {mesh::kHeadSection, curve::kHeadSection, spline::kHeadSection})
    if (asset.next_of_type(head) != asset::kNoSection) return true;
  return false;
}

// Of the assets among the inputs, if any has a geometry.
std::optional<tools::Point> stored_origin(const std::vector<std::string>& inputs,
                                          bool has_turned_object) {
  std::optional<tools::Point> found;
  std::string first;
  for (const std::string& path : inputs) {
    if (extension_of(path) != ".fta") continue;
    const LoadedAsset asset(path);
    if (!has_geometry(asset.container())) continue;
    const tools::Point origin_m = tools::to_point(asset.container().origin_m());
    if (has_turned_object && tools::is_moved(origin_m))
      fail_input(path +
                 ": its coordinates count from an origin, and an object that is turned needs those "
                 "of the model: bake the model instead");
    if (found && tools::is_moved(origin_m - *found))
      fail_input(path + ": its coordinates count from another origin than those of " + first +
                 ": bake the models of both together");
    found = origin_m;
    first = path;
  }
  return found;
}

}  // namespace

tools::Point asset_origin(const std::vector<std::string>& inputs, bool has_turned_object,
                          const ModelOptions& options) {
  const std::optional<tools::Point> stored = stored_origin(inputs, has_turned_object);
  if (stored || has_turned_object) return stored.value_or(tools::Point{});
  Extent all;
  for (const std::string& path : inputs) {
    const std::string extension = extension_of(path);
    if (extension == ".objects" || extension == ".tool" || extension == ".fta") continue;
    const Extent one = extension == ".ftl" ? extent_of_run(path) : extent_of(path, options);
    all.add(one.low);
    all.add(one.high);
  }
  return tools::origin_for(all.low, all.high);
}

std::string origin_text(tools::Point origin_m) {
  return "far from 0: stored from the origin (" + tools::number_text(origin_m.x) + ", " +
         tools::number_text(origin_m.y) + ", " + tools::number_text(origin_m.z) +
         " m) of the asset; queries and the scene's place count in the model's coordinates";
}

}  // namespace firmtouch::cli
