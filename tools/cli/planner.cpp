#include "cli/planner.hpp"

#include <algorithm>

#include "bake/asset/asset_views.hpp"
#include "bake/asset/part_names.hpp"
#include "cli/baked_asset.hpp"
#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "firmtouch/asset/loader.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/field/closest_point.hpp"
#include "firmtouch/hull/layout.hpp"
#include "firmtouch/params/rows.hpp"
#include "firmtouch/scene/tool_layout.hpp"
#include "surface/make/make_walk.hpp"

namespace firmtouch::cli {
namespace {

using Words = std::vector<std::string>;

constexpr uint64_t kWalkSeed = 1;
constexpr const char* kFieldCells[] = {"16", "32", "64"};
constexpr const char* kHullFaces = "500";  // a budget of 1,280 units holds 1,000 (mesh_contact.cpp)

// As contact queries a mesh: exact within the tool's radius.
float band_m() {
  for (const params::Entry& row : params::ContactRows::kRows)
    if (row.number == params::kToolRadius) return row.initial;
  return 0;
}

std::vector<math::Vec3> walk_on(const mesh::View& mesh) {
  tools::Surface surface;
  for (uint32_t i = 0; i < mesh.head().vertex_count; ++i)
    surface.vertices.push_back(mesh.vertex(i));
  for (uint32_t i = 0; i < mesh.head().triangle_count; ++i) {
    const auto& corner = mesh.triangle(i).corner;
    surface.faces.push_back({corner[0], corner[1], corner[2]});
  }
  mesh::Hint hint;
  return tools::make_walk(surface, kWalkSeed, tools::kFigureQueries, [&](math::Vec3 p_m) {
    return mesh::closest_point(mesh, p_m, query::kUnlimited, hint).point_m;
  });
}

tools::StepFigures work_of(const mesh::View& mesh, const field::View& distance_field,
                           const std::vector<math::Vec3>& walk) {
  query::Budget budget;
  budget.band_m = band_m();
  mesh::Hint hint;
  return tools::measure_steps(
      mesh.head().low_m, mesh.head().high_m, walk, [&](math::Vec3 p_m, bool cold) {
        if (cold) hint = mesh::Hint{};
        return distance_field.is_open()
                   ? field::closest_point(distance_field, mesh, p_m, budget.band_m, budget, hint)
                         .closest.certificate.work
                   : mesh::closest_point(mesh, p_m, budget, hint).certificate.work;
      });
}

// Of the sections whose types begin as that of `head`.
uint64_t bytes_of_kind(const asset::Container& container, uint32_t head) {
  uint64_t bytes = 0;
  for (uint32_t i = 0; i < container.section_count(); ++i)
    if (container.type(i) >> 8 == head >> 8) bytes += container.section(i).size();
  return bytes;
}

Words with(Words words, std::initializer_list<const char*> more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

std::string PlanRow::text() const {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text.empty() ? "--fast" : text;
}

const PlanRow& Planner::least() const {
  return *std::min_element(rows_.begin(), rows_.end(), [](const PlanRow& a, const PlanRow& b) {
    return a.refused.empty() && (!b.refused.empty() || a.flash() < b.flash());
  });
}

void Planner::measure(const asset::Container& container, PlanRow& row) {
  for (const std::string& name : tools::names_with(container, mesh::kHeadSection)) {
    mesh::View mesh;
    field::View distance_field;
    if (!asset::open_geometry(container, name.c_str(), mesh).ok()) continue;
    const auto sections = asset::find_sections<field::Sections>(container, name.c_str());
    if (!sections.head.empty()) (void)field::open(sections, mesh, distance_field);
    std::vector<math::Vec3>& walk = walks_[name];
    if (walk.empty()) walk = walk_on(mesh);
    const tools::StepFigures work = work_of(mesh, distance_field, walk);
    row.triangles += mesh.head().triangle_count;
    row.work.path_mean = std::max(row.work.path_mean, work.path_mean);
    row.work.path_worst = std::max(row.work.path_worst, work.path_worst);
    row.work.random_mean = std::max(row.work.random_mean, work.random_mean);
    row.work.random_worst = std::max(row.work.random_worst, work.random_worst);
  }
}

PlanRow Planner::bake(const Words& words, bool must) {
  PlanRow row;
  row.words = words;
  Words all = shared_;
  all.insert(all.end(), words.begin(), words.end());
  BakedAsset baked;
  Command command = bake_command();
  command.name = "plan";  // whose options they are
  try {
    baked = bake_asset(bake_request(Arguments(command, all)), "plan");
  } catch (const Failure& failure) {
    if (must) throw;
    row.refused = failure.message;
    return row;
  }
  asset::Container container;
  const core::Bytes bytes(baked.bytes.data(), static_cast<uint32_t>(baked.bytes.size()));
  (void)asset::open(bytes, container);
  row.asset = baked.bytes.size();
  row.field = bytes_of_kind(container, field::kHeadSection);
  row.hull = bytes_of_kind(container, hull::kHeadSection);
  row.parts = tools::needed_part_names(container);
  const Image* image = image_for(images_, row.parts);
  if (image == nullptr)
    row.refused = "no program of these has its parts: " + tools::needed_parts_text(container);
  else
    row.image = *image;
  for (const std::string& name : tools::names_with(container, scene::kToolSection))
    row.spheres = container.find(scene::kToolSection, name.c_str()).size() /
                  static_cast<uint32_t>(sizeof(scene::SphereLayout));
  measure(container, row);
  return row;
}

template <class IsBetter>
bool Planner::try_row(const Words& words, IsBetter is_better) {
  rows_.push_back(bake(words, rows_.empty()));
  const PlanRow& row = rows_.back();
  if (!fits(row) || (chosen_ >= 0 && !is_better(row, rows_[static_cast<size_t>(chosen_)])))
    return false;
  chosen_ = static_cast<int>(rows_.size()) - 1;
  return true;
}

void Planner::run() {
  const auto always = [](const PlanRow&, const PlanRow&) { return true; };
  const auto freer = [](const PlanRow& a, const PlanRow& b) {
    return a.work.random_mean < 0.9 * b.work.random_mean;
  };
  Words best;
  const bool is_fast = try_row(best, always);
  const auto has = [&](const char* part) {
    const Words& parts = rows_[0].parts;
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  if (!rows_[0].refused.empty()) return;
  const bool has_tree = has("mesh") || has("spline") || has("spline_guide");
  if (!is_fast && has_tree && try_row({"--small"}, always)) best = {"--small"};
  if (chosen_ < 0 || !has("mesh")) return;
  const Words tree = best;
  for (const char* cells : kFieldCells)
    if (try_row(with(tree, {"--distance-map", cells}), freer))
      best = with(tree, {"--distance-map", cells});
  const Words with_hull = with(best, {"--hull-faces", kHullFaces});
  if (try_row(with_hull, always)) best = with_hull;
  if (is_fast) {
    Words bounded = best;
    bounded.insert(bounded.begin(), "--bounded");
    try_row(bounded, [](const PlanRow& a, const PlanRow& b) {
      return a.work.path_worst < b.work.path_worst;
    });
  }
}

}  // namespace firmtouch::cli
