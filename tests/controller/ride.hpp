#pragma once
// A baked part with its guide, and a tool that rides along: what the controller's host tests stand
// on.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

#include "bake/asset/asset_writer.hpp"
#include "bake/asset/probes.hpp"
#include "bake/curve/bake_curve.hpp"
#include "bake/field/bake_field.hpp"
#include "bake/mesh/bake_mesh.hpp"
#include "firmtouch/controller/full_controller.hpp"
#include "firmtouch/curve/layout.hpp"
#include "firmtouch/servo/fault.hpp"
#include "harness/test.hpp"
#include "surface/make/make_part.hpp"

namespace firmtouch::controller_test {

// An asset in memory at an address that is a multiple of 16.
struct Asset {
  std::vector<uint8_t> storage;
  uint8_t* begin = nullptr;
  uint32_t size = 0;
  explicit Asset(const std::vector<uint8_t>& bytes) : storage(bytes.size() + 16) {
    const auto address = reinterpret_cast<uintptr_t>(storage.data());
    begin = storage.data() + (16 - address % 16) % 16;
    size = static_cast<uint32_t>(bytes.size());
    std::memcpy(begin, bytes.data(), bytes.size());
  }
  Asset(const Asset&) = delete;
  core::Bytes bytes() const { return {begin, size}; }
};

inline std::vector<tools::Section> mesh_sections(const tools::Surface& surface,
                                                 const std::string& name) {
  tools::MeshReport report;
  std::vector<tools::Section> sections = tools::bake_mesh(surface, name, {}, report);
  CHECK(report.problem.empty());
  mesh::View view;
  CHECK(tools::open_baked(sections, name, view).ok());
  sections.push_back(tools::mesh_probes(view, name));
  return sections;
}

inline std::vector<tools::Section> part_sections() {
  return mesh_sections(tools::make_part(1, 4000), "part");
}

inline std::vector<tools::Section> path_sections() {
  tools::CurvePoints points;
  points.samples_m = tools::make_path(1, 400);
  for (uint32_t i = 0; i < points.samples_m.size(); ++i) points.rows.push_back(i);
  tools::CurveReport report;
  std::vector<tools::Section> sections = tools::bake_curve(points, "path", report);
  CHECK(report.problem.empty());
  curve::View view;
  CHECK(tools::open_baked(sections, "path", view).ok());
  sections.push_back(tools::curve_probes(view, "path"));
  return sections;
}

// Of the part: proven against `part`, which holds its sections.
inline std::vector<tools::Section> distance_field_sections(
    const std::vector<tools::Section>& part) {
  mesh::View view;
  CHECK(tools::open_baked(part, "part", view).ok());
  tools::FieldReport report;
  std::vector<tools::Section> sections = tools::bake_field(view, "part", 16, report);
  CHECK(report.problem.empty());
  return sections;
}

inline std::vector<tools::Section> both_sections() {
  std::vector<tools::Section> sections = part_sections();
  for (tools::Section& section : path_sections()) sections.push_back(std::move(section));
  return sections;
}

inline std::vector<uint8_t> file_of(std::vector<tools::Section> sections) {
  const tools::AssetFile file = tools::write_asset(std::move(sections));
  CHECK(file.problem.empty());
  return file.bytes;
}

inline const Asset& both() {
  static const Asset made(file_of(both_sections()));
  return made;
}

// A tool that follows the guide's samples while it bobs up and down, so that it is in contact, on
// the guide, and free.
struct Ride {
  FullController controller;
  record::TickInput input{};
  record::TickOutput output{};
  std::vector<math::Vec3> path = tools::make_path(1, 400);
  explicit Ride(const Asset& from = both(), Selection selection = {}) {
    CHECK_EQ(controller.open(from.bytes(), selection).rule, 0u);
  }

  void fill(uint32_t tick) {
    const double along = 0.02 * tick;
    const size_t i = static_cast<size_t>(along) % (path.size() - 1);
    const double t = along - std::floor(along);
    const double lift = 0.004 * std::sin(0.011 * tick) - 0.001;
    const auto mix = [t](float a, float b) {
      return static_cast<double>(a) * (1 - t) + static_cast<double>(b) * t;
    };
    const double p_m[3] = {mix(path[i].x, path[i + 1].x), mix(path[i].y, path[i + 1].y),
                           mix(path[i].z, path[i + 1].z) + lift};
    input = {};
    input.tick = tick;
    input.clock_us = 4294900000u + tick * 1000u;  // wraps early on
    input.flags = tick < 10 ? 0 : record::kFlagEnable;
    for (int k = 0; k < 3; ++k)
      input.encoder_counts[k] = static_cast<int32_t>(std::lround(p_m[k] * 100000));
  }
  void step() {
    std::memset(&output, 0xA5, sizeof output);  // a tick writes all of it
    controller.tick(input, output);
  }
  // In tick `tick`, with the motors disabled.
  void clear_faults(uint32_t tick) {
    fill(tick);
    input.flags = 0;
    input.command = record::kCommandClearFaults;
    step();
  }
  void run(uint32_t from, uint32_t to) {
    for (uint32_t tick = from; tick < to; ++tick) fill(tick), step();
  }
};

inline double size_of(const float (&a)[3]) {
  return std::hypot(static_cast<double>(a[0]), static_cast<double>(a[1]),
                    static_cast<double>(a[2]));
}

/// Rides both with the inputs that fill(a, tick) gives to the first.
/// Result: ticks after which their outputs differ by a bit.
template <class Fill>
uint32_t differing_ticks(Ride& a, Ride& b, uint32_t ticks, const Fill& fill) {
  uint32_t differ = 0;
  for (uint32_t tick = 0; tick < ticks; ++tick) {
    fill(a, tick);
    b.input = a.input;
    a.step();
    b.step();
    if (std::memcmp(&a.output, &b.output, sizeof a.output) != 0) ++differ;
  }
  return differ;
}

/// Works an asset to its end in slices of `units`.
/// Result: slices after which the curve was proven and the part of `is_open()` was not yet.
template <class AnyController, class IsOpen>
uint32_t slices_behind_the_curve(AnyController& controller, uint32_t units, const IsOpen& is_open) {
  uint32_t slices = 0;
  while (!controller.work(units)) slices += controller.curve().is_open() && !is_open() ? 1u : 0u;
  CHECK(controller.verdict().ok() && is_open());
  return slices;
}

/// Enables the motors of a controller whose asset was rejected, for one tick.
/// Result: the faults; the motors are checked to be without force.
template <class AnyController>
uint32_t faults_when_enabled(AnyController& controller) {
  record::TickInput input{};
  input.flags = record::kFlagEnable;
  record::TickOutput output;
  controller.tick(input, output);
  CHECK_EQ(size_of(output.motor_N), 0.0);
  return output.faults;
}

inline bool all_finite(const record::TickOutput& o) {
  const auto is_finite = [](float value) { return std::isfinite(value); };
  const std::initializer_list<float> bounds = {o.distance_m,    o.distance_lower_m,
                                               o.penetration_m, o.guide_deviation_m,
                                               o.guide_lower_m, o.guide_arc};
  if (!std::all_of(bounds.begin(), bounds.end(), is_finite)) return false;
  for (const float* vector :
       {o.motor_N, o.position_m, o.velocity_mps, o.force_N, o.proxy_m, o.torque_Nm})
    if (!std::all_of(vector, vector + 3, is_finite)) return false;
  return true;
}

/// Ticks of a log of which this controller, opened and not run, gives other bits.
template <class AnyController>
uint32_t differing_ticks(AnyController& again, const std::vector<record::TickRecord>& log) {
  uint32_t differing = 0;
  for (const record::TickRecord& tick : log) {
    record::TickOutput output;
    again.tick(tick.input, output);
    differing += std::memcmp(&output, &tick.output, sizeof output) != 0 ? 1u : 0u;
  }
  return differing;
}

}  // namespace firmtouch::controller_test
