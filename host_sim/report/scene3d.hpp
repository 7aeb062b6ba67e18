#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "host_sim/plant/environment.hpp"
#include "host_sim/plant/turning_tool.hpp"
#include "host_sim/plant/vec.hpp"
#include "host_sim/report/held_proxy.hpp"
#include "host_sim/report/image.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

/// A polyline of the 3D view. `values` (optional): one per point, 0 to 1, to colour it by force.
struct Path {
  std::string key;  // names its colour in the style sheet and its check box in the legend
  std::string label;
  Colour colour;
  double width = 2;         // pixels
  std::vector<Vec> points;  // NaN in x: the line is interrupted
  std::vector<double> values;
  bool has_joints = false;  // a disc at each point
};

/// An object of the 3D view: its triangles stand together.
struct ShownObject {
  std::string name;
  uint32_t end = 0;    // behind its last triangle
  uint32_t ticks = 0;  // in which it held the tool; 0: not touched
};

/// A material of the mesh's triangles.
struct TouchedMaterial {
  std::string name;
  uint32_t ticks;  // in which it held the tool, motors on
};

/// Content of the 3D view: surface and paths, for the report's viewer and the drawn picture.
struct Scene3d {
  std::vector<Vec> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
  uint32_t source_triangles = 0;     // before simplification for display
  std::vector<ShownObject> objects;  // empty: one surface
  std::vector<TouchedMaterial> materials;
  std::vector<Path> paths;
  Vec centre;
  double radius_m = 0.1;  // of the bounding sphere about `centre`
  double tool_radius_m = 0;
  std::vector<PlacedSphere> spheres;  // of the tool, about its handle; empty: one of tool_radius_m
};

/// The surface alone.
Scene3d surface_scene(const Environment& environment, double tool_radius_m);

/// Samples of a run for the 3D view, gathered while it goes on. Bounded memory.
class RunPaths {
 public:
  /// `scenario` and `facts` outlive this.
  RunPaths(const Environment& environment, const Scenario& scenario, const RunFacts& facts);
  /// `held`: HeldProxies::after() of the tick.
  void add(const RunTick& tick, const HeldProxy& held = {});

  struct Sample {
    Vec device_m, tool_m, target_m, force_N;
    Vec proxy_m;
    bool touches = false;
    Vec turn_rad = {};  // of a tool of spheres
    HeldProxy held = {};
  };
  const std::vector<Sample>& samples() const { return samples_; }
  uint32_t ticks_per_sample() const { return stride_; }
  double peak_N() const { return peak_N_; }
  /// Of the device at the largest force.
  Vec peak_device_m() const { return peak_device_m_; }
  /// Where the objects are then.
  const std::vector<PlacedMesh>& peak_meshes() const { return peak_meshes_; }
  /// Spheres of the tool then, about its handle.
  const std::vector<PlacedSphere>& peak_spheres() const { return peak_spheres_; }
  /// Ticks with the motors on in which each object held the tool; each material, if there are any.
  const std::vector<uint32_t>& held_ticks() const { return held_ticks_; }
  /// Joints of a linkage (device/drawn_links.hpp), sample by sample; empty: there is none.
  const std::vector<Vec>& joints_m() const { return joints_m_; }
  /// The same at the largest force.
  const std::vector<Vec>& peak_joints_m() const { return peak_joints_m_; }
  /// First sample of which the scenario's parameters are set.
  size_t first() const;

 private:
  const RunFacts& facts_;
  uint32_t stride_, ticks_ = 0;
  std::vector<Sample> samples_;
  double peak_N_ = 1e-9;
  Vec peak_device_m_;
  MovingMeshes moving_;
  TurningTool tool_;
  std::vector<PlacedMesh> peak_meshes_;
  std::vector<PlacedSphere> peak_spheres_;
  uint32_t held_shift_, held_mask_;  // of the record's state
  std::vector<uint32_t> held_ticks_;
  const tools::LinkageDevice* linkage_;
  std::vector<Vec> joints_m_, peak_joints_m_;
};

/// The surface with the paths of a run.
Scene3d make_scene3d(const Environment& environment, const RunPaths& run, double tool_radius_m);

/// Of a triangle: blue for an object that was touched, grey for others.
Colour part_colour(const Scene3d& scene3d, uint32_t triangle);

/// Colours a force from none (0) to the run's largest (1).
Colour heat(double share);

/// Draws the scene in the viewer's initial view: orthographic, z up, with depth test.
/// The tool is drawn at `tool_m` if its x is finite.
Image draw(const Scene3d& scene3d, uint32_t width, uint32_t height, Colour background, Vec tool_m);

}  // namespace firmtouch::host_sim
