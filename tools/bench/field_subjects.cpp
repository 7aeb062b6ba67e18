#include "bench/field_subjects.hpp"

#include <filesystem>

#include "bench/problem.hpp"
#include "surface/check/check.hpp"
#include "surface/make/make_part.hpp"
#include "surface/read/read_surface.hpp"

namespace firmtouch::bench {
namespace {

Subject subject_of(tools::Surface surface, const std::string& name) {
  Subject subject;
  subject.name = name;
  subject.surface = std::make_unique<tools::Surface>(std::move(surface));
  subject.solids.emplace_back(*subject.surface);
  subject.is_bunny = name.find("bunny") != name.npos;
  return subject;
}

// Holes are closed, as --close-holes does.
Subject load(const std::string& path) {
  tools::Imported imported = tools::read_surface(path, 1.0);
  if (!imported.problem.empty()) throw Problem(imported.problem);
  tools::CheckOptions checks;
  checks.close_holes = true;
  const tools::CheckReport report = tools::check_and_mend(imported.surface, checks);
  if (!report.usable()) throw Problem(path + ": " + report.refused.front());
  return subject_of(std::move(imported.surface), std::filesystem::path(path).stem().string());
}

}  // namespace

std::vector<Subject> field_subjects(const Options& options) {
  std::vector<Subject> subjects;
  for (const std::string& path : options.models) subjects.push_back(load(path));
  if (subjects.empty()) subjects.push_back(subject_of(tools::make_part(1, 20000), "part"));
  return subjects;
}

tools::DistanceField field_of(const Subject& subject, uint32_t cells) {
  tools::FieldOptions options;
  options.interior_only = true;
  return tools::make_distance_field(
      subject.solids, tools::make_voxel_grid({subject.surface.get()}, cells), options);
}

std::vector<tools::Point> centres_of(const tools::DistanceField& distance_field, bool inside_only) {
  std::vector<tools::Point> points;
  const tools::VoxelGrid& grid = distance_field.grid;
  for (uint32_t z = 0; z < grid.count[2]; ++z)
    for (uint32_t y = 0; y < grid.count[1]; ++y)
      for (uint32_t x = 0; x < grid.count[0]; ++x) {
        const int8_t sign = distance_field.values[grid.index(x, y, z)].sign;
        if (inside_only ? sign < 0 : sign != 0) points.push_back(grid.centre_m(x, y, z));
      }
  return points;
}

}  // namespace firmtouch::bench
