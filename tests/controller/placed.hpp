#pragma once
// A box, and a controller whose tool is put somewhere in each tick: what the tests of objects and
// of tools stand on.
#include <algorithm>

#include "controller/ride.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/stored_objects.hpp"

namespace firmtouch::controller_test {

constexpr float kHalf_m = 0.02f;  // of the box

inline double wide(float value) { return static_cast<double>(value); }

// A box about the origin with 12 triangles.
inline std::vector<tools::Section> box_sections(const std::string& name) {
  tools::Surface surface;
  for (int i = 0; i < 8; ++i)
    surface.vertices.push_back({(i & 1) != 0 ? kHalf_m : -kHalf_m,
                                (i & 2) != 0 ? kHalf_m : -kHalf_m,
                                (i & 4) != 0 ? kHalf_m : -kHalf_m});
  const uint32_t corners[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                   {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                   {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (uint32_t i = 0; i < 12; ++i) {
    surface.faces.push_back({{corners[i][0], corners[i][1], corners[i][2]}});
    surface.source.push_back(i);
  }
  return mesh_sections(surface, name);
}

// An object of an asset.
struct Named {
  const char *name, *mesh;
  math::Vec3 at_m;
  float stiffness_N_per_m = 1e30f;
  math::Vec3 velocity_mps = {};
  float friction = 0;
};

inline scene::ObjectLayout layout_of(const Named& named) {
  scene::ObjectLayout layout = {};
  std::strcpy(layout.name, named.name);
  std::strcpy(layout.mesh, named.mesh);
  layout.rotation[0] = layout.rotation[4] = layout.rotation[8] = 1;
  const auto put = [](float(&to)[3], math::Vec3 v) { to[0] = v.x, to[1] = v.y, to[2] = v.z; };
  put(layout.at_m, named.at_m);
  put(layout.velocity_mps, named.velocity_mps);
  layout.stiffness_N_per_m = named.stiffness_N_per_m;
  layout.friction_static = layout.friction_dynamic = named.friction;
  return layout;
}

inline std::vector<uint8_t> scene_with(const std::vector<Named>& named,
                                       const std::vector<std::string>& meshes = {"box"}) {
  std::vector<tools::Section> sections;
  for (const std::string& mesh : meshes)
    for (tools::Section& section : box_sections(mesh)) sections.push_back(std::move(section));
  std::vector<scene::ObjectLayout> objects;
  for (const Named& one : named) objects.push_back(layout_of(one));
  sections.push_back(tools::make_section(scene::kObjectsSection, "room", objects));
  return file_of(std::move(sections));
}

// A controller whose tool is at a given place in each tick, counted in 10 um.
template <class Controller>
struct Placed {
  Asset asset;
  Controller controller;
  record::TickInput input{};
  record::TickOutput output{};
  uint32_t tick_number = 0, flags = 0;
  math::Vec3 place_m{0, 0, 0.1f};

  explicit Placed(const std::vector<uint8_t>& bytes) : asset(bytes) {
    CHECK_EQ(controller.open(asset.bytes()).rule, 0u);
  }
  virtual ~Placed() = default;
  // What is done behind each tick, with the output of the one before.
  virtual void ticked(const record::TickOutput&) {}

  void begin() {
    set(params::kContactStiffness, 800);
    set(params::kContactDamping, 0);
  }
  void tick(math::Vec3 at_m) {
    place_m = at_m;
    input.tick = tick_number++;
    input.clock_us = input.tick * 1000u;
    input.flags |= flags | (input.tick < 10 ? 0 : record::kFlagEnable);
    const float place[3] = {at_m.x, at_m.y, at_m.z};
    for (int k = 0; k < 3; ++k)
      input.encoder_counts[k] =
          static_cast<int32_t>(std::lround(static_cast<double>(place[k]) * 1e5));
    const record::TickOutput before = output;
    controller.tick(input, output);
    ticked(before);
    input = {};
  }
  // Whether a command is taken; else it is refused.
  bool takes(uint32_t command, float value, math::Vec3 at_m) {
    input.command = command;
    input.command_value = value;
    tick(at_m);
    const bool is_taken = (output.state & record::kStateCommandTaken) != 0;
    CHECK(is_taken != ((output.state & record::kStateCommandRefused) != 0));
    return is_taken;
  }
  void set(params::Index index, float value) { CHECK(takes(1 + index, value, place_m)); }
  void stay(uint32_t ticks) {
    for (uint32_t i = 0; i < ticks; ++i) tick(place_m);
  }
  // From where it is, in a straight line.
  void go(math::Vec3 to_m, uint32_t ticks) {
    const math::Vec3 from_m = place_m;
    for (uint32_t i = 1; i <= ticks; ++i)
      tick(from_m + (to_m - from_m) * (static_cast<float>(i) / static_cast<float>(ticks)));
  }
};

// A ride on the part: the largest difference of a force with `section` in the asset from that of
// the mesh alone. Without it `Controller` gives FullController's bits.
template <class Controller>
double off_the_mesh_N(tools::Section section) {
  std::vector<tools::Section> sections = part_sections();
  const Asset alone(file_of(sections));
  sections.push_back(std::move(section));
  const Asset with_section(file_of(std::move(sections)));
  Ride ride(alone);
  static Controller controller, same;
  CHECK_EQ(controller.open(with_section.bytes()).rule, 0u);
  CHECK_EQ(same.open(alone.bytes()).rule, 0u);
  double worst_N = 0;
  uint32_t contacts = 0;
  for (uint32_t tick = 0; tick < 6000; ++tick) {
    ride.fill(tick);
    ride.step();
    record::TickOutput output, as_mesh;
    controller.tick(ride.input, output);
    same.tick(ride.input, as_mesh);
    CHECK(std::memcmp(&as_mesh, &ride.output, sizeof as_mesh) == 0);
    for (int k = 0; k < 3; ++k)
      worst_N =
          std::max(worst_N, std::fabs(wide(output.force_N[k]) - wide(ride.output.force_N[k])));
    contacts += (output.state & record::kStateContact) != 0 ? 1u : 0u;
  }
  CHECK_GE(contacts, 1000u);
  return worst_N;
}

}  // namespace firmtouch::controller_test
