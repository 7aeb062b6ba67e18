#include "bench/touch_subject.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "bake/spline/spline_choice.hpp"
#include "bench/baked_hull.hpp"
#include "bench/brute_truth.hpp"
#include "bench/models.hpp"
#include "bench/open_or_throw.hpp"
#include "bench/problem.hpp"
#include "firmtouch/mesh/segment_cast.hpp"
#include "firmtouch/scene/mesh_touched.hpp"
#include "firmtouch/scene/spline_touched.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "footpoint/footpoints.hpp"
#include "spline/read_spline.hpp"

namespace firmtouch::bench {
namespace {

using math::Vec3;

bool meets(const Model& model, Vec3 a_m, Vec3 b_m) {
  const mesh::Hit hit = mesh::any_crossing(model.view, a_m, b_m, query::kUnlimited);
  return hit.hit || !hit.exact;
}

// Casts are exact, distances by brute force.
class TouchedMesh final : public TouchSubject {
 public:
  TouchedMesh(std::shared_ptr<const Model> model, uint32_t hull_faces)
      : model_(std::move(model)), brute_(model_->surface, false) {
    name = model_->name;
    const mesh::Head& head = model_->view.head();
    low_m = {head.low_m[0], head.low_m[1], head.low_m[2]};
    high_m = {head.high_m[0], head.high_m[1], head.high_m[2]};
    size_m = head.diagonal_m;
    ticks_between_places = 64;
    object_.mesh = &model_->view;
    if (hull_faces == 0) return;
    hull_ = std::make_unique<Baked>(*model_, hull_faces, 16u);
    words_ = tools::cut_base_hull(hull_->view, hull_faces);
    const core::Verdict verdict = hull::open_base_hull(
        {reinterpret_cast<const uint8_t*>(words_.data()), static_cast<uint32_t>(4 * words_.size())},
        hull_->view, base_hull_);
    if (!verdict.ok()) throw Problem(name + ": its base hull breaks " + tools::rule_text(verdict));
    object_.base_hull = &base_hull_;
  }

  void begin() override { hint_ = {}; }
  scene::Near near(Vec3 x_m, query::Budget budget, float needed_m) override {
    return scene::HulledMeshTouched{object_, hint_}.near(x_m, budget, needed_m);
  }
  float free_part(scene::Way way, query::Budget budget, uint32_t& work) const override {
    return scene::free_part_of(object_, way, budget, work);
  }
  bool is_crossed(Vec3 a_m, Vec3 b_m) const override { return meets(*model_, a_m, b_m); }
  double distance_m(tools::Point p) const override { return brute_.at(p).distance_m; }
  const std::shared_ptr<const Model>& model() const { return model_; }

 private:
  std::shared_ptr<const Model> model_;
  BruteForce brute_;
  std::unique_ptr<Baked> hull_;
  std::vector<uint32_t> words_;
  hull::BaseHull base_hull_;
  scene::MeshObject object_;
  mesh::Hint hint_;
};

// At a pole of a surface some triangles have no area.
void add(tools::Surface& to, const tools::Face& face) {
  const auto at = [&](int k) { return tools::to_point(to.vertices[face[static_cast<size_t>(k)]]); };
  if (tools::length(tools::cross(at(1) - at(0), at(2) - at(0))) > 0) to.faces.push_back(face);
}

// Triangles from points of the file's own surfaces, `across` each way.
// Result: the most that a chord leaves the surface at the middle of a cell.
double tessellate(const tools::SplineModel& from, uint32_t across, tools::Surface& to) {
  double deviation_m = 0;
  for (const tools::SplineSurface& s : from.surfaces) {
    const auto at = [&s, across](double i, double j) {
      return tools::point_at(s, s.u0 + (s.u1 - s.u0) * i / across,
                             s.v0 + (s.v1 - s.v0) * j / across);
    };
    const uint32_t begin = static_cast<uint32_t>(to.vertices.size());
    for (uint32_t j = 0; j <= across; ++j)
      for (uint32_t i = 0; i <= across; ++i) to.vertices.push_back(tools::to_vec3(at(i, j)));
    for (uint32_t j = 0; j < across; ++j)
      for (uint32_t i = 0; i < across; ++i) {
        const uint32_t a = begin + j * (across + 1) + i, b = a + across + 1;
        add(to, {a, a + 1, b + 1});
        add(to, {a, b + 1, b});
        const tools::Point middle = at(i + 0.5, j + 0.5);
        const tools::Point chord =
            (tools::to_point(to.vertices[a]) + tools::to_point(to.vertices[b + 1])) * 0.5;
        deviation_m = std::max(deviation_m, tools::length(middle - chord));
      }
  }
  for (uint32_t i = 0; i < to.faces.size(); ++i) to.source.push_back(i);
  return deviation_m;
}

// Casts are exact, through a fine tessellation; distances are those of all foot-points.
class TouchedSplines final : public TouchSubject {
 public:
  explicit TouchedSplines(const std::string& path) {
    constexpr double kTriangles = 200000;
    name = std::filesystem::path(path).stem().string();
    tools::SplineModel model = tools::read_spline_file(path, 0);
    if (!model.problem.empty()) throw Problem(model.problem);
    if (model.surfaces.empty()) throw Problem(path + ": has no surface to touch");
    tools::SplineReport report;
    sections_ = tools::bake_fast_spline(model, name, false, report);
    if (!report.problem.empty()) throw Problem(path + ": " + report.problem);
    open_or_throw(sections_, name, path + ": its spline", view_);
    const spline::Head& head = view_.head();
    low_m = {head.low_m[0], head.low_m[1], head.low_m[2]};
    high_m = {head.high_m[0], head.high_m[1], head.high_m[2]};
    size_m = head.extent_m;
    min_radius_m = scene::kMinBall * size_m;
    ticks_between_places = 4096;
    const double each = kTriangles / 2 / static_cast<double>(model.surfaces.size());
    tools::Surface surface;
    least_radius_m = 2 * tessellate(model, static_cast<uint32_t>(std::sqrt(each)), surface);
    cast_ = model_of(std::move(surface), name, path, Sides::kUnsigned);
    std::vector<tools::BezierPatch> patches;
    for (const tools::SplineSurface& s : model.surfaces)
      for (tools::BezierPatch& patch : tools::bezier_pieces(s)) patches.push_back(std::move(patch));
    feet_ = std::make_unique<tools::Footpoints>(std::vector<tools::BezierCurve>{}, patches);
    object_.surface = &view_;
  }

  void begin() override { hint_ = {}; }
  scene::Near near(Vec3 x_m, query::Budget budget, float needed_m) override {
    return scene::SplineTouched{object_, hint_}.near(x_m, budget, needed_m);
  }
  bool is_crossed(Vec3 a_m, Vec3 b_m) const override { return meets(cast_, a_m, b_m); }
  double distance_m(tools::Point p) const override {
    bool is_complete = false;
    const std::vector<tools::Footpoint> all = feet_->all(p, is_complete);
    return all.empty() ? HUGE_VAL : all.front().distance_m;
  }

 private:
  std::vector<tools::Section> sections_;
  spline::View view_;
  scene::SplineObject object_;
  spline::Hint hint_;
  Model cast_;
  std::unique_ptr<tools::Footpoints> feet_;
};

bool is_of_splines(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".igs" || ending == ".iges" || ending == ".bpt";
}

std::unique_ptr<TouchSubject> touched(Model model) {
  return std::make_unique<TouchedMesh>(std::make_shared<const Model>(std::move(model)), 0u);
}

}  // namespace

std::vector<std::unique_ptr<TouchSubject>> load_touch_subjects(const Options& options) {
  std::vector<std::unique_ptr<TouchSubject>> subjects;
  for (const std::string& path : options.models)
    subjects.push_back(is_of_splines(path) ? std::make_unique<TouchedSplines>(path)
                                           : touched(load_model(path)));
  if (subjects.empty()) subjects.push_back(touched(demo_part()));
  return subjects;
}

bool is_mesh(const TouchSubject& subject) {
  return dynamic_cast<const TouchedMesh*>(&subject) != nullptr;
}

std::unique_ptr<TouchSubject> with_base_hull(const TouchSubject& mesh, uint32_t faces) {
  return std::make_unique<TouchedMesh>(dynamic_cast<const TouchedMesh&>(mesh).model(), faces);
}

}  // namespace firmtouch::bench
