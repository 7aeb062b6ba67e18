#include "firmtouch/scene/guide_step.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// A shorter free side has no direction.
constexpr float kMinSide = 1e-3f;

// Beyond the reach of every device.
constexpr float kMaxReach_m = 1e4f;

// A unit vector at right angles to the unit vector `u`: the cross product with the axis of its
// least component.
Vec3 any_across(Vec3 u) {
  const float x = __builtin_fabsf(u.x), y = __builtin_fabsf(u.y), z = __builtin_fabsf(u.z);
  const Vec3 axis = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const Vec3 side = math::cross(u, axis);
  return side * (1.0f / math::length(side));
}

// The direction in which the tool is not pulled, and whether it is along the curve.
struct FreeDirection {
  Vec3 direction;
  bool is_along = true;
};

// The tangent, turned at right angles to the line from the closest point to the tool. On a segment
// it is so already; at a corner or past an end the whole distance counts by this.
FreeDirection free_direction(const curve::Closest& c, Vec3 p_m, float diagonal_m) {
  const Vec3 off = p_m - c.point_m;
  const float size_m = math::length(off);
  if (!(size_m > 1e-5f * diagonal_m))
    return {c.tangent, true};  // too near for a direction, and for a force
  const Vec3 u = off * (1.0f / size_m);
  const Vec3 turned = c.tangent - u * math::dot(c.tangent, u);
  const float turned_size = math::length(turned);
  if (turned_size > 1e-3f) return {turned * (1.0f / turned_size), true};
  return {any_across(u), false};
}

// A tool that was released at an end is held again once it was clear of the guide, or came back
// along it.
bool stays_off(const Guide& guide, const Found& found, float distance_m) {
  const float back_m = found.behind_m < found.ahead_m ? found.behind_m : found.ahead_m;
  return distance_m <= guide.snap_m &&
         !(back_m >= guide.snap_m || back_m >= 0.25f * found.length_m);
}

// Whether the guide holds the tool in this tick. Written so that NaN releases it.
bool holds(const Guide& guide, const Found& found, GuideTouch& touch) {
  const float distance_m = touch.closest.distance_m;
  const bool is_near = found.is_held && distance_m <= guide.snap_m;
  const bool was_held = touch.is_held && !found.is_new && found.is_held;
  if (guide.ends != Ends::kRelease) {
    touch.is_off_end = false;
    return is_near || was_held;
  }
  if (found.end != 0) {
    touch.is_off_end = (touch.is_off_end || touch.is_held) && stays_off(guide, found, distance_m);
    return false;
  }
  if (touch.is_off_end && stays_off(guide, found, distance_m)) return false;
  touch.is_off_end = false;
  return is_near || was_held;
}

// Moves the carriage, at most as far from the tool as the largest force stretches the spring.
void move_carriage(const Guide& guide, const Found& found, float moved_m, float force_N,
                   GuideTouch& touch) {
  const Drive& drive = guide.drive;
  const float step_m = drive.speed_mps * drive.tick_period_s;
  float ahead_m = touch.ahead_m + (__builtin_fabsf(step_m) <= 1.0f ? step_m : 0.0f) - moved_m;
  const float max_m = force_N / guide.material.stiffness_N_per_m;
  float low_m = -max_m, high_m = max_m;
  if (!found.is_closed && guide.ends != Ends::kContinue) {  // the carriage stops at the ends
    const float back_m = -found.behind_m, on_m = found.ahead_m;
    low_m = low_m > back_m ? low_m : back_m;
    high_m = high_m < on_m ? high_m : on_m;
  }
  ahead_m = ahead_m < high_m ? ahead_m : high_m;
  touch.ahead_m = ahead_m > low_m ? ahead_m : low_m;
}

void set_drive(const Guide& guide, const Found& found, float moved_m, bool is_along,
               GuideTouch& touch, servo::GuideLine& line) {
  const Drive& drive = guide.drive;
  const float size_N = __builtin_fabsf(drive.force_N);
  const float limit_N = size_N <= servo::kMaxDriveLimit_N ? size_N : 0.0f;
  if (drive.kind == Drive::Kind::kLead && guide.material.stiffness_N_per_m > 0.0f &&
      limit_N > 0.0f) {
    move_carriage(guide, found, moved_m, limit_N, touch);
    if (!is_along) return;
    const float speed_mps = __builtin_fabsf(drive.speed_mps) <= 1e3f ? drive.speed_mps : 0.0f;
    line.drive_stiffness_N_per_m = guide.material.stiffness_N_per_m;
    line.drive_damping_N_s_per_m = guide.material.damping_N_s_per_m;
    line.drive_N = guide.material.stiffness_N_per_m * touch.ahead_m +
                   guide.material.damping_N_s_per_m * speed_mps;
    line.drive_limit_N = limit_N;
    return;
  }
  touch.ahead_m = 0;
  const bool is_at_goal =
      guide.ends != Ends::kContinue && (drive.force_N > 0.0f ? found.end > 0 : found.end < 0);
  if (drive.kind != Drive::Kind::kPush || !is_along || is_at_goal) return;
  line.drive_N = limit_N > 0.0f ? drive.force_N : 0.0f;
  line.drive_limit_N = limit_N;
}

// The edge of a ruler: free on one side. None where the curve is along the free side.
Vec3 edge_of(Vec3 free_side, Vec3 tangent) {
  const Vec3 normal = free_side - tangent * math::dot(free_side, tangent);
  const float size = math::length(normal);
  return size > kMinSide ? normal * (1.0f / size) : Vec3{};
}

void add_line(const Guide& guide, Vec3 p_m, const Found& found, float moved_m, GuideTouch& touch,
              servo::LocalModel& model) {
  const FreeDirection unguided = free_direction(touch.closest, p_m, found.size_m);
  servo::GuideLine line;
  line.point_m = math::apply(guide.pose, touch.closest.point_m);
  line.direction = guide.pose.rotation * unguided.direction;
  line.tunnel_m = math::smaller(positive(guide.tunnel_m), servo::kMaxTunnel_m);
  set_drive(guide, found, moved_m, unguided.is_along, touch, line);
  line.stiffness_N_per_m = guide.material.stiffness_N_per_m;
  line.damping_N_s_per_m = guide.material.damping_N_s_per_m;
  const float side2 = math::dot(guide.free_side, guide.free_side);
  if (side2 >= kMinSide * kMinSide && side2 <= 1e6f) {
    // At a corner the edge is turned with the line; past an end it goes straight on.
    const Vec3 tangent =
        found.end == 0 ? line.direction : guide.pose.rotation * touch.closest.tangent;
    line.edge = edge_of(guide.free_side, tangent);
    if (!(math::dot(line.edge, line.edge) > 0.0f))
      line.stiffness_N_per_m = line.damping_N_s_per_m = 0;
  }
  (void)add_guide(model, line);  // no effect on a model that has a guide
}

}  // namespace

float positive(float value) { return math::larger(value, 0.0f); }

float release_distance_m(const Guide& guide) {
  const float farther_m = guide.release_m >= guide.snap_m ? guide.release_m : guide.snap_m;
  return farther_m < kMaxReach_m ? farther_m : kMaxReach_m;
}

int finish_guide(const Guide& guide, Vec3 p_m, const Found& found, GuideTouch& touch,
                 servo::LocalModel& model) {
  const bool was_held = touch.is_held;
  touch.is_held = holds(guide, found, touch);
  const bool is_new = !was_held || found.is_new;
  if (is_new || !touch.is_held) touch.progress_m = touch.ahead_m = 0;
  if (!touch.is_held) return 0;
  const float moved_m = is_new ? 0.0f : found.moved_m;
  touch.progress_m += moved_m;
  add_line(guide, p_m, found, moved_m, touch, model);
  return guide.ends == Ends::kContinue ? found.end : 0;
}

}  // namespace firmtouch::scene
