#include <cstdio>
#include <cstdlib>

#include "bake/asset/asset_views.hpp"
#include "bake/asset/opening_cost.hpp"
#include "bake/asset/part_names.hpp"
#include "bake/asset/provenance.hpp"
#include "cli/asset_json.hpp"
#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/loaded_asset.hpp"
#include "firmtouch/field/layout.hpp"

namespace firmtouch::cli {
namespace {

void print_text(const LoadedAsset& loaded) {
  const asset::Container& container = loaded.container();
  std::printf("%s: %u bytes, %u sections, CRC %08x\n", loaded.path().c_str(),
              container.bytes().size(), container.section_count(), container.crc());
  std::printf("needs parts: %s (FIRMTOUCH_APP)\n", tools::needed_parts_text(container).c_str());
  std::printf("%s\n", tools::opening_cost_text(container).c_str());
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

Command info_command() {
  return {{"info", "ASSET.fta [--json]", 1, 1, run_info},
          "Proves an asset and says what is in it.",
          R"(Of a linkage it prints the stiffest wall of the initial damping that is stable on the
tip's least mass: stiffer ones are not enabled; and, without damping, the stiffest that
is passive with any passive hand. Both by the difference of two positions;
firmtouch-sim z-width has poses and hands.
Exit code 1 if this machine answers the asset's probe queries with other bits than the
baker did.)",
          {{"--json", nullptr, "for programs"}}};
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
    std::puts(asset_json(loaded.path(), loaded.container()).object().c_str());
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
