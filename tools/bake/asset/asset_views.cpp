#include "bake/asset/asset_views.hpp"

#include <utility>

#include "bake/asset/probes.hpp"
#include "device/device_file.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/controller/asset_loading.hpp"
#include "firmtouch/controller/mesh_objects.hpp"
#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/curve/loader.hpp"
#include "firmtouch/field/loader.hpp"
#include "firmtouch/hull/loader.hpp"
#include "firmtouch/hull/probes.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/loader.hpp"
#include "firmtouch/scene/stored_materials.hpp"
#include "firmtouch/scene/stored_tool.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/loader.hpp"

namespace firmtouch::tools {
namespace {

std::string broken(const std::string& what, const std::string& name, core::Verdict verdict) {
  return what + " '" + name + "': " + rule_text(verdict);
}

// Of a geometry that is not proven or not answered as where it was baked: what is wrong.
template <class View>
std::string prove(const char* what, const asset::Container& container, const std::string& name,
                  uint32_t probes_type, View& view) {
  const core::Verdict verdict = asset::open_geometry(container, name.c_str(), view);
  if (!verdict.ok()) return broken(what, name, verdict);
  const core::Bytes probes = container.find(probes_type, name.c_str());
  if (probes.empty() || probes_agree(view, probes)) return "";
  return std::string(what) + " '" + name +
         "': its probe queries are answered otherwise here than where it was baked";
}

std::string prove_materials(const asset::Container& container, const std::string& name,
                            const mesh::View& mesh) {
  const auto sections = asset::find_sections<scene::MaterialSections>(container, name.c_str());
  if (sections.table.empty()) return "";
  scene::StoredMaterials materials;
  const core::Verdict verdict = scene::open(sections, mesh, materials);
  return verdict.ok() ? "" : broken("materials", name, verdict);
}

std::string prove_mesh(const asset::Container& container, const std::string& name) {
  hull::View hull;
  std::string problem;
  if (!container.find(hull::kHeadSection, name.c_str()).empty()) {
    problem = prove("hull", container, name, hull::kProbesSection, hull);
    if (!problem.empty() || !has_tree(container, name.c_str())) return problem;
  }
  mesh::View mesh;
  problem = prove("mesh", container, name, mesh::kProbesSection, mesh);
  if (problem.empty()) problem = prove_materials(container, name, mesh);
  const auto sections = asset::find_sections<field::Sections>(container, name.c_str());
  if (!problem.empty() || sections.head.empty()) return problem;
  field::View distance_field;
  const core::Verdict verdict = field::open(sections, mesh, distance_field);
  return verdict.ok() ? "" : broken("distance field", name, verdict);
}

std::string prove_curve(const asset::Container& container, const std::string& name) {
  curve::View view;
  return prove("curve", container, name, curve::kProbesSection, view);
}

std::string prove_linkage(const asset::Container& container, const std::string& name) {
  const core::Verdict verdict = check_stored(container.find(device::kLinkageSection, name.c_str()));
  return verdict.ok() ? "" : broken("linkage", name, verdict);
}

std::string prove_objects(const asset::Container& container, const std::string& name) {
  MeshObjects objects;
  MeshObjects::State state;
  objects.begin<asset::Proven>(container, name.c_str(), state);
  asset::Progress progress;
  while (!progress.is_done) progress = objects.work<asset::Proven>(state, kSliceUnits);
  return progress.verdict.ok() ? "" : broken("objects", name, progress.verdict);
}

std::string prove_tool(const asset::Container& container, const std::string& name) {
  scene::StoredTool spheres;
  core::Verdict verdict = scene::open(container.find(scene::kToolSection, name.c_str()), spheres);
  if (verdict.ok() && !(names_with(container, scene::kObjectsSection).empty() &&
                        names_with(container, scene::kMaterialsSection).empty()))
    verdict = core::reject(scene::kRuleToolAlone);
  return verdict.ok() ? "" : broken("tool", name, verdict);
}

std::string prove_spline(const asset::Container& container, const std::string& name) {
  spline::View view;
  const std::string problem = prove("spline", container, name, spline::kProbesSection, view);
  const auto sections = asset::find_sections<spline::GuideSections>(container, name.c_str());
  if (!problem.empty() || sections.arcs.empty()) return problem;
  spline::GuideView guide;
  const core::Verdict verdict = spline::open_guide(view, sections, guide);
  return verdict.ok() ? "" : broken("guide along spline", name, verdict);
}

}  // namespace

bool has_tree(const asset::Container& container, const char* name) {
  return !container.find(mesh::kNodesSection, name).empty();
}

std::vector<std::string> names_with(const asset::Container& container, uint32_t type) {
  std::vector<std::string> names;
  for (uint32_t i = container.next_of_type(type); i != asset::kNoSection;
       i = container.next_of_type(type, i + 1)) {
    names.push_back(container.name(i));
  }
  return names;
}

std::string rule_text(core::Verdict verdict) {
  return "rule R" + std::to_string(verdict.rule) + " at element " + std::to_string(verdict.element);
}

std::string prove_asset(core::Bytes file) {
  asset::Container container;
  const core::Verdict verdict = asset::open(file, container);
  if (!verdict.ok()) return rule_text(verdict);
  const std::pair<uint32_t, decltype(&prove_mesh)> kinds[] = {
      {mesh::kHeadSection, prove_mesh},        {curve::kHeadSection, prove_curve},
      {spline::kHeadSection, prove_spline},    {device::kLinkageSection, prove_linkage},
      {scene::kObjectsSection, prove_objects}, {scene::kToolSection, prove_tool}};
  for (const auto& [type, prove_kind] : kinds)
    for (const std::string& name : names_with(container, type)) {
      const std::string problem = prove_kind(container, name);
      if (!problem.empty()) return problem;
    }
  return "";
}

}  // namespace firmtouch::tools
