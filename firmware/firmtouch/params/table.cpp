#include "firmtouch/params/table.hpp"

#include "firmtouch/core/hash.hpp"

namespace firmtouch::params {

// The initial values are of a table-top device that a hand can stop: 8 N, 1 kHz. With 75 g and 0.5
// N s/m of its own, such a device is stable to 1,000 N/m without virtual damping (Colgate &
// Schenkel 1994: b > K T / 2).
extern constexpr Entry kTable[kCount] = {
    {"tool_radius_m", "m", 0.0f, 0.1f, 0.003f, When::kAnytime, "sphere at the tool's tip"},
    {"contact_stiffness_N_per_m", "N/m", 0.0f, 20000.0f, 800.0f, When::kAnytime, "of the surface"},
    {"contact_damping_N_s_per_m", "N s/m", 0.0f, 100.0f, 1.0f, When::kAnytime, "of the surface"},
    {"guide_stiffness_N_per_m", "N/m", 0.0f, 20000.0f, 400.0f, When::kAnytime, "across the guide"},
    {"guide_damping_N_s_per_m", "N s/m", 0.0f, 100.0f, 1.0f, When::kAnytime, "across the guide"},
    {"guide_snap_m", "m", 0.0f, 1.0f, 0.005f, When::kAnytime,
     "nearer than this: the guide takes hold"},
    {"guide_release_m", "m", 0.0f, 1.0f, 0.015f, When::kAnytime, "farther than this: it lets go"},
    {"force_limit_N", "N", 0.0f, kMaxForceLimit_N, 8.0f, When::kMayFall,
     "the most force at the tool"},
    {"slew_limit_N_per_s", "N/s", 1.0f, kMaxSlewLimit_N_per_s, 5000.0f, When::kMayFall,
     "the fastest change of force"},
    {"ramp_in_s", "s", 0.0f, 10.0f, 0.2f, When::kAnytime, "from enable to full force"},
    {"velocity_filter_Hz", "Hz", 1.0f, 10000.0f, 150.0f, When::kAnytime,
     "cut-off of the velocity estimate"},
    {"tick_period_s", "s", 0.00005f, kMaxTickPeriod_s, 0.001f, When::kMotorsOff,
     "nominal time between ticks; a board's timer keeps the initial one"},
    {"late_ratio", "1", 1.05f, 4.0f, 1.5f, When::kAnytime,
     "a tick that took longer, in periods, is late"},
    {"max_speed_mps", "m/s", 0.01f, 100.0f, 5.0f, When::kAnytime,
     "a faster jump of an encoder is not believed"},
    {"counts_per_metre_x", "1/m", 100.0f, 1e8f, 100000.0f, When::kMotorsOff,
     "encoder of the x axis"},
    {"counts_per_metre_y", "1/m", 100.0f, 1e8f, 100000.0f, When::kMotorsOff,
     "encoder of the y axis"},
    {"counts_per_metre_z", "1/m", 100.0f, 1e8f, 100000.0f, When::kMotorsOff,
     "encoder of the z axis"},
    {"origin_x_m", "m", -10.0f, 10.0f, 0.0f, When::kMotorsOff, "position at a count of 0"},
    {"origin_y_m", "m", -10.0f, 10.0f, 0.0f, When::kMotorsOff, "position at a count of 0"},
    {"origin_z_m", "m", -10.0f, 10.0f, 0.0f, When::kMotorsOff, "position at a count of 0"},
    {"workspace_half_x_m", "m", 0.001f, 10.0f, 0.5f, When::kMotorsOff, "reach about the origin"},
    {"workspace_half_y_m", "m", 0.001f, 10.0f, 0.5f, When::kMotorsOff, "reach about the origin"},
    {"workspace_half_z_m", "m", 0.001f, 10.0f, 0.5f, When::kMotorsOff, "reach about the origin"},
    {"scene_x_m", "m", -10.0f, 10.0f, 0.0f, When::kMotorsOff, "where the asset's origin lies"},
    {"scene_y_m", "m", -10.0f, 10.0f, 0.0f, When::kMotorsOff, "where the asset's origin lies"},
    {"scene_z_m", "m", -10.0f, 10.0f, 0.0f, When::kMotorsOff, "where the asset's origin lies"},
    {"mesh_steps", "1", 1.0f, 65536.0f, 256.0f, When::kAnytime, "step budget of the mesh query"},
    {"curve_steps", "1", 1.0f, 65536.0f, 256.0f, When::kAnytime, "step budget of the guide query"},
    {"model_age", "1", 1.0f, 1000.0f, 3.0f, When::kAnytime, "ticks that a local model lives"},
    {"guide_arc_penalty", "1", 0.0f, 100.0f, 0.1f, When::kAnytime,
     "distance that a jump costs, a metre along the guide; 0: on to whatever part is nearest"},
    {"guide_tunnel_m", "m", 0.0f, 1.0f, 0.0f, When::kAnytime,
     "nearer than this to the guide nothing is felt"},
    {"guide_side_x", "1", -1.0f, 1.0f, 0.0f, When::kAnytime,
     "the free side of a one-sided guide; 0, 0, 0: it pulls from all sides"},
    {"guide_side_y", "1", -1.0f, 1.0f, 0.0f, When::kAnytime, "the free side, y"},
    {"guide_side_z", "1", -1.0f, 1.0f, 0.0f, When::kAnytime, "the free side, z"},
    {"guide_ends", "1", 0.0f, 2.0f, 0.0f, When::kAnytime,
     "0: it holds at its ends, 1: it lets go, 2: it goes on at the other end"},
    {"guide_drive", "1", 0.0f, 2.0f, 0.0f, When::kAnytime,
     "along the guide: 0: free, 1: pushed by guide_drive_force, 2: led at guide_drive_speed"},
    {"guide_drive_force_N", "N", -20.0f, 20.0f, 1.0f, When::kAnytime,
     "pushes along the guide; the most that leads or holds"},
    {"guide_drive_speed_mps", "m/s", -1.0f, 1.0f, 0.0f, When::kAnytime,
     "leads along the guide; 0: holds"},
    {"surface_closed", "1", 0.0f, 1.0f, 0.0f, When::kAnytime,
     "spline surfaces: 0: sheets, felt from their free side, 1: they enclose what they bound"},
    {"surface_turned", "1", 0.0f, 1.0f, 0.0f, When::kAnytime,
     "their free side: 0: to which their normals point, 1: the other one"},
};

namespace {

constexpr bool rows_are_sound() {
  for (const Entry& row : kTable) {
    if (row.name == nullptr || !(row.low < row.high)) return false;
    if (!(row.initial >= row.low) || !(row.initial <= row.high)) return false;
  }
  return true;
}
static_assert(rows_are_sound(),
              "a row of the table is missing, or its initial value is out of its range");

void add_text(core::Hash& hash, const char* text) {
  for (; *text != 0; ++text) hash.add(static_cast<unsigned char>(*text));
  hash.add(0);
}

void add_float(core::Hash& hash, float value) {
  uint32_t bits;
  __builtin_memcpy(&bits, &value, sizeof bits);
  hash.add(bits);
}

bool same(const char* a, const char* b) {
  while (*a != 0 && *a == *b) ++a, ++b;
  return *a == *b;
}

}  // namespace

Values::Values() {
  for (uint32_t i = 0; i < kCount; ++i) value[i] = kTable[i].initial;
}

bool set(Values& values, uint32_t index, float value) {
  if (index >= kCount) return false;
  if (!(value >= kTable[index].low) || !(value <= kTable[index].high)) return false;
  values.value[index] = value;
  return true;
}

uint32_t find(const char* name) {
  uint32_t i = 0;
  while (i < kCount && !same(kTable[i].name, name)) ++i;
  return i;
}

uint64_t table_hash() {
  core::Hash hash;
  for (const Entry& row : kTable) {
    add_text(hash, row.name);
    add_text(hash, row.unit);
    add_float(hash, row.low);
    add_float(hash, row.high);
    add_float(hash, row.initial);
    hash.add(static_cast<uint32_t>(row.when));
  }
  return hash.value();
}

}  // namespace firmtouch::params
