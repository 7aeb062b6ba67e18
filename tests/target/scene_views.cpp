#include "target/scene_views.hpp"

#include "firmtouch/asset/container.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/curve/loader.hpp"
#include "firmtouch/mesh/loader.hpp"
#include "firmtouch/spline/loader.hpp"

namespace firmtouch::target {
Views open_views(core::Bytes region) {
  Views views;
  asset::Container file;
  const uint32_t bytes = asset::stated_bytes(region);
  views.verdict = asset::open({region.data(), bytes != 0 ? bytes : region.size()}, file);
  if (!views.verdict.ok()) return views;
  const uint32_t mesh = file.next_of_type(mesh::kHeadSection);
  if (mesh != asset::kNoSection)
    views.verdict = asset::open_geometry(file, file.name(mesh), views.mesh);
  if (!views.verdict.ok()) return views;
  const uint32_t curve = file.next_of_type(curve::kHeadSection);
  if (curve != asset::kNoSection)
    views.verdict = asset::open_geometry(file, file.name(curve), views.curve);
  if (!views.verdict.ok()) return views;
  const uint32_t spline = file.next_of_type(spline::kHeadSection);
  if (spline != asset::kNoSection)
    views.verdict = asset::open_geometry(file, file.name(spline), views.spline);
  return views;
}

}  // namespace firmtouch::target
