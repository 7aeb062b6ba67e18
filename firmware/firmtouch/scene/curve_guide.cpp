#include "firmtouch/scene/curve_guide.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// A shorter free_side counts as none.
constexpr float kMinSide = 1e-3f;

// No device reaches farther; NaN fails the comparison.
constexpr float kMaxReach_m = 1e4f;

float positive(float value) { return value > 0.0f ? value : 0.0f; }  // NaN too

// A unit vector perpendicular to the unit vector `u`: its cross product with the axis that it is
// least aligned with.
Vec3 any_across(Vec3 u) {
  const float x = u.x < 0.0f ? -u.x : u.x, y = u.y < 0.0f ? -u.y : u.y, z = u.z < 0.0f ? -u.z : u.z;
  const Vec3 axis = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const Vec3 side = math::cross(u, axis);
  return side * (1.0f / math::length(side));
}

// Direction in which the tool is not pulled, and whether it runs along the curve.
struct Way {
  Vec3 direction;
  bool is_along = true;
};

// The tangent, made perpendicular to the line from the closest point to the tool. Inside a segment
// it is so already; at a corner or beyond an end this makes the spring act on the whole distance.
Way free_way(const curve::Closest& c, Vec3 p_m, float diagonal_m) {
  const Vec3 off = p_m - c.point_m;
  const float size_m = math::length(off);
  if (!(size_m > 1e-5f * diagonal_m))
    return {c.tangent, true};  // too near for a direction; the force is next to 0
  const Vec3 u = off * (1.0f / size_m);
  const Vec3 turned = c.tangent - u * math::dot(c.tangent, u);
  const float turned_size = math::length(turned);
  if (turned_size > 1e-3f) return {turned * (1.0f / turned_size), true};
  return {any_across(u), false};
}

bool is_sampled(const CurveGuide& guide) {
  return guide.curve != nullptr && guide.curve->is_open();
}

// A tick's answer of a curve of either kind.
struct Found {
  bool is_new = false, is_held = false;
  bool is_closed = false;
  float moved_m = 0;                // since the last tick
  float length_m = 0;               // from end to end
  float behind_m = 0, ahead_m = 0;  // to the ends
  float size_m = 0;                 // of the curve; float32 errors are relative to it
  int end = 0;                      // as past_end()
};

// -1: beyond the first end of an open curve, 1: beyond the last one, 0: neither.
int past_end(const curve::View& curve, const curve::Closest& c, Vec3 p_m) {
  if (curve.is_closed()) return 0;
  const float beyond_m = math::dot(p_m - c.point_m, c.tangent);
  if (c.segment == 0 && !(c.arc > 0.0f) && beyond_m < 0.0f) return -1;
  return c.segment + 1 == curve.segment_count() && c.arc >= 1.0f && beyond_m > 0.0f ? 1 : 0;
}

// After a release at an end the guide takes hold again once the tool was clear of it, or came some
// way back along it.
bool stays_off(const CurveGuide& guide, const Found& found, float distance_m) {
  const float back_m = found.behind_m < found.ahead_m ? found.behind_m : found.ahead_m;
  return distance_m <= guide.snap_m &&
         !(back_m >= guide.snap_m || back_m >= 0.25f * found.length_m);
}

// Moves the guide to the other end if its sample is nearer; it acts there from the next tick on.
void go_on_at_other_end(const CurveGuide& guide, int end, Vec3 p_m, GuideTouch& touch) {
  if (!is_sampled(guide))
    return spline::go_on_at_other_end(*guide.spline, end, p_m, touch.closest.distance_m,
                                      touch.spline_following);
  const curve::View& curve = *guide.curve;
  const uint32_t last = curve.segment_count();
  const float there_m = math::length(p_m - curve.sample(end > 0 ? 0 : last));
  if (!(there_m < touch.closest.distance_m)) return;
  touch.following.arc = end > 0 ? 0.0f : 1.0f;
  touch.following.hint.segment = end > 0 ? 0 : last - 1;
}

// Whether the guide holds the tool in this tick.
bool take_hold(const CurveGuide& guide, const Found& found, GuideTouch& touch) {
  // NaN releases. The larger of snap and release counts, since a smaller release would chatter.
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

// Moves the carriage by a tick, at most as far from the tool as the largest force stretches the
// spring.
void lead(const CurveGuide& guide, const Found& found, float moved_m, float force_N,
          GuideTouch& touch) {
  const Drive& drive = guide.drive;
  const float step_m = drive.speed_mps * drive.tick_period_s;
  float ahead_m = touch.ahead_m + (step_m <= 1.0f && step_m >= -1.0f ? step_m : 0.0f) - moved_m;
  const float max_m = force_N / guide.material.stiffness_N_per_m;
  float low_m = -max_m, high_m = max_m;
  if (!found.is_closed && guide.ends != Ends::kGoOn) {  // a carriage stops at the ends
    const float back_m = -found.behind_m, on_m = found.ahead_m;
    low_m = low_m > back_m ? low_m : back_m;
    high_m = high_m < on_m ? high_m : on_m;
  }
  ahead_m = ahead_m < high_m ? ahead_m : high_m;
  touch.ahead_m = ahead_m > low_m ? ahead_m : low_m;
}

void put_drive(const CurveGuide& guide, const Found& found, float moved_m, bool is_along,
               GuideTouch& touch, servo::GuideLine& line) {
  const Drive& drive = guide.drive;
  const float size_N = drive.force_N < 0.0f ? -drive.force_N : drive.force_N;
  const float limit_N = size_N <= servo::kMaxDriveLimit_N ? size_N : 0.0f;
  if (drive.kind == Drive::Kind::kLead && guide.material.stiffness_N_per_m > 0.0f &&
      limit_N > 0.0f) {
    lead(guide, found, moved_m, limit_N, touch);
    if (!is_along) return;
    const float speed_mps =
        drive.speed_mps <= 1e3f && drive.speed_mps >= -1e3f ? drive.speed_mps : 0.0f;
    line.drive_stiffness_N_per_m = guide.material.stiffness_N_per_m;
    line.drive_damping_N_s_per_m = guide.material.damping_N_s_per_m;
    line.drive_N = guide.material.stiffness_N_per_m * touch.ahead_m +
                   guide.material.damping_N_s_per_m * speed_mps;
    line.drive_limit_N = limit_N;
    return;
  }
  touch.ahead_m = 0;
  const bool is_at_goal =
      guide.ends != Ends::kGoOn && (drive.force_N > 0.0f ? found.end > 0 : found.end < 0);
  if (drive.kind != Drive::Kind::kPush || !is_along || is_at_goal) return;
  line.drive_N = limit_N > 0.0f ? drive.force_N : 0.0f;
  line.drive_limit_N = limit_N;
}

// One-sided guide: a contact plane through the closest point, like the edge of a ruler.
void put_edge(const CurveGuide& guide, Vec3 tangent, const servo::GuideLine& line,
              servo::LocalModel& model) {
  const Vec3 normal = guide.free_side - tangent * math::dot(guide.free_side, tangent);
  const float size = math::length(normal);
  if (!(size > kMinSide)) return;  // the curve runs toward the free side
  servo::ContactPlane edge;
  edge.normal = normal * (1.0f / size);
  edge.offset_m = math::dot(edge.normal, line.point_m) - line.tunnel_m;
  edge.stiffness_N_per_m = guide.material.stiffness_N_per_m;
  edge.damping_N_s_per_m = guide.material.damping_N_s_per_m;
  (void)add_plane(model, edge);  // a model full of contacts keeps them
}

void put_line(const CurveGuide& guide, Vec3 p_m, const Found& found, float moved_m,
              GuideTouch& touch, servo::LocalModel& model) {
  const Way way = free_way(touch.closest, p_m, found.size_m);
  servo::GuideLine line;
  line.point_m = math::apply(guide.pose, touch.closest.point_m);
  line.direction = guide.pose.rotation * way.direction;
  const float tunnel_m = positive(guide.tunnel_m);
  line.tunnel_m = tunnel_m < servo::kMaxTunnel_m ? tunnel_m : servo::kMaxTunnel_m;
  put_drive(guide, found, moved_m, way.is_along, touch, line);
  const float side2 = math::dot(guide.free_side, guide.free_side);
  if (side2 >= kMinSide * kMinSide && side2 <= 1e6f) {
    put_edge(guide, guide.pose.rotation * touch.closest.tangent, line, model);
    line.tunnel_m = 0;
  } else {
    line.stiffness_N_per_m = guide.material.stiffness_N_per_m;
    line.damping_N_s_per_m = guide.material.damping_N_s_per_m;
  }
  (void)add_guide(model, line);  // a model that has a guide already keeps it
}

Found find_sampled(const CurveGuide& guide, Vec3 p_m, float release_m, query::Budget budget,
                   GuideTouch& touch) {
  const curve::View& curve = *guide.curve;
  Found found;
  found.length_m = curve.head().length_m;
  found.size_m = curve.head().diagonal_m;
  found.is_closed = curve.is_closed();
  touch.following.is_following = touch.is_held;
  const curve::Hold hold{positive(guide.arc_penalty) * found.length_m, release_m};
  const curve::Followed followed = curve::follow(curve, p_m, hold, budget, touch.following);
  touch.closest = followed.closest;
  found.is_new = followed.is_new;
  found.is_held = followed.is_held;
  found.moved_m = followed.change_of_arc * found.length_m;
  found.behind_m = touch.closest.arc * found.length_m;
  found.ahead_m = found.length_m - found.behind_m;
  found.end = past_end(curve, touch.closest, p_m);
  return found;
}

Found find_spline(const CurveGuide& guide, Vec3 p_m, float release_m, query::Budget budget,
                  GuideTouch& touch) {
  const spline::GuideView& curve = *guide.spline;
  touch.spline_following.is_following = touch.is_held;
  const spline::Hold hold{positive(guide.arc_penalty) * curve.length_m(), release_m};
  const spline::Followed followed =
      spline::follow(curve, p_m, hold, budget, touch.spline_following);
  touch.closest.distance_m = followed.closest.distance_m;
  touch.closest.point_m = followed.closest.point_m;
  touch.closest.tangent = followed.closest.direction;
  touch.closest.segment = followed.closest.bezier;
  touch.closest.arc = followed.arc;
  touch.closest.certificate = followed.closest.certificate;
  Found found;
  found.is_new = followed.is_new;
  found.is_held = followed.is_held;
  found.is_closed = followed.is_chain_closed;
  found.moved_m = followed.change_of_arc * curve.length_m();
  found.behind_m = followed.behind_m;
  found.ahead_m = followed.ahead_m;
  found.length_m = followed.behind_m + followed.ahead_m;
  found.size_m = curve.model().head().extent_m;
  found.end = followed.end;
  return found;
}

}  // namespace

void follow_curve(const CurveGuide& guide, Vec3 position_m, query::Budget budget, GuideTouch& touch,
                  servo::LocalModel& model) {
  const bool is_spline = guide.spline != nullptr && guide.spline->is_open();
  if (!is_sampled(guide) && !is_spline) {
    touch = {};
    return;
  }
  const Vec3 p_m = math::apply_inverse(guide.pose, position_m);
  const bool was_held = touch.is_held;
  const float farther_m = guide.release_m >= guide.snap_m ? guide.release_m : guide.snap_m;
  const float release_m = farther_m < kMaxReach_m ? farther_m : kMaxReach_m;
  const Found found = is_sampled(guide) ? find_sampled(guide, p_m, release_m, budget, touch)
                                        : find_spline(guide, p_m, release_m, budget, touch);
  touch.is_held = take_hold(guide, found, touch);
  const bool is_new = !was_held || found.is_new;
  if (is_new || !touch.is_held) touch.progress_m = touch.ahead_m = 0;
  if (!touch.is_held) return;
  const float moved_m = is_new ? 0.0f : found.moved_m;
  touch.progress_m += moved_m;
  put_line(guide, p_m, found, moved_m, touch, model);
  if (guide.ends == Ends::kGoOn && found.end != 0) go_on_at_other_end(guide, found.end, p_m, touch);
}

}  // namespace firmtouch::scene
