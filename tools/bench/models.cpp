#include "bench/models.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "bake/asset/origin.hpp"
#include "bench/open_or_throw.hpp"
#include "bench/points_about.hpp"
#include "bench/problem.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "surface/check/check.hpp"
#include "surface/extent.hpp"
#include "surface/make/make_part.hpp"
#include "surface/make/make_walk.hpp"
#include "surface/read/read_surface.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::bench {
namespace {

constexpr uint64_t kPartSeed = 1;

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const std::filesystem::path where = std::filesystem::temp_directory_path(error);
  path_ = (error ? std::filesystem::path(".") : where) / "firmtouch-bench-XXXXXX";
  if (mkdtemp(path_.data()) == nullptr)
    throw Problem(path_ + ": cannot be made: " + std::strerror(errno) +
                  "; set TMPDIR to a folder that can be written");
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& text) const {
  const std::string path = (std::filesystem::path(path_) / name).string();
  const std::string problem = tools::write_text(path, text);
  if (!problem.empty()) throw Problem(problem);
  return path;
}

Model model_of(tools::Surface surface, const std::string& name, const std::string& path,
               Sides sides, const tools::TreeShape& shape) {
  Model model;
  model.name = name;
  model.path = path;
  model.surface = std::move(surface);
  const std::string where = path.empty() ? name : path;
  tools::MeshOptions options;
  options.is_signed = sides == Sides::kSigned;
  options.shape = shape;
  model.sections = tools::bake_mesh(model.surface, "model", options, model.report);
  if (!model.report.problem.empty()) throw Problem(where + ": " + model.report.problem);
  open_or_throw(model.sections, "model", where + ": its mesh", model.view);
  model.wide = simd::WideMesh(model.view);
  return model;
}

Model load_model(const std::string& path, Sides sides, CountedFrom counted) {
  tools::FileFrame frame;
  tools::Imported imported = tools::read_surface(path, frame);
  if (!imported.problem.empty()) throw Problem(imported.problem);
  const tools::Extent extent = tools::extent_of(imported.surface);
  const tools::Point origin_m = tools::origin_for(extent.low, extent.high);
  if (counted == CountedFrom::kOrigin && tools::is_moved(origin_m)) {
    frame.offset_m = origin_m * -1;
    imported = tools::read_surface(path, frame);
  }
  tools::CheckOptions checks;
  checks.allow_unsigned = sides == Sides::kUnsigned;
  const tools::CheckReport report = tools::check_and_mend(imported.surface, checks);
  if (!report.usable()) throw Problem(path + ": " + report.refused.front());
  return model_of(std::move(imported.surface), std::filesystem::path(path).stem().string(), path,
                  sides);
}

Model demo_part(Sides sides, uint32_t triangles) {
  return model_of(tools::make_part(kPartSeed, triangles), "part", "", sides);
}

std::vector<Model> load_models(const Options& options, Sides sides) {
  std::vector<Model> models;
  for (const std::string& path : options.models)
    models.push_back(load_model(path, sides, CountedFrom::kFile));
  if (models.empty()) models.push_back(demo_part(sides));
  return models;
}

Model baked_again(const Model& model, Sides sides) {
  return model_of(model.surface, model.name, model.path, sides);
}

Model baked_for_desktop(const Model& model) {
  return model_of(model.surface, model.name, model.path, Sides::kSigned, tools::kDesktopTree);
}

std::string file_for_peer(const Model& model, const TemporaryFolder& folder) {
  if (!model.path.empty()) return model.path;
  return folder.write(model.name + ".obj", tools::to_obj(model.surface));
}

std::vector<math::Vec3> random_points(const Model& model, size_t count, uint64_t seed) {
  return points_about(model.view.head(), count, seed);
}

std::vector<math::Vec3> walk(const Model& model, uint32_t count, uint64_t seed) {
  mesh::Hint hint;
  return tools::make_walk(model.surface, seed, count, [&](math::Vec3 p_m) {
    return model.wide.closest_point(p_m, query::kUnlimited, hint).point_m;
  });
}

}  // namespace firmtouch::bench
