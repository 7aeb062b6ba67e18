#include "host_sim/part_asset.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "bake/asset/asset_writer.hpp"
#include "bake/asset/probes.hpp"
#include "bake/curve/bake_curve.hpp"
#include "bake/mesh/bake_mesh.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/scenario/plan.hpp"
#include "host_sim/trace/log.hpp"
#include "surface/make/make_part.hpp"

namespace firmtouch::test {
namespace {

std::vector<uint8_t> baked() {
  tools::MeshReport mesh_report;
  std::vector<tools::Section> sections =
      tools::bake_mesh(tools::make_part(1, 5000), "part", {}, mesh_report);
  mesh::View mesh;
  tools::CurvePoints points;
  points.samples_m = tools::make_path(1, 600);
  for (uint32_t i = 0; i < points.samples_m.size(); ++i) points.rows.push_back(i);
  tools::CurveReport curve_report;
  std::vector<tools::Section> path = tools::bake_curve(points, "path", curve_report);
  curve::View curve;
  if (!mesh::open(tools::mesh_sections(sections, "part"), mesh).ok() ||
      !curve::open(tools::curve_sections(path, "path"), curve).ok())
    return {};
  sections.push_back(tools::mesh_probes(mesh, "part"));
  path.push_back(tools::curve_probes(curve, "path"));
  sections.insert(sections.end(), path.begin(), path.end());
  return tools::write_asset(std::move(sections)).bytes;
}

struct Folder {
  std::string path;
  Folder() {
    const char* temporary = std::getenv("TMPDIR");
    path = std::string(temporary != nullptr ? temporary : "/tmp") + "/firmtouch-test-XXXXXX";
    if (mkdtemp(path.data()) == nullptr) std::abort();
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

}  // namespace

const std::string& scratch() {
  static const Folder folder;
  return folder.path;
}

const std::string& part_asset() {
  static const std::string path = [] {
    const std::vector<uint8_t> bytes = baked();
    host_sim::write_file(scratch() + "/part.fta", std::string(bytes.begin(), bytes.end()));
    return scratch() + "/part.fta";
  }();
  return path;
}

host_sim::Scenario loop_scenario() {
  const host_sim::Session session(part_asset());
  const host_sim::Environment environment = host_sim::environment_of(*session.controller, {});
  host_sim::Scenario scenario =
      host_sim::read_scenario("loop.scenario", host_sim::plan_scenario(environment, "part.fta"), {},
                              host_sim::parameter_rows());
  host_sim::complete(scenario);
  return scenario;
}

}  // namespace firmtouch::test
