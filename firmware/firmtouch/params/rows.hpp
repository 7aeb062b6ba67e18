#pragma once
#include "firmtouch/params/entry.hpp"

// The rows of the library's own parts. The initial values are of a table-top device that a hand can
// stop: 8 N, 1 kHz. With 75 g and 0.5 N s/m of its own, such a device is stable to 1,000 N/m
// without virtual damping (Colgate & Schenkel 1994: b > K T / 2).
namespace firmtouch::params {

constexpr float kInitialTickPeriod_s = 0.001f;

/// Most instructions of a Cortex-M7 that a tick takes for each unit of tick_work, base hulls apart.
constexpr float kInstructionsAUnit = 230.0f;
/// These units of tick_work hold what it takes beside those of its queries: 5,000, a proxy's own
/// 60,000 (scene/proxy.hpp), its four queries with 11,000 each, one of a guide with 14,000
/// (query/README.md).
constexpr float kFixedTickWork = 535.0f;

/// Limits of force and time: servo, guard and clock.
struct SafetyRows {
  static constexpr Entry kRows[] = {
      {kForceLimit, "force_limit_N", "N", 0.0f, kMaxForceLimit_N, 8.0f, When::kMayFall,
       "largest force at the tool"},
      {kSlewLimit, "slew_limit_N_per_s", "N/s", 1.0f, kMaxSlewLimit_N_per_s, 5000.0f,
       When::kMayFall, "fastest change of the force"},
      {kRampIn, "ramp_in_s", "s", 0.0f, 10.0f, 0.2f, When::kAnytime,
       "time from enable to full force"},
      {kTickPeriod, "tick_period_s", "s", 0.00005f, kMaxTickPeriod_s, kInitialTickPeriod_s,
       When::kMotorsOff, "time between ticks; the timer follows it"},
      {kLateRatio, "late_ratio", "1", 1.05f, 4.0f, 1.5f, When::kAnytime,
       "periods after which a tick is late"},
      {kModelAge, "model_age", "1", 1.0f, 1000.0f, 3.0f, When::kAnytime,
       "ticks that a local model is valid"},
      {kTickWork, "tick_work", "1", kFixedTickWork + 1.0f, 65536.0f, 1000.0f, When::kMayFall,
       "work of a tick, 535 of it fixed"},
      {kEnergyReservoir, "energy_reservoir_J", "J", 0.0f, kMaxReservoir_J, 0.0006f, When::kMayFall,
       "energy that contact and guide may give"},
      {kDeviceDamping, "device_damping_N_s_per_m", "N s/m", 0.0f, 50.0f, 0.5f, When::kMayFall,
       "damping of the device itself, or less"},
  };
};

/// A Cartesian device of three axes.
struct DeviceRows {
  static constexpr Entry kRows[] = {
      {kVelocityFilter, "velocity_filter_Hz", "Hz", 1.0f, 10000.0f, 150.0f, When::kAnytime,
       "cut-off of velocity estimator 1"},
      {kVelocityEstimator, "velocity_estimator", "1", 0.0f, 2.0f, 2.0f, When::kAnytime,
       "0: two samples, 1: low-pass, 2: tracking line"},
      {kMaxSpeed, "max_speed_mps", "m/s", 0.01f, 100.0f, 5.0f, When::kAnytime,
       "a faster encoder is rejected"},
      {kCountsPerMetreX, "counts_per_metre_x", "1/m", 100.0f, 1e8f, 100000.0f, When::kMotorsOff,
       "encoder of the x axis"},
      {kCountsPerMetreY, "counts_per_metre_y", "1/m", 100.0f, 1e8f, 100000.0f, When::kMotorsOff,
       "encoder of the y axis"},
      {kCountsPerMetreZ, "counts_per_metre_z", "1/m", 100.0f, 1e8f, 100000.0f, When::kMotorsOff,
       "encoder of the z axis"},
      {kOriginX, "origin_x_m", "m", -10.0f, 10.0f, 0.0f, When::kMotorsOff,
       "position at a count of 0"},
      {kOriginY, "origin_y_m", "m", -10.0f, 10.0f, 0.0f, When::kMotorsOff,
       "position at a count of 0"},
      {kOriginZ, "origin_z_m", "m", -10.0f, 10.0f, 0.0f, When::kMotorsOff,
       "position at a count of 0"},
      {kWorkspaceHalfX, "workspace_half_x_m", "m", 0.001f, 10.0f, 0.5f, When::kMotorsOff,
       "reach about the origin"},
      {kWorkspaceHalfY, "workspace_half_y_m", "m", 0.001f, 10.0f, 0.5f, When::kMotorsOff,
       "reach about the origin"},
      {kWorkspaceHalfZ, "workspace_half_z_m", "m", 0.001f, 10.0f, 0.5f, When::kMotorsOff,
       "reach about the origin"},
  };
};

/// Where the scene is in the device frame.
struct SceneRows {
  static constexpr Entry kRows[] = {
      {kSceneX, "scene_x_m", "m", -10.0f, 10.0f, 0.0f, When::kMotorsOff,
       "position of the model's origin"},
      {kSceneY, "scene_y_m", "m", -10.0f, 10.0f, 0.0f, When::kMotorsOff,
       "position of the model's origin"},
      {kSceneZ, "scene_z_m", "m", -10.0f, 10.0f, 0.0f, When::kMotorsOff,
       "position of the model's origin"},
  };
};

/// Contact with a surface of any kind.
struct ContactRows {
  static constexpr Entry kRows[] = {
      {kToolRadius, "tool_radius_m", "m", 0.0f, 0.1f, 0.003f, When::kAnytime,
       "radius of the tool's tip"},
      {kContactStiffness, "contact_stiffness_N_per_m", "N/m", 0.0f, 20000.0f, 800.0f,
       When::kAnytime, "stiffness of the surface"},
      {kContactDamping, "contact_damping_N_s_per_m", "N s/m", 0.0f, 100.0f, 1.0f, When::kAnytime,
       "damping of the surface"},
      {kMeshWork, "mesh_work", "1", 0.0f, 65536.0f, 640.0f, When::kMayFall,
       "work of surface queries a tick"},
  };
};

/// Friction of a surface; contact through a proxy has it.
struct FrictionRows {
  static constexpr Entry kRows[] = {
      {kFrictionStatic, "friction_static", "1", 0.0f, 10.0f, 0.0f, When::kAnytime,
       "friction at rest, over the normal force"},
      {kFrictionDynamic, "friction_dynamic", "1", 0.0f, 10.0f, 0.0f, When::kAnytime,
       "friction of a slide"},
      {kFrictionSpeed, "friction_speed_mps", "m/s", 0.0001f, 10.0f, 0.001f, When::kAnytime,
       "above it friction is dynamic"},
      {kFrictionViscous, "friction_viscous_N_s_per_m", "N s/m", 0.0f, 100.0f, 0.0f, When::kAnytime,
       "friction per speed"},
  };
};

/// Force shading over edges; contact through a proxy has it.
struct ShadingRows {
  static constexpr Entry kRows[] = {
      {kContactShading, "contact_shading_m", "m", 0.0f, 0.1f, 0.0f, When::kAnytime,
       "convex edges turn the force as this radius, for F r a^2 / 2; 0: at once"},
  };
};

/// Spline surfaces.
struct SheetRows {
  static constexpr Entry kRows[] = {
      {kSurfaceClosed, "surface_closed", "1", 0.0f, 1.0f, 0.0f, When::kAnytime,
       "spline surfaces: 0: sheets with a free side, 1: a solid"},
      {kSurfaceTurned, "surface_turned", "1", 0.0f, 1.0f, 0.0f, When::kAnytime,
       "free side of spline surfaces: 0: along their normals, 1: the other"},
  };
};

/// A guide along a curve of any kind.
struct GuideRows {
  static constexpr Entry kRows[] = {
      {kGuideStiffness, "guide_stiffness_N_per_m", "N/m", 0.0f, 20000.0f, 400.0f, When::kAnytime,
       "stiffness across the guide"},
      {kGuideDamping, "guide_damping_N_s_per_m", "N s/m", 0.0f, 100.0f, 1.0f, When::kAnytime,
       "damping across the guide"},
      {kGuideSnap, "guide_snap_m", "m", 0.0f, 1.0f, 0.005f, When::kAnytime,
       "a tool nearer than this is held"},
      {kGuideRelease, "guide_release_m", "m", 0.0f, 1.0f, 0.015f, When::kAnytime,
       "a held tool farther than this is released"},
      {kGuideArcPenalty, "guide_arc_penalty", "1", 0.0f, 100.0f, 0.1f, When::kAnytime,
       "cost of a jump along the guide, per metre; 0: the nearest part"},
      {kGuideTunnel, "guide_tunnel_m", "m", 0.0f, 1.0f, 0.0f, When::kAnytime,
       "no force nearer to the guide than this"},
      {kGuideSideX, "guide_side_x", "1", -1.0f, 1.0f, 0.0f, When::kAnytime,
       "free side of the guide, x; 0, 0, 0: it pulls from all sides"},
      {kGuideSideY, "guide_side_y", "1", -1.0f, 1.0f, 0.0f, When::kAnytime,
       "free side of the guide, y"},
      {kGuideSideZ, "guide_side_z", "1", -1.0f, 1.0f, 0.0f, When::kAnytime,
       "free side of the guide, z"},
      {kGuideEnds, "guide_ends", "1", 0.0f, 2.0f, 0.0f, When::kAnytime,
       "at its ends: 0: hold, 1: release, 2: go on at the other end"},
      {kGuideDrive, "guide_drive", "1", 0.0f, 2.0f, 0.0f, When::kAnytime,
       "along the guide: 0: free, 1: push by its force, 2: lead at its speed"},
      {kGuideDriveForce, "guide_drive_force_N", "N", -20.0f, 20.0f, 1.0f, When::kAnytime,
       "force of a push, largest of a lead"},
      {kGuideDriveSpeed, "guide_drive_speed_mps", "m/s", -1.0f, 1.0f, 0.0f, When::kAnytime,
       "speed of a lead; 0: hold"},
      {kGuideWork, "guide_work", "1", 0.0f, 65536.0f, 640.0f, When::kMayFall,
       "work of guide queries a tick"},
  };
};

}  // namespace firmtouch::params
