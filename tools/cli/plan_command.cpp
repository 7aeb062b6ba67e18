#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bake/asset/provenance.hpp"
#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "cli/model_input.hpp"
#include "cli/plan_picture.hpp"
#include "firmtouch/params/rows.hpp"
#include "firmtouch/scene/tool.hpp"
#include "json/json.hpp"

namespace firmtouch::cli {
namespace {

struct Limits {
  uint64_t flash, ram;
  double rate_Hz;
  double mips;  // 0: not given
};

// "512K": K and M of `kilo`.
double scaled(const Arguments& arguments, const std::string& option, double kilo,
              const std::string& example) {
  const std::string text = arguments.text(option, "");
  char* end = nullptr;
  double value = std::strtod(text.c_str(), &end);
  std::string unit = end;
  if (unit == "k" || unit == "K") value *= kilo, unit.clear();
  if (unit == "M") value *= kilo * kilo, unit.clear();
  if (text.empty() || !unit.empty() || !(value >= 1 && value <= 1e12))
    fail_usage("plan: " + option + " " + text + ": a number such as " + example + " is needed");
  return value;
}

Limits limits_of(const Arguments& arguments) {
  for (const char* option : {"--flash", "--ram"})
    if (!arguments.has(option))
      fail_usage(std::string("plan: say what there is: ") + option + " 512K");
  Limits limits{static_cast<uint64_t>(scaled(arguments, "--flash", 1024, "512K or 2M")),
                static_cast<uint64_t>(scaled(arguments, "--ram", 1024, "64K or 1M")), 1000, 0};
  if (arguments.has("--rate")) limits.rate_Hz = scaled(arguments, "--rate", 1000, "1k or 4k");
  if (limits.rate_Hz > 20000) fail_usage("plan: --rate: a servo makes at most 20k ticks a second");
  limits.mips = arguments.number("--mips", 0, 1e-3);
  return limits;
}

std::vector<Image> images_of(const Arguments& arguments) {
  if (!arguments.has("--resources"))
    return budgeted_images(
        arguments.choice("--core", "m7", {"m7", "m4f"}) == "m7" ? "mps2-an500" : "netduinoplus2");
  if (arguments.has("--core"))
    fail_usage("plan: --resources brings its own core: leave out --core");
  return measured_images(arguments.text("--resources", ""));
}

// The inputs and those options that bake has, too.
std::vector<std::string> words_for_bake(const Arguments& arguments) {
  std::vector<std::string> words = arguments.positionals();
  const Command plan = plan_command(), bake = bake_command();
  for (const Option& option : plan.options)
    for (const Option& of_bake : bake.options) {
      if (std::string(option.name) != of_bake.name || !arguments.has(option.name)) continue;
      if (option.value == nullptr)
        words.push_back(option.name);
      else
        words.push_back(std::string(option.name) + "=" + arguments.text(option.name, ""));
    }
  return words;
}

// As a shell takes it.
std::string quoted(const std::string& word) {
  if (word.find_first_of(" '\"\\$&;()*?<>|`!#~\t") == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string rounded(double value) { return std::to_string(std::llround(value)); }

void print_rows(const Planner& planner) {
  bool has_mesh = false;
  for (const PlanRow& row : planner.rows()) has_mesh = has_mesh || row.triangles != 0;
  std::printf("%-50s %-22s %9s %9s %9s %8s%s\n", "  baked with", "program", "asset B", "flash B",
              "RAM B", "fits", has_mesh ? "  units touching  units anywhere" : "");
  for (size_t i = 0; i < planner.rows().size(); ++i) {
    const PlanRow& row = planner.rows()[i];
    const bool is_chosen = static_cast<int>(i) == planner.chosen();
    std::printf("%c %-48s ", is_chosen ? '*' : ' ', row.text().c_str());
    if (!row.refused.empty()) {
      std::printf("%s\n", row.refused.c_str());
      continue;
    }
    std::printf(
        "%-22s %9llu %9llu %9llu %8s", row.image.parts.c_str(),
        static_cast<unsigned long long>(row.asset), static_cast<unsigned long long>(row.flash()),
        static_cast<unsigned long long>(row.image.whole_ram()), planner.fits(row) ? "yes" : "no");
    if (row.triangles != 0)
      std::printf(" %8.1f, %5u %8.1f, %5u", row.work.path_mean, row.work.path_worst,
                  row.work.random_mean, row.work.random_worst);
    std::printf("\n");
  }
  std::printf("%s\n", has_mesh ? "units: mean and worst of 2,000 mesh queries, of a tool that "
                                 "touches, and at points in 1.5 boxes\n"
                               : "");
}

template <class Rows>
double initial_of(uint32_t number) {
  for (const params::Entry& entry : Rows::kRows)
    if (entry.number == number) return static_cast<double>(entry.initial);
  return 0;
}

// What the pools of a tick can be at this rate. Those of a tool have more for each sphere.
std::vector<std::string> tick_pools(const Limits& limits, const PlanRow& row, double of_spheres) {
  const double units = initial_of<params::SafetyRows>(params::kTickWork) + of_spheres;
  const double a_unit = static_cast<double>(params::kInstructionsAUnit);
  const double fixed = static_cast<double>(params::kFixedTickWork) + of_spheres;
  const auto needed = [&](double work) {
    return tools::number_text(work * a_unit * limits.rate_Hz / 1e6);
  };
  if (limits.mips <= 0)
    return {"tick_work " + rounded(units) + " takes at most " + rounded(units * a_unit) +
                " instructions a tick: " + needed(units) + " million a second at " +
                rounded(limits.rate_Hz) + " Hz",
            "the least pool, " + rounded(fixed + 1) + ", takes " + needed(fixed + 1) +
                " million; --mips N, what your core was seen to do, chooses a pool"};
  const double room = std::floor(limits.mips * 1e6 / (limits.rate_Hz * a_unit));
  if (room < fixed + 1)
    return {rounded(room) + " units a tick are below the least pool of " + rounded(fixed + 1) +
                (row.image.has_two_rates ? ": the program has two rates"
                                         : ": build with -DFIRMTOUCH_APP_TWO_RATES=ON"),
            "geometry at most at " +
                rounded(std::floor(limits.mips * 1e6 / ((fixed + 1) * a_unit))) +
                " Hz then; without it --rate is at most that"};
  const double pool = std::min(room, units);
  std::vector<std::string> lines{
      "tick_work " + rounded(pool) + ": " + rounded(pool - fixed) + " units for queries; " +
      needed(pool) + " of " + tools::number_text(limits.mips) + " million instructions a second"};
  if (row.work.path_worst > pool - fixed)
    lines.push_back("a touching query was seen to take " + std::to_string(row.work.path_worst) +
                    ": contact may be uncertain there, and the base hull takes over if baked");
  return lines;
}

std::vector<std::string> pools(const Limits& limits, const PlanRow& row) {
  const double more =
      row.spheres < 2 ? 0 : static_cast<double>((row.spheres - 1) * scene::kSphereWork);
  std::vector<std::string> lines = tick_pools(limits, row, more);
  if (more > 0)
    lines.push_back("mesh_work " +
                    rounded(initial_of<params::ContactRows>(params::kMeshWork) + more) + ": of " +
                    std::to_string(row.spheres) + " spheres each after the first needs " +
                    std::to_string(scene::kSphereWork) + " units more, of tick_work, too");
  return lines;
}

std::string parts_text(const PlanRow& row) {
  std::string text;
  for (const std::string& part : row.parts) text += (text.empty() ? "" : ";") + part;
  return text;
}

// Where nothing fits: what would.
std::vector<std::string> advice(const Planner& planner, const Limits& limits) {
  const PlanRow& row = planner.least();
  if (!row.refused.empty())
    return {row.refused, "build one with -DFIRMTOUCH_APP=\"" + parts_text(row) +
                             "\", measure it by tools/check/image, and give its resources.json "
                             "with --resources"};
  std::vector<std::string> lines;
  if (row.image.whole_ram() > limits.ram)
    lines.push_back("RAM: --ram " + std::to_string(row.image.whole_ram()) +
                    " would do: program, stack of the deepest phase and record ring");
  if (row.flash() <= limits.flash) return lines;
  lines.push_back("flash: --flash " + std::to_string(row.flash()) + " would do, with " +
                  row.text());
  if (row.triangles == 0 || row.image.flash >= limits.flash) return lines;
  const double a_triangle = static_cast<double>(row.asset) / static_cast<double>(row.triangles);
  lines.push_back("or meshes of about " +
                  rounded(static_cast<double>(limits.flash - row.image.flash) / a_triangle) +
                  " triangles (now " + std::to_string(row.triangles) + ") at the same " +
                  tools::number_text(std::round(a_triangle * 10) / 10) + " bytes a triangle");
  return lines;
}

std::string json_of(const Planner& planner, const std::vector<std::string>& said) {
  const std::string rows = tools::json_list(planner.rows(), [&](const PlanRow& row) {
    tools::Json json;
    json.add("options", tools::json_text(row.text()));
    if (!row.refused.empty()) return json.add("refused", tools::json_text(row.refused)).object();
    return json.add("program", tools::json_text(row.image.parts))
        .add("two_rates", row.image.has_two_rates)
        .add("asset", row.asset)
        .add("field", row.field)
        .add("hull", row.hull)
        .add("flash", row.flash())
        .add("ram", row.image.whole_ram())
        .add("fits", planner.fits(row))
        .add("units_touching_mean", row.work.path_mean)
        .add("units_touching_worst", uint64_t{row.work.path_worst})
        .add("units_anywhere_mean", row.work.random_mean)
        .add("units_anywhere_worst", uint64_t{row.work.random_worst})
        .object();
  });
  return tools::Json()
      .add("chosen", planner.chosen() < 0 ? "null" : std::to_string(planner.chosen()))
      .add("rows", rows)
      .add("says", tools::json_list(said, tools::json_text))
      .object();
}

}  // namespace

Command plan_command() {
  return {{"plan", "INPUT... --flash BYTES --ram BYTES [options]", 1, SIZE_MAX, run_plan},
          "Chooses tree, distance field, hull, program and work pool that fit a controller.",
          R"(Bakes the inputs in several ways in memory and writes nothing. Takes the fastest tree
that fits, then a distance field that lowers the mean work by a tenth, a hull, and the
bounded tree if there is room. Programs are those that tools/check/image measures and
bounds; give yours with --resources. Exit code 1 where nothing fits, with what would.)",
          with_model_options(
              {{"--flash", "BYTES", "for program and asset, such as 512K or 2M"},
               {"--ram", "BYTES", "for variables, stack and record ring, such as 64K"},
               {"--rate", "HZ", "ticks a second, such as 4k (default 1k)"},
               {"--core", "m7|m4f", "whose programs are counted (default m7)"},
               {"--mips", "N", "million instructions a second that your core was seen to do"},
               {"--resources", "FILE",
                "resources.json of your own build, which tools/check/image writes"},
               {"--unsigned", nullptr, "as for bake"},
               {"--smooth", nullptr, "as for bake"},
               {"--device", "FILE", "as for bake"},
               {"--materials", "FILE", "as for bake"},
               {"--material-numbers", "FILE", "as for bake"},
               {"--picture", "FILE.svg", "the trade as a picture"},
               {"--json", nullptr, "for programs"}})};
}

int run_plan(const Arguments& arguments) {
  const Limits limits = limits_of(arguments);
  const std::string picture = arguments.text("--picture", "");
  for (const std::string& input : arguments.positionals()) forbid_overwriting(picture, input);
  const std::vector<std::string> shared = words_for_bake(arguments);
  Planner planner(images_of(arguments), shared, limits.flash, limits.ram);
  planner.run();
  std::vector<std::string> said;
  if (planner.chosen() < 0) {
    said = advice(planner, limits);
  } else {
    const PlanRow& row = planner.rows()[static_cast<size_t>(planner.chosen())];
    said = {"flash " + std::to_string(row.flash()) + " of " + std::to_string(limits.flash) +
                " bytes, RAM " + std::to_string(row.image.whole_ram()) + " of " +
                std::to_string(limits.ram) + ", " + std::to_string(row.image.stack) +
                " of it stack (STACK_BYTES of your link.ld)",
            "program: the parts " + row.image.parts +
                (row.image.has_two_rates ? " at two rates" : "") + ", at most " +
                std::to_string(row.image.flash) + " bytes on " + row.image.board};
    for (const std::string& line : pools(limits, row)) said.push_back(line);
    std::string bake = "bake: firmtouch bake";
    for (const std::string& word : shared) bake += " " + quoted(word);
    said.push_back(bake + " " + row.text() + " -o SCENE.fta");
  }
  if (!picture.empty()) {
    const std::string svg = plan_picture(planner, limits.flash);
    write_file(picture, svg.data(), svg.size());
  }
  if (arguments.has("--json")) {
    std::puts(json_of(planner, said).c_str());
  } else {
    print_rows(planner);
    if (planner.chosen() < 0) std::puts("nothing fits");
    for (const std::string& line : said) std::puts(line.c_str());
  }
  return planner.chosen() < 0 ? kAnswerIsNo : kDone;
}

}  // namespace firmtouch::cli
