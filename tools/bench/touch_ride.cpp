#include "bench/touch_ride.hpp"

#include <algorithm>
#include <cmath>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/proxy.hpp"
#include "surface/random.hpp"

namespace firmtouch::bench {
namespace {

using math::Vec3;

// As the product: a tool that began too near to a surface grows by 5 mm/s while the force is below
// 1 N, which is 1 mm of a stiffness of 1,000 N/m.
constexpr double kGrowth_m = 5e-6, kGrowsWithin_m = 1e-3;
constexpr double kUsualRadius_m = 0.0005;
constexpr uint32_t kFaultTicks = 10;  // uncertain ones without a break

double wide(float a) { return static_cast<double>(a); }
double apart_m(Vec3 a, Vec3 b) {
  return std::hypot(wide(a.x) - wide(b.x), wide(a.y) - wide(b.y), wide(a.z) - wide(b.z));
}

// From place to place in 1.2 boxes, each way in steps of one length.
class Hand {
 public:
  Hand(const TouchSubject& subject, uint64_t seed)
      : random_(seed), subject_(subject), at_m_(place()) {}

  void set_step_m(double step_m) { step_m_ = step_m; }
  Vec3 next() {
    const double left_m = apart_m(at_m_, to_m_);
    if (left_m <= step_m_) {
      at_m_ = to_m_;
      to_m_ = place();
    } else {
      at_m_ = at_m_ + (to_m_ - at_m_) * static_cast<float>(step_m_ / left_m);
    }
    return at_m_;
  }

 private:
  Vec3 place() {
    const auto along = [this](float low_m, float high_m) {
      const double middle_m = (wide(low_m) + wide(high_m)) / 2;
      return static_cast<float>(middle_m +
                                random_.between(-0.6, 0.6) * (wide(high_m) - wide(low_m)));
    };
    const Vec3 low_m = subject_.low_m, high_m = subject_.high_m;
    const float x_m = along(low_m.x, high_m.x), y_m = along(low_m.y, high_m.y);
    return {x_m, y_m, along(low_m.z, high_m.z)};
  }

  tools::Random random_;
  const TouchSubject& subject_;
  Vec3 at_m_, to_m_{};
  double step_m_ = 0;
};

// A subject as a shape without free_part().
struct Bent {
  TouchSubject& subject;
  scene::Near near(Vec3 x_m, query::Budget budget, float needed_m) const {
    return subject.near(x_m, budget, needed_m);
  }
};

struct Tool {
  TouchSubject& subject;
  scene::Proxy proxy;
  scene::ProxySettings settings;
  scene::ProxyMoved moved;
  uint64_t moves = 0, crossings = 0;

  explicit Tool(TouchSubject& of) : subject(of) { subject.begin(); }

  bool is_free() const { return proxy.phase == scene::Proxy::Phase::kFree; }
  // Whether the surface keeps it from the hand. Else the hand is only ahead of it: so is one that
  // came out of the part, of a tool that begins small on the surface.
  bool is_pressed(Vec3 hand_m) const {
    return is_free() && proxy.is_loaded &&
           (subject.is_crossed(proxy.position_m, hand_m) ||
            subject.distance_m(tools::to_point(hand_m)) < wide(proxy.radius_m));
  }

  scene::Near nearest(scene::ProxyMove& move) const {
    Bent bent{subject};
    return is_mesh(subject) ? scene::nearest_of(subject, move) : scene::nearest_of(bent, move);
  }

  // Counts the moves of a certified proxy, and those that met the surface.
  void tick(Vec3 hand_m) {
    scene::ProxyMove move(settings, subject.size_m, hand_m, proxy);
    const auto note = [&](bool was_free, Vec3 from_m) {
      if (!was_free || !(apart_m(from_m, proxy.position_m) > 0)) return;
      ++moves;
      if (wide(proxy.radius_m) < subject.least_radius_m) return;
      if (subject.is_crossed(from_m, proxy.position_m)) ++crossings;
    };
    for (;;) {
      const bool was_free = is_free();
      const Vec3 from_m = proxy.position_m;
      const bool goes_on = move.aim();
      note(was_free, from_m);
      if (!goes_on) break;
      const Vec3 before_m = proxy.position_m;
      move.take(nearest(move));
      note(was_free && is_free(), before_m);
    }
    moved = move.finish();
  }
};

void count_usual(const Tool& tool, TouchSums& sums) {
  ++sums.usual;
  sums.queries += tool.moved.queries;
  sums.most_queries = std::max<uint64_t>(sums.most_queries, tool.moved.queries);
  sums.optimal += tool.moved.is_optimal;
  sums.starved += tool.moved.is_starved;
  if (!tool.proxy.is_loaded)
    ++sums.free;
  else
    sums.held_optimal += tool.moved.is_optimal;
}

}  // namespace

void ride(TouchSubject& subject, uint64_t seed, uint64_t ticks, TouchSums& sums) {
  static const double kRadii_m[] = {0, 0.00002, kUsualRadius_m, 0.001, 0.003};
  static const float kFrictions[] = {0.0f, 0.05f, 0.3f, 1.0f, 2.0f};
  static const uint32_t kWork[] = {10, 40, 160, 640, UINT32_MAX};
  const double scale = subject.scale();
  Tool tool(subject);
  Hand hand(subject, seed);
  tools::Random random(seed);
  // Half of the rides are usual ones, the others anything.
  const bool is_usual = seed % 2 == 0;
  const double radius_m = kRadii_m[is_usual ? 2 + random.below(3) : random.below(5)];
  tool.settings.radius_m = std::max(static_cast<float>(radius_m * scale), subject.min_radius_m);
  tool.settings.friction_static = tool.settings.friction_dynamic = kFrictions[random.below(5)];
  tool.settings.budget.work = is_usual ? 640 : kWork[random.below(5)];
  const double least_m = 2e-6 * wide(subject.size_m);
  for (uint64_t i = 0; i < ticks; ++i) {
    if (i % 500 == 0)
      hand.set_step_m(scale * (is_usual ? 1e-3 : 1e-2 * std::pow(random.between(0, 1), 3)));
    const bool was_free = tool.is_free(), was_growing = tool.proxy.is_growing;
    const Vec3 from_m = tool.proxy.position_m, hand_m = hand.next();
    const bool is_light = apart_m(from_m, hand_m) < kGrowsWithin_m * scale;
    tool.settings.growth_m = is_light ? static_cast<float>(kGrowth_m * scale) : 0;
    tool.tick(hand_m);
    ++sums.ticks;
    // A tool that grows is pushed out.
    if (was_free && tool.is_free() && !was_growing) {
      const double longer_m = apart_m(tool.proxy.position_m, hand_m) - apart_m(from_m, hand_m);
      if (tool.settings.friction_static > 0)
        sums.longer += longer_m > 0;
      else
        sums.longer_m = std::max(sums.longer_m, longer_m);
    }
    if (tool.is_free() && i % subject.ticks_between_places == 0) {
      ++sums.places;
      const double distance_m = subject.distance_m(tools::to_point(tool.proxy.position_m));
      sums.too_near += distance_m < wide(tool.proxy.radius_m) - least_m;
    }
    if (is_usual && was_free && wide(tool.proxy.radius_m) >= 0.999 * kUsualRadius_m * scale)
      count_usual(tool, sums);
  }
  sums.moves += tool.moves;
  sums.crossings += tool.crossings;
}

Leaving leave(TouchSubject& subject, uint64_t seed) {
  const double scale = subject.scale();
  Leaving leaving;
  Tool tool(subject);
  tool.settings.radius_m = static_cast<float>(0.003 * scale);
  Hand hand(subject, seed);
  hand.set_step_m(3e-4 * scale);
  Vec3 hand_m = hand.next();
  for (uint32_t i = 0; i < 2000 && !(tool.is_free() && tool.proxy.is_loaded); ++i)
    tool.tick(hand_m = hand.next());
  if (!tool.is_free() || !tool.proxy.is_loaded) return leaving;
  for (uint32_t i = 0; i < 3; ++i) tool.tick(hand_m = hand.next());
  leaving.is_contact = tool.is_pressed(hand_m);
  if (!leaving.is_contact) return leaving;
  tool.settings.budget.work = 20;
  const Vec3 out_m = tool.proxy.position_m - hand_m;
  uint32_t uncertain = 0;
  for (uint32_t i = 1; i <= 1000; ++i) {
    const float away = static_cast<float>(i) * 0.1f;
    tool.tick(hand_m + out_m * (away < 1.5f ? away : 1.5f));
    leaving.ticks = i;
    uncertain = tool.moved.is_starved ? uncertain + 1 : 0;
    leaving.is_fault = uncertain >= kFaultTicks;
    // Somewhere else it may touch again.
    if (leaving.is_fault || !tool.proxy.is_loaded || (away >= 1.5f && tool.moved.is_optimal)) break;
  }
  return leaving;
}

}  // namespace firmtouch::bench
