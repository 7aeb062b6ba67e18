#include "bake/asset/asset_views.hpp"

#include "bake/asset/probes.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/curve/loader.hpp"
#include "firmtouch/field/loader.hpp"
#include "firmtouch/hull/loader.hpp"
#include "firmtouch/hull/probes.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/loader.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/loader.hpp"

namespace firmtouch::tools {
namespace {

std::string prove_hull(const asset::Container& container, const std::string& name) {
  hull::View view;
  const core::Verdict verdict = hull::open(hull::find_sections(container, name.c_str()), view);
  if (!verdict.ok()) return "hull '" + name + "': " + rule_text(verdict);
  const core::Bytes probes = container.find(hull::kProbesSection, name.c_str());
  if (probes.empty() || probes_agree(view, probes)) return "";
  return "hull '" + name +
         "': its probe queries are answered otherwise here than where it was baked";
}

std::string prove_mesh(const asset::Container& container, const std::string& name) {
  if (!container.find(hull::kHeadSection, name.c_str()).empty()) {
    const std::string problem = prove_hull(container, name);
    if (!problem.empty() || !has_tree(container, name.c_str())) return problem;
  }
  mesh::View view;
  const core::Verdict verdict = mesh::open(mesh::find_sections(container, name.c_str()), view);
  if (!verdict.ok()) return "mesh '" + name + "': " + rule_text(verdict);
  field::View distance_field;
  const field::Sections sections = field::find_sections(container, name.c_str());
  const core::Verdict of_field =
      sections.head.empty() ? core::kPassed : field::open(sections, view, distance_field);
  if (!of_field.ok()) return "distance field '" + name + "': " + rule_text(of_field);
  const core::Bytes probes = container.find(mesh::kProbesSection, name.c_str());
  if (probes.empty() || probes_agree(view, probes)) return "";
  return "mesh '" + name +
         "': its probe queries are answered otherwise here than where it was baked";
}

std::string prove_curve(const asset::Container& container, const std::string& name) {
  curve::View view;
  const core::Verdict verdict = curve::open(curve::find_sections(container, name.c_str()), view);
  if (!verdict.ok()) return "curve '" + name + "': " + rule_text(verdict);
  const core::Bytes probes = container.find(curve::kProbesSection, name.c_str());
  if (probes.empty() || probes_agree(view, probes)) return "";
  return "curve '" + name +
         "': its probe queries are answered otherwise here than where it was baked";
}

std::string prove_spline(const asset::Container& container, const std::string& name) {
  spline::View view;
  const core::Verdict verdict = spline::open(spline::find_sections(container, name.c_str()), view);
  if (!verdict.ok()) return "spline '" + name + "': " + rule_text(verdict);
  if (!container.find(spline::kArcsSection, name.c_str()).empty()) {
    spline::GuideView guide;
    const core::Verdict of_guide =
        spline::open_guide(view, spline::find_guide_sections(container, name.c_str()), guide);
    if (!of_guide.ok()) return "guide along spline '" + name + "': " + rule_text(of_guide);
  }
  const core::Bytes probes = container.find(spline::kProbesSection, name.c_str());
  if (probes.empty() || probes_agree(view, probes)) return "";
  return "spline '" + name +
         "': its probe queries are answered otherwise here than where it was baked";
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
  for (const std::string& name : names_with(container, mesh::kHeadSection)) {
    const std::string problem = prove_mesh(container, name);
    if (!problem.empty()) return problem;
  }
  for (const std::string& name : names_with(container, curve::kHeadSection)) {
    const std::string problem = prove_curve(container, name);
    if (!problem.empty()) return problem;
  }
  for (const std::string& name : names_with(container, spline::kHeadSection)) {
    const std::string problem = prove_spline(container, name);
    if (!problem.empty()) return problem;
  }
  return "";
}

}  // namespace firmtouch::tools
