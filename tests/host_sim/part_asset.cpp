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

using Sections = std::vector<tools::Section>;

void add_mesh(Sections& to, uint32_t seed, uint32_t triangles, const std::string& name) {
  tools::MeshReport report;
  Sections sections = tools::bake_mesh(tools::make_part(seed, triangles), name, {}, report);
  mesh::View mesh;
  if (!tools::open_baked(sections, name, mesh).ok()) std::abort();
  sections.push_back(tools::mesh_probes(mesh, name));
  to.insert(to.end(), sections.begin(), sections.end());
}

void add_path(Sections& to, uint32_t seed, const std::string& name) {
  tools::CurvePoints points;
  points.samples_m = tools::make_path(seed, 600);
  for (uint32_t i = 0; i < points.samples_m.size(); ++i) points.rows.push_back(i);
  tools::CurveReport report;
  Sections sections = tools::bake_curve(points, name, report);
  curve::View curve;
  if (!tools::open_baked(sections, name, curve).ok()) std::abort();
  sections.push_back(tools::curve_probes(curve, name));
  to.insert(to.end(), sections.begin(), sections.end());
}

std::string write(Sections sections, const std::string& name) {
  const std::vector<uint8_t> bytes = tools::write_asset(std::move(sections)).bytes;
  host_sim::write_file(scratch() + "/" + name, std::string(bytes.begin(), bytes.end()));
  return scratch() + "/" + name;
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
    Sections sections;
    add_mesh(sections, 1, 5000, "part");
    add_path(sections, 1, "path");
    return write(std::move(sections), "part.fta");
  }();
  return path;
}

const std::string& two_part_asset() {
  static const std::string path = [] {
    Sections sections;
    add_mesh(sections, 1, 5000, "part");
    add_mesh(sections, 2, 2000, "lid");
    add_path(sections, 1, "path");
    add_path(sections, 2, "rim");
    return write(std::move(sections), "two.fta");
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
