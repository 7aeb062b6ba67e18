#include "cli/loaded_asset.hpp"

#include "bake/asset/asset_views.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/core/bytes.hpp"
#include "firmtouch/curve/loader.hpp"
#include "firmtouch/hull/loader.hpp"
#include "firmtouch/mesh/loader.hpp"
#include "firmtouch/spline/loader.hpp"

namespace firmtouch::cli {
namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

}  // namespace

LoadedAsset::LoadedAsset(const std::string& path) : path_(path), bytes_(read_file(path)) {
  const core::Verdict verdict =
      asset::open({bytes_.data(), static_cast<uint32_t>(bytes_.size())}, container_);
  if (!verdict.ok()) fail_unsound(tools::rule_text(verdict));
}

void LoadedAsset::fail_unsound(const std::string& what) const {
  fail_input(path_ + ": not a sound asset: " + what +
             " (tools/FORMAT.md); bake it again with firmtouch bake");
}

void LoadedAsset::fail_absent(const std::string& kind, const std::string& name) const {
  fail_input(path_ + ": holds no " + kind + " '" + name +
             "'; meshes: " + joined(tools::names_with(container_, mesh::kHeadSection)) +
             "; curves: " + joined(tools::names_with(container_, curve::kHeadSection)) +
             "; splines: " + joined(tools::names_with(container_, spline::kHeadSection)));
}

LoadedMesh LoadedAsset::mesh(const std::string& name) const {
  const char* key = name.c_str();
  if (container_.find(mesh::kHeadSection, key).empty()) fail_absent("mesh", name);
  if (!tools::has_tree(container_, key)) {
    fail_input(
        path_ + ": '" + name +
        "' was baked with --no-tree: only its hull can be queried; bake it without for more");
  }
  LoadedMesh loaded;
  mesh::View view;
  const core::Verdict verdict = asset::open_geometry(container_, key, view);
  if (!verdict.ok()) fail_unsound("mesh '" + name + "': " + tools::rule_text(verdict));
  loaded.wide = simd::WideMesh(view);
  loaded.source = core::as_whole_array<uint32_t>(container_.find(mesh::kSourceSection, key));
  return loaded;
}

LoadedHull LoadedAsset::hull(const std::string& name) const {
  const char* key = name.c_str();
  if (container_.find(mesh::kHeadSection, key).empty()) fail_absent("mesh", name);
  if (container_.find(hull::kHeadSection, key).empty()) {
    fail_input(path_ + ": mesh '" + name +
               "' has no hull; bake it with --hull-faces N, or query segment");
  }
  LoadedHull loaded;
  const core::Verdict verdict = asset::open_geometry(container_, key, loaded.view);
  if (!verdict.ok()) fail_unsound("hull '" + name + "': " + tools::rule_text(verdict));
  loaded.source = core::as_whole_array<uint32_t>(container_.find(mesh::kSourceSection, key));
  return loaded;
}

LoadedCurve LoadedAsset::curve(const std::string& name) const {
  const char* key = name.c_str();
  if (container_.find(curve::kHeadSection, key).empty()) fail_absent("curve", name);
  LoadedCurve loaded;
  loaded.sections = asset::find_sections<curve::Sections>(container_, key);
  const core::Verdict verdict = curve::open(loaded.sections, loaded.view);
  if (!verdict.ok()) fail_unsound("curve '" + name + "': " + tools::rule_text(verdict));
  loaded.rows = core::as_whole_array<uint32_t>(container_.find(curve::kRowsSection, key));
  return loaded;
}

spline::View LoadedAsset::spline(const std::string& name) const {
  const char* key = name.c_str();
  if (container_.find(spline::kHeadSection, key).empty()) fail_absent("spline", name);
  spline::View view;
  const core::Verdict verdict = asset::open_geometry(container_, key, view);
  if (!verdict.ok()) fail_unsound("spline '" + name + "': " + tools::rule_text(verdict));
  return view;
}

}  // namespace firmtouch::cli
