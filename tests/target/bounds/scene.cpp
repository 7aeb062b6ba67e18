#include <float.h>

#include "firmtouch/curve/guided_point.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/curve_guide.hpp"
#include "firmtouch/scene/guide_step.hpp"
#include "firmtouch/scene/mesh_contact.hpp"
#include "firmtouch/scene/object.hpp"
#include "firmtouch/scene/relief.hpp"
#include "firmtouch/scene/spline_contact.hpp"
#include "firmtouch/scene/stored_objects.hpp"
#include "firmtouch/scene/stored_tool.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "target/bounds/asset.hpp"
#include "target/bounds/hand.hpp"
#include "target/bounds/meter.hpp"
#include "target/random.hpp"

namespace firmtouch::target {
namespace {

using math::Vec3;

constexpr uint32_t kTicks = 20000;
constexpr query::Budget kBudget{10000};

// What a contact or guide takes beside its query, which is made again: a hand moves about the box
// of `head`. `set`: before each tick, not counted.
template <class Touch, class Head, class Set, class Contact, class Query>
void measure(const char* header, const Head& head, uint32_t seed, const Set& set,
             const Contact& contact, const Query& query) {
  Hand hand(head.low_m, head.high_m, seed);
  Touch touch;
  servo::LocalModel model;
  Worst worst;
  for (uint32_t i = 0; i < kTicks; ++i) {
    const Vec3 at_m = hand.next(touch.closest.point_m);
    set(i, touch);
    scene::begin_model(model, at_m, i, 10);
    Touch same = touch;
    const uint32_t own = instructions_of([&] { query(same, at_m); });
    const uint32_t all = instructions_of([&] { contact(touch, at_m, model); });
    asm volatile("" ::"r"(&same), "r"(&touch) : "memory");
    worst.take(all > own ? all - own : 0);
  }
  print_figure(header, worst);
}

void measure_mesh_contact() {
  scene::MeshObject object;
  object.mesh = &asset().mesh;
  object.material = {1000, 2};
  const mesh::Head& head = object.mesh->head();
  constexpr float kRadius_m = 0.003f;
  query::Budget budget = kBudget;
  measure<scene::MeshTouch>(
      "scene/mesh_contact.hpp", head, 7,
      [&](uint32_t, const scene::MeshTouch& touch) {
        budget.band_m = touch.hint.sign > 0 ? kRadius_m + 0.02f * head.diagonal_m : kBudget.band_m;
      },
      [&](scene::MeshTouch& touch, Vec3 at_m, servo::LocalModel& model) {
        scene::touch_mesh<>(object, kRadius_m, at_m, kBudget, touch, model);
      },
      [&](scene::MeshTouch& touch, Vec3 at_m) {
        touch.closest = mesh::closest_point(*object.mesh, at_m, budget, touch.hint);
      });
}

void measure_spline_contact() {
  scene::SplineObject object;
  object.surface = &asset().spline;
  object.material = {1000, 2};
  measure<scene::SplineTouch>(
      "scene/spline_contact.hpp", object.surface->head(), 8,
      [](uint32_t, const scene::SplineTouch&) {},
      [&](scene::SplineTouch& touch, Vec3 at_m, servo::LocalModel& model) {
        scene::touch_spline(object, 0.003f, at_m, kBudget, touch, model);
      },
      [&](scene::SplineTouch& touch, Vec3 at_m) {
        touch.closest = spline::closest_point(*object.surface, at_m, kBudget, touch.hint);
      });
}

void measure_curve_guide() {
  scene::CurveGuide guide;
  guide.curve = &asset().curve;
  guide.material = {500, 1};
  const curve::Head& head = guide.curve->head();
  guide.snap_m = 0.05f * head.diagonal_m;
  guide.release_m = 0.1f * head.diagonal_m;
  guide.tunnel_m = 0.001f * head.diagonal_m;
  guide.arc_penalty = 0.1f;
  guide.free_side = {0, 0, 1};
  const curve::Hold hold{guide.arc_penalty * head.length_m, guide.release_m};
  constexpr scene::Drive::Kind kKinds[] = {scene::Drive::Kind::kFree, scene::Drive::Kind::kPush,
                                           scene::Drive::Kind::kLead};
  measure<scene::CurveGuideTouch>(
      "scene/curve_guide.hpp", head, 9,
      [&](uint32_t i, const scene::CurveGuideTouch&) {
        guide.drive = {kKinds[i / 64 % 3], 1, 0.1f, 0.001f};
        guide.ends = i / 256 % 2 == 0 ? scene::Ends::kContinue : scene::Ends::kHold;
      },
      [&](scene::CurveGuideTouch& touch, Vec3 at_m, servo::LocalModel& model) {
        scene::follow_curve(guide, at_m, kBudget, touch, model);
      },
      [&](scene::CurveGuideTouch& touch, Vec3 at_m) {
        touch.following.is_following = touch.is_held;
        touch.closest = curve::follow(*guide.curve, at_m, hold, kBudget, touch.following).closest;
      });
}

void measure_textures() {
  const scene::StoredMaterials& materials = asset().materials;
  const scene::TextureLayout& waves = materials.textures()[1];
  const scene::ReliefLayout& relief = materials.reliefs()[2];
  Random random(11);
  Worst wave, map, bounds;
  scene::Cut cut;
  for (uint32_t i = 0; i < kTicks; ++i) {
    const Vec3 at_m = random.cube() * random.scale(1e-3f, 12);
    const uint32_t both = instructions_of([&] { cut = scene::cut_at(waves, at_m); });
    wave.take((both + 1) / 2);
    map.of([&] {
      cut = {};
      scene::add_relief(relief, materials.samples().data(), at_m, cut);
    });
    asm volatile("" ::"r"(&cut) : "memory");
  }
  scene::ReliefBounds most;
  const uint32_t samples = relief.side * relief.side;
  bounds.take(
      (instructions_of([&] { most = scene::bounds_of(relief, materials.samples().data()); }) +
       samples - 1) /
      samples);
  asm volatile("" ::"r"(&most) : "memory");
  print_figure("scene/texture.hpp", wave);
  print_figure("scene/relief.hpp", map);
  print_figure("scene/relief.hpp", bounds);
}

void measure_stored() {
  alignas(16) static scene::ObjectLayout objects[scene::kMaxObjects];
  for (uint32_t i = 0; i < scene::kMaxObjects; ++i) {
    scene::ObjectLayout& object = objects[i];
    for (uint32_t k = 0; k + 1 < scene::kNameBytes; ++k)
      object.name[k] = object.mesh[k] =
          static_cast<char>(k + 2 == scene::kNameBytes ? 'a' + i : 'n');
    for (uint32_t k = 0; k < 9; k += 4) object.rotation[k] = 1;
    object.stiffness_N_per_m = FLT_MAX;
  }
  alignas(16) static scene::SphereLayout spheres[scene::kMaxSpheres];
  Worst all_objects, all_spheres, moved;
  core::Verdict verdict;
  scene::StoredObjects stored;
  scene::StoredTool tool;
  all_objects.of([&] {
    verdict = scene::open({reinterpret_cast<const uint8_t*>(objects), sizeof objects}, stored);
  });
  if (!verdict.ok()) hal::board_print("the objects are refused\n");
  all_spheres.of([&] {
    verdict = scene::open({reinterpret_cast<const uint8_t*>(spheres), sizeof spheres}, tool);
  });
  if (!verdict.ok()) hal::board_print("the tool is refused\n");
  Random random(12);
  scene::Object object;
  for (uint32_t i = 0; i < kTicks; ++i) {
    if (i % 100 == 0) {
      object.twist = {random.cube() * random.scale(1e-3f, 10),
                      random.cube() * random.scale(1e-3f, 19)};
      object.pose.translation_m = random.cube() * 9.0f;
    }
    moved.of([&] { scene::advance(object, 0.001f); });
    asm volatile("" ::"r"(&object) : "memory");
  }
  print_figure("scene/stored_objects.hpp", all_objects);
  print_figure("scene/stored_tool.hpp", all_spheres);
  print_figure("scene/object.hpp", moved);
}

}  // namespace

void measure_scene() {
  measure_mesh_contact();
  measure_spline_contact();
  measure_curve_guide();
  measure_textures();
  measure_stored();
}

}  // namespace firmtouch::target
