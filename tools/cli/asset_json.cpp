#include "cli/asset_json.hpp"

#include <algorithm>
#include <cstdlib>

#include "bake/asset/asset_views.hpp"
#include "bake/asset/opening_cost.hpp"
#include "bake/asset/part_names.hpp"
#include "firmtouch/device/stable_wall.hpp"
#include "firmtouch/device/stored_linkage.hpp"
#include "firmtouch/field/layout.hpp"
#include "firmtouch/hull/layout.hpp"
#include "firmtouch/params/table.hpp"
#include "firmtouch/scene/materials_layout.hpp"
#include "firmtouch/scene/objects_layout.hpp"
#include "firmtouch/scene/tool_layout.hpp"
#include "json/json.hpp"
#include "surface/point.hpp"

namespace firmtouch::cli {
namespace {

using tools::Json;
using tools::json_list;
using tools::json_text;

struct SectionName {
  uint32_t type;
  const char* text;
};

constexpr SectionName kSectionNames[] = {{asset::kBoundsSection, "bounds"},
                                         {asset::kProvenanceSection, "provenance"},
                                         {asset::kOriginSection, "origin"},
                                         {mesh::kHeadSection, "mesh head"},
                                         {mesh::kVerticesSection, "mesh vertices"},
                                         {mesh::kTriangles16Section, "mesh triangles, 16 bit"},
                                         {mesh::kTriangles32Section, "mesh triangles, 32 bit"},
                                         {mesh::kNodesSection, "mesh nodes"},
                                         {mesh::kParentsSection, "mesh parents"},
                                         {mesh::kVertexNormalsSection, "mesh vertex normals"},
                                         {mesh::kEdgeFoldsSection, "mesh edge folds"},
                                         {mesh::kLeafBoxesSection, "mesh boxes of leaves"},
                                         {mesh::kBoxFrameSection, "mesh frame of boxes"},
                                         {mesh::kSourceSection, "mesh source triangles"},
                                         {mesh::kProbesSection, "mesh probes"},
                                         {field::kHeadSection, "distance field head"},
                                         {field::kDistancesSection, "distance field bounds"},
                                         {field::kSeedsSection, "distance field seeds"},
                                         {hull::kHeadSection, "hull head"},
                                         {hull::kVerticesSection, "hull vertices"},
                                         {hull::kOriginsSection, "hull origins of ids"},
                                         {hull::kRecordsSection, "hull stars"},
                                         {hull::kRecordOffsetsSection, "hull places of stars"},
                                         {hull::kStarBoxesSection, "hull boxes of stars"},
                                         {hull::kBoxesSection, "hull boxes over the triangles"},
                                         {hull::kBaseHullSection, "hull at its coarsest"},
                                         {hull::kProbesSection, "hull probes"},
                                         {device::kLinkageSection, "linkage"},
                                         {scene::kObjectsSection, "objects"},
                                         {scene::kMaterialsSection, "materials"},
                                         {scene::kTriangleMaterialsSection, "triangle materials"},
                                         {scene::kTexturesSection, "textures"},
                                         {scene::kReliefsSection, "height maps"},
                                         {scene::kReliefSamplesSection, "height samples"},
                                         {scene::kToolSection, "tool"},
                                         {curve::kHeadSection, "curve head"},
                                         {curve::kSamplesSection, "curve samples"},
                                         {curve::kArcsSection, "curve arcs"},
                                         {curve::kTreeSection, "curve k-d tree"},
                                         {curve::kBoxesSection, "curve boxes"},
                                         {curve::kRunsSection, "curve runs"},
                                         {curve::kRadiiSection, "curve radii"},
                                         {curve::kRowsSection, "curve source rows"},
                                         {curve::kProbesSection, "curve probes"},
                                         {spline::kHeadSection, "spline head"},
                                         {spline::kPiecesSection, "spline pieces"},
                                         {spline::kCoefficientsSection, "spline coefficients"},
                                         {spline::kLeavesSection, "spline leaves"},
                                         {spline::kBendsSection, "spline bends"},
                                         {spline::kNodesSection, "spline nodes"},
                                         {spline::kPointsSection, "spline points"},
                                         {spline::kGridsSection, "spline grids"},
                                         {spline::kRadiiSection, "spline radii"},
                                         {spline::kProbesSection, "spline probes"},
                                         {spline::kArcsSection, "spline arcs"},
                                         {spline::kChainsSection, "spline chains"}};

void add(const std::string& name, double value, tools::Facts& facts) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  facts.emplace_back(name, text);
}

void add_origin(math::Vec3 origin_m, tools::Facts& facts) {
  const tools::Point at_m = tools::to_point(origin_m);
  facts.emplace_back("x_m", tools::number_text(at_m.x));
  facts.emplace_back("y_m", tools::number_text(at_m.y));
  facts.emplace_back("z_m", tools::number_text(at_m.z));
}

constexpr uint32_t kRates_kHz[] = {1, 4, 10};

std::string at_rate(uint32_t rate_kHz) { return "_at_" + std::to_string(rate_kHz) + "_kHz"; }

// The stiffest walls that the controller enables; an asset without the tip's mass has no limit.
void add_stable_walls(core::Bytes section, tools::Facts& facts) {
  device::StoredLinkage linkage;
  constexpr uint32_t kAlone = sizeof(device::LinkageLayout);  // without homing and second encoders
  if (section.size() < kAlone || !device::open({section.data(), kAlone}, linkage).ok()) return;
  if (!(linkage.layout().least_mass_kg > 0.0f)) return;
  const float mass_kg = linkage.layout().least_mass_kg;
  const float damping_N_s_per_m = params::kTable[params::kContactDamping].initial;
  add("least_mass_kg", static_cast<double>(mass_kg), facts);
  add("wall_damping_N_s_per_m", static_cast<double>(damping_N_s_per_m), facts);
  for (const uint32_t rate_kHz : kRates_kHz)
    add("stiffest_wall_N_per_m" + at_rate(rate_kHz),
        static_cast<double>(device::stiffest_stable_N_per_m(mass_kg, damping_N_s_per_m,
                                                            1e-3f / static_cast<float>(rate_kHz))),
        facts);
}

// The stiffest walls without damping that give no passive hand energy: 2 b / T (Colgate and
// Schenkel 1994), where b is the least that the linkage has of its own.
void add_passive_walls(tools::Facts& facts) {
  const auto least = std::find_if(facts.begin(), facts.end(),
                                  [](const auto& fact) { return fact.first == kTipDamping; });
  if (least == facts.end()) return;
  const double damping_N_s_per_m = std::strtod(least->second.c_str(), nullptr);
  for (const uint32_t rate_kHz : kRates_kHz)
    add("passive_wall_N_per_m" + at_rate(rate_kHz), 2e3 * rate_kHz * damping_N_s_per_m, facts);
}

}  // namespace

const char* section_text(uint32_t type) {
  for (const SectionName& known : kSectionNames) {
    if (known.type == type) return known.text;
  }
  return "unknown, skipped";
}

std::vector<NamedAsset> assets_of(const asset::Container& container) {
  std::vector<NamedAsset> assets;
  for (uint32_t i = 0; i < container.section_count(); ++i) {
    if (assets.empty() || assets.back().name != container.name(i))
      assets.push_back({container.name(i), {}, {}, 0});
    NamedAsset& last = assets.back();
    const core::Bytes bytes = container.section(i);
    last.sections.push_back(i);
    last.bytes += bytes.size();
    const uint32_t type = container.type(i);
    if (type == asset::kOriginSection) add_origin(container.origin_m(), last.facts);
    if (type == device::kLinkageSection) add_stable_walls(bytes, last.facts);
    if (type != asset::kBoundsSection && type != asset::kProvenanceSection) continue;
    tools::Facts facts = tools::read_facts(bytes.data(), bytes.size());
    if (type == asset::kBoundsSection) add_passive_walls(facts);
    last.facts.insert(last.facts.end(), facts.begin(), facts.end());
  }
  return assets;
}

namespace {

// A hash, a name or a version may look like a number and is none.
bool is_text(const std::string& fact) {
  for (const char* const text : {"kind", "source", "source_fnv1a64", "options", "tool"}) {
    if (fact == text) return true;
  }
  return false;
}

size_t digits_end(const std::string& text, size_t at) {
  while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
  return at;
}

// The numbers of JSON: -12, 0.5, 1e-07; not 007, .5, inf.
bool is_number(const std::string& text) {
  const size_t begin = text[0] == '-' ? 1 : 0;
  size_t at = digits_end(text, begin);
  if (at == begin || (text[begin] == '0' && at > begin + 1)) return false;
  if (at < text.size() && text[at] == '.') {
    const size_t fraction = at + 1;
    at = digits_end(text, fraction);
    if (at == fraction) return false;
  }
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '-' || text[exponent] == '+')) ++exponent;
    at = digits_end(text, exponent);
    if (at == exponent) return false;
  }
  return at == text.size();
}

std::string json_fact(const std::string& fact, const std::string& value) {
  return !is_text(fact) && is_number(value) ? value : tools::json_text(value);
}

std::string json_of(const NamedAsset& named, const asset::Container& container) {
  Json facts;
  for (const auto& [fact, value] : named.facts) facts.add(fact, json_fact(fact, value));
  return Json()
      .add("name", json_text(named.name))
      .add("bytes", named.bytes)
      .add("facts", facts.object())
      .add("sections", json_list(named.sections,
                                 [&](uint32_t i) {
                                   return Json()
                                       .add("type", uint64_t{container.type(i)})
                                       .add("is", json_text(section_text(container.type(i))))
                                       .add("bytes", uint64_t{container.section(i).size()})
                                       .object();
                                 }))
      .object();
}

}  // namespace

tools::Json asset_json(const std::string& path, const asset::Container& container) {
  char crc[16];
  std::snprintf(crc, sizeof crc, "%08x", container.crc());
  return Json()
      .add("file", json_text(path))
      .add("version",
           json_text(std::to_string(asset::kMajor) + "." + std::to_string(asset::kMinor)))
      .add("bytes", uint64_t{container.bytes().size()})
      .add("crc", json_text(crc))
      .add("parts", json_list(tools::needed_part_names(container), json_text))
      .add("instructions_to_open", uint64_t(tools::instructions_to_open(container)))
      .add("assets", json_list(assets_of(container), [&](const NamedAsset& named) {
             return "\n  " + json_of(named, container);
           }));
}

}  // namespace firmtouch::cli
