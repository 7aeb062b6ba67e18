#include "host_sim/controllers/session.hpp"

#include <filesystem>
#include <utility>

#include "firmtouch/asset/opening.hpp"
#include "firmtouch/controller/needed_parts.hpp"
#include "host_sim/controllers/asset_remedy.hpp"
#include "host_sim/controllers/lock_step_controller.hpp"

namespace firmtouch::host_sim {
namespace {

std::string text_or_empty(const char* text) { return text == nullptr ? "" : text; }
const char* text_or_null(const std::string& text) { return text.empty() ? nullptr : text.c_str(); }

SceneNames names_in(const asset::Container& asset, const SceneNames& wanted) {
  using GuideList = Guides<CurveGuide, SplineGuide>;
  return {
      text_or_empty(SurfacesWithTool<FullMaterialMesh>::find(asset, text_or_null(wanted.surface))),
      text_or_empty(GuideList::find(asset, text_or_null(wanted.guide)))};
}

// Surfaces and guides of the asset, in the order of its table.
std::vector<SceneEntry> scene_entries(const asset::Container& asset) {
  std::vector<SceneEntry> entries;
  for (uint32_t i = 0; i < asset.section_count(); ++i) {
    const uint32_t part = part_of_section(asset, i);
    const bool is_guide = (part & (kPartGuide | kPartSplineGuide)) != 0;
    if (is_guide || (part & (kPartMesh | kPartSpline | kPartObjects)) != 0)
      entries.push_back({is_guide, asset.name(i)});
  }
  return entries;
}

void check_name(const std::string& path, const std::vector<SceneEntry>& entries, bool is_guide,
                const std::string& wanted, const std::string& found) {
  if (wanted.empty() || !found.empty()) return;
  std::string list;
  for (const SceneEntry& entry : entries)
    if (entry.is_guide == is_guide) list += (list.empty() ? "`" : ", `") + entry.name + "`";
  const std::string kind = is_guide ? "guide" : "surface";
  throw Refused(path + ": it has no " + kind + " `" + wanted + "`" +
                (list.empty() ? "; it has no " + kind + " at all" : "; it has: " + list));
}

// The simulator's own controller has every part.
void check_verdict(const std::string& path, core::Verdict verdict, bool is_penalty = false) {
  if (verdict.ok()) return;
  const uint32_t part = verdict.rule - uint32_t{kRuleNeedsMesh};
  throw Refused(path + ": rejected by rule R" + std::to_string(verdict.rule) + " at element " +
                std::to_string(verdict.element) + ": " +
                (is_penalty && part < kPartCount ? std::string("penalty contact has no part `") +
                                                       part_name(part) + "`; leave out --penalty"
                                                 : asset_remedy(verdict.rule)));
}

}  // namespace

Session::Session(const std::string& asset_path, SceneNames wanted_names, Contact contact)
    : asset(asset_path),
      wanted(std::move(wanted_names)),
      controller(std::make_unique<ToolController>()) {
  asset::Container container;
  if (asset::open(asset.bytes(), container).ok()) {
    const std::vector<SceneEntry> entries = scene_entries(container);
    used = names_in(container, wanted);
    default_ = names_in(container, {});
    check_name(asset_path, entries, false, wanted.surface, used.surface);
    check_name(asset_path, entries, true, wanted.guide, used.guide);
  }
  const Selection selection{text_or_null(wanted.surface), text_or_null(wanted.guide)};
  core::Verdict verdict = controller->open(asset.bytes(), selection);
  if (verdict.ok() && contact == Contact::kPenalty) {
    penalty = std::make_unique<PenaltyController>();
    verdict = penalty->open(asset.bytes(), selection);
  }
  check_verdict(asset_path, verdict, penalty != nullptr);
  list_unused(scene_entries(container));
}

void Session::list_unused(const std::vector<SceneEntry>& entries) {
  const MeshObjects& all = controller->objects();
  const auto is_of_objects = [&](const std::string& name) {
    for (uint32_t i = 0; all.is_open() && i < all.stored().size(); ++i)
      if (name == all.stored()[i].mesh) return true;
    return false;
  };
  for (uint32_t i = 0; all.is_open() && i < all.stored().size(); ++i)
    objects.emplace_back(all.stored()[i].name);
  for (const SceneEntry& entry : entries)
    if (entry.name != (entry.is_guide ? used.guide : used.surface) &&
        (entry.is_guide || !is_of_objects(entry.name)))
      unused.push_back((entry.is_guide ? "guide `" : "surface `") + entry.name + "`");
}

void Session::load_next(const std::string& asset_path) {
  next = std::make_unique<AssetFile>(asset_path);
  swapping = std::make_unique<SwappingToolController>();
  const Selection selection{text_or_null(wanted.surface), text_or_null(wanted.guide)};
  check_verdict(asset.path(), swapping->open(asset.bytes(), selection));
  swapping->begin_next(next->bytes());
  while (!swapping->work_next(kSliceUnits)) {
  }
  check_verdict(asset_path, swapping->next_verdict());
}

Tick Session::tick() const {
  if (swapping) return tick_of(*swapping);
  return penalty ? tick_of(*penalty) : tick_of(*controller);
}

std::string Session::scene_text() const {
  std::string text;
  for (size_t i = 0; i < objects.size(); ++i)
    text += (i == 0 ? "objects `" : ", `") + objects[i] + "`";
  if (objects.empty() && !used.surface.empty()) text += "surface `" + used.surface + "`";
  if (const uint32_t spheres = controller->tool().spheres().size(); spheres > 0)
    text += ", touched by " + std::to_string(spheres) + (spheres == 1 ? " sphere" : " spheres");
  if (!used.guide.empty()) text += (text.empty() ? "guide `" : ", guide `") + used.guide + "`";
  for (size_t i = 0; i < unused.size(); ++i) text += (i == 0 ? "; not used: " : ", ") + unused[i];
  return text;
}

std::string Session::program() const {
  return controller->tool().is_open() ? "firmtouch_app_all_tool"
         : objects.empty()            ? "firmtouch_app"
                                      : "firmtouch_app_all_objects";
}

bool Session::is_default() const {
  return used.surface == default_.surface && used.guide == default_.guide;
}

void check_scene(const Session& session, const std::string& controller) {
  if (is_in_process(controller)) return;
  if (session.penalty)
    throw Refused(
        "penalty contact: a controller outside this process renders contact through a "
        "proxy; leave out --controller");
  if (session.is_default()) return;
  throw Refused(session.asset.path() + ": " + session.scene_text() +
                ": a controller outside this process always uses the asset's first surface and "
                "guide; run in-process, or bake these alone");
}

std::string path_from(const std::string& folder_of, const std::string& path) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::absolute(folder_of, error).parent_path();
  const std::filesystem::path relative = std::filesystem::relative(path, folder, error);
  return error || relative.empty() ? path : relative.string();
}

std::string path_beside(const std::string& file, const std::string& relative) {
  const std::filesystem::path path = relative;
  return path.is_absolute() ? relative
                            : (std::filesystem::path(file).parent_path() / path).string();
}

}  // namespace firmtouch::host_sim
