#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bake/asset/provenance.hpp"
#include "cli/baked_input.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "curve/smooth_run.hpp"
#include "log/reader.hpp"

namespace firmtouch::cli {
namespace {

constexpr uint32_t kEnable = 1u << 0,
                   kEncoderFault = 1u << 3;  // of input.lines, as every log has them

// What a record says of the tool.
struct Tick {
  tools::Place place;
  uint32_t lines;
};

std::vector<Tick> ticks_of(log::Reader& reader, const std::string& path) {
  const log::Field* const position = reader.header().find("output.position_m");
  const log::Field* const lines = reader.header().find("input.lines");
  if (position == nullptr || position->type != log::Type::kF32 || position->count != 3)
    fail_input(path + ": its records have no output.position_m of three axes: no run of a tool");
  std::vector<Tick> ticks;
  log::Block block;
  while (reader.next(block))
    for (uint32_t i = 0; i < block.count; ++i) {
      const uint8_t* const record = block.record(i);
      ticks.push_back({{log::value(*position, 0, record), log::value(*position, 1, record),
                        log::value(*position, 2, record)},
                       lines != nullptr ? log::word(record, lines->offset) : kEnable});
    }
  return ticks;
}

double number_of(const log::Header& header, const std::string& key) {
  const auto found = header.text.find(key);
  return found == header.text.end() ? 0 : std::strtod(found->second.c_str(), nullptr);
}

bool is_place(const tools::Place& p) {
  return std::isfinite(p.x_m) && std::isfinite(p.y_m) && std::isfinite(p.z_m);
}

struct SampledRun {
  std::vector<tools::Place> places;  // in the frame of the asset that the run touched, less origin
  size_t left_out = 0;               // ticks whose position is not to be trusted
};

// From the first tick with enable to the last: before, parameters may still be set, which bend what
// a position means. A run that was never enabled counts whole.
SampledRun run_of(const std::vector<Tick>& ticks, const log::Header& header,
                  tools::Point origin_m) {
  size_t begin = 0, end = ticks.size();
  while (begin < end && (ticks[begin].lines & kEnable) == 0) ++begin;
  while (end > begin && (ticks[end - 1].lines & kEnable) == 0) --end;
  if (begin == end) begin = 0, end = ticks.size();
  const double x_m = number_of(header, "parameter.scene_x_m") + origin_m.x,
               y_m = number_of(header, "parameter.scene_y_m") + origin_m.y,
               z_m = number_of(header, "parameter.scene_z_m") + origin_m.z;
  SampledRun run;
  for (size_t i = begin; i < end; ++i) {
    const tools::Place& p = ticks[i].place;
    if ((ticks[i].lines & kEncoderFault) != 0 || !is_place(p))
      ++run.left_out;
    else
      run.places.push_back({p.x_m - x_m, p.y_m - y_m, p.z_m - z_m});
  }
  return run;
}

std::string sentence(const char* format, size_t a, size_t b, double c, double d) {
  char text[300];
  std::snprintf(text, sizeof text, format, a, b, c, d);
  return text;
}

}  // namespace

Extent extent_of_run(const std::string& path) {
  try {
    const std::vector<uint8_t> source = read_file(path);
    log::Reader reader(log::over_memory(source), path);
    const std::vector<Tick> ticks = ticks_of(reader, path);
    Extent extent;
    for (const tools::Place& p : run_of(ticks, reader.header(), {}).places)
      extent.add({p.x_m, p.y_m, p.z_m});
    return extent;
  } catch (const log::Refused& refused) {
    fail_input(refused.what());
  }
}

BakedInput bake_run_input(const std::string& path, const BakeOptions& options, Progress& progress) {
  progress.stage("reading and thinning " + file_name_of(path));
  const std::vector<uint8_t> source = read_file(path);
  try {
    log::Reader reader(log::over_memory(source), path);
    const std::vector<Tick> ticks = ticks_of(reader, path);
    const SampledRun run = run_of(ticks, reader.header(), options.model.origin_m);
    tools::ThinnedRun thinned = tools::thin_run(run.places, options.max_deviation_m, path);
    if (options.smooth)
      tools::refine_smooth_run(run.places, options.max_deviation_m, path, thinned);
    if (!thinned.points.problem.empty()) fail_input(thinned.points.problem);
    std::vector<std::string>& notes = thinned.points.notes;
    if (run.left_out > 0)
      notes.push_back("left out " + std::to_string(run.left_out) +
                      " ticks with an encoder fault or without a position");
    if (reader.missing() > 0)
      notes.push_back(std::to_string(reader.missing()) +
                      " records are missing; a straight piece stands for each gap");
    if (!reader.troubles().empty()) notes.push_back("the log: " + reader.troubles());
    BakedInput baked = bake_points(thinned.points, path, options.teach, source, options, progress);
    baked.report.insert(
        baked.report.begin() + 1,
        sentence("taught by %zu recorded places: %zu samples; no place is farther from the guide "
                 "than %.3g m (%.3g m allowed, both ways)",
                 run.places.size(), thinned.points.samples_m.size(), thinned.max_deviation_m,
                 options.max_deviation_m));
    return baked;
  } catch (const log::Refused& refused) {
    fail_input(refused.what());
  }
}

}  // namespace firmtouch::cli
