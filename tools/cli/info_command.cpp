#include <cstdio>
#include <cstdlib>
#include <map>
#include "firmtouch/device/layout.hpp"
#include "firmtouch/field/layout.hpp"

#include "bake/asset/asset_views.hpp"
#include "bake/asset/json_text.hpp"
#include "bake/asset/part_names.hpp"
#include "bake/asset/provenance.hpp"
#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/loaded_asset.hpp"

namespace firmtouch::cli {
namespace {

struct SectionName {
  uint32_t type;
  const char* text;
};

constexpr SectionName kSectionNames[] = {{asset::kBoundsSection, "bounds"},
                                         {asset::kProvenanceSection, "provenance"},
                                         {mesh::kHeadSection, "mesh head"},
                                         {mesh::kVerticesSection, "mesh vertices"},
                                         {mesh::kTriangles16Section, "mesh triangles, 16 bit"},
                                         {mesh::kTriangles32Section, "mesh triangles, 32 bit"},
                                         {mesh::kNodesSection, "mesh nodes"},
                                         {mesh::kParentsSection, "mesh parents"},
                                         {mesh::kVertexNormalsSection, "mesh vertex normals"},
                                         {mesh::kEdgeFoldsSection, "mesh edge folds"},
                                         {mesh::kLeafBoxesSection, "mesh boxes of leaves"},
                                         {mesh::kShapesSection, "mesh shapes of triangles"},
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

const char* section_text(uint32_t type) {
  for (const SectionName& known : kSectionNames) {
    if (known.type == type) return known.text;
  }
  return "unknown, skipped";
}

// One asset of the file: its sections lie beside each other in the table.
struct NamedAsset {
  std::string name;
  std::vector<uint32_t> sections;
  tools::Facts facts;
  uint64_t bytes = 0;
};

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
    if (type != asset::kBoundsSection && type != asset::kProvenanceSection) continue;
    const tools::Facts facts = tools::read_facts(bytes.data(), bytes.size());
    last.facts.insert(last.facts.end(), facts.begin(), facts.end());
  }
  return assets;
}

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

void print_json(const LoadedAsset& loaded) {
  const asset::Container& container = loaded.container();
  std::printf(
      "{\"file\": %s, \"version\": \"%u.%u\", \"bytes\": %u, \"crc\": \"%08x\", \"parts\": [",
      tools::json_text(loaded.path()).c_str(), asset::kMajor, asset::kMinor,
      container.bytes().size(), container.crc());
  const char* after = "";
  for (const std::string& part : tools::needed_part_names(container)) {
    std::printf("%s%s", after, tools::json_text(part).c_str());
    after = ", ";
  }
  std::printf("], \"assets\": [");
  const char* between = "\n";
  for (const NamedAsset& named : assets_of(container)) {
    std::printf("%s  {\"name\": %s, \"bytes\": %llu, \"facts\": {", between,
                tools::json_text(named.name).c_str(), static_cast<unsigned long long>(named.bytes));
    between = ",\n";
    const char* comma = "";
    for (const auto& fact : named.facts) {
      std::printf("%s%s: %s", comma, tools::json_text(fact.first).c_str(),
                  json_fact(fact.first, fact.second).c_str());
      comma = ", ";
    }
    std::printf("}, \"sections\": [");
    comma = "";
    for (const uint32_t i : named.sections) {
      std::printf("%s{\"type\": %u, \"is\": %s, \"bytes\": %u}", comma, container.type(i),
                  tools::json_text(section_text(container.type(i))).c_str(),
                  container.section(i).size());
      comma = ", ";
    }
    std::printf("]}");
  }
  std::printf("\n]}\n");
}

void print_text(const LoadedAsset& loaded) {
  const asset::Container& container = loaded.container();
  std::printf("%s: %u bytes, %u sections, CRC %08x\n", loaded.path().c_str(),
              container.bytes().size(), container.section_count(), container.crc());
  std::printf("needs parts: %s (FIRMTOUCH_APP)\n", tools::needed_parts_text(container).c_str());
  for (const NamedAsset& named : assets_of(container)) {
    std::printf("\n%s: %llu bytes\n", named.name.c_str(),
                static_cast<unsigned long long>(named.bytes));
    for (const auto& fact : named.facts)
      std::printf("  %-20s %s\n", fact.first.c_str(), fact.second.c_str());
    for (const auto& fact : named.facts) {
      if (fact.first != "triangles") continue;
      std::printf("  %-20s %.1f\n", "bytes a triangle",
                  static_cast<double>(named.bytes) / std::strtod(fact.second.c_str(), nullptr));
    }
    for (const uint32_t i : named.sections) {
      std::printf("  section %04x %10u bytes  %s\n", container.type(i), container.section(i).size(),
                  section_text(container.type(i)));
    }
  }
}

}  // namespace

const Command& info_command() {
  static const Command command{"info",
                               "ASSET.fta [--json]",
                               "Proves an asset and says what is in it.",
                               "Exit code 1 if this machine answers the asset's probe queries with "
                               "other bits than the baker did.",
                               {{"--json", nullptr, "for programs"}},
                               1,
                               1};
  return command;
}

int run_info(const Arguments& arguments) {
  const LoadedAsset loaded(arguments.positionals()[0]);
  for (const std::string& name : tools::names_with(loaded.container(), mesh::kHeadSection)) {
    if (tools::has_tree(loaded.container(), name.c_str())) (void)loaded.mesh(name);
  }
  for (const std::string& name : tools::names_with(loaded.container(), hull::kHeadSection))
    (void)loaded.hull(name);
  for (const std::string& name : tools::names_with(loaded.container(), curve::kHeadSection))
    (void)loaded.curve(name);
  for (const std::string& name : tools::names_with(loaded.container(), spline::kHeadSection))
    (void)loaded.spline(name);
  if (arguments.has("--json")) {
    print_json(loaded);
  } else {
    print_text(loaded);
  }
  const std::string problem = tools::prove_asset(loaded.container().bytes());
  if (problem.empty()) return kDone;
  std::fprintf(stderr,
               "firmtouch: %s: %s; bake it again on this machine, or find the flags that differ\n",
               loaded.path().c_str(), problem.c_str());
  return kAnswerIsNo;
}

}  // namespace firmtouch::cli
