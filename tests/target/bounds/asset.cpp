#include "target/bounds/asset.hpp"

#include "firmtouch/asset/container.hpp"
#include "firmtouch/asset/loader.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/field/loader.hpp"
#include "firmtouch/hal/board.hpp"
#include "target/scene_views.hpp"

namespace firmtouch::target {
namespace {
Asset opened;
}

bool open_asset() {
  const core::Bytes slot = hal::board_asset();
  const Views views = open_views(slot);
  opened.mesh = views.mesh, opened.curve = views.curve, opened.spline = views.spline;
  if (!views.mesh.is_open() || !views.curve.is_open() || !views.spline.is_open()) return false;
  asset::Container file;
  if (!asset::open({slot.data(), asset::stated_bytes(slot)}, file).ok()) return false;
  const char* const name = file.name(file.next_of_type(mesh::kHeadSection));
  const auto field = asset::find_sections<field::Sections>(file, name);
  const auto materials = asset::find_sections<scene::MaterialSections>(file, name);
  return field::open(field, opened.mesh, opened.field).ok() &&
         scene::open(materials, opened.mesh, opened.materials).ok();
}

const Asset& asset() { return opened; }

}  // namespace firmtouch::target
