#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bench/all_benches.hpp"
#include "bench/brute_truth.hpp"
#include "bench/models.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/segment_cast.hpp"
#include "firmtouch/scene/mesh_touched.hpp"
#include "firmtouch/scene/proxy.hpp"
#include "surface/random.hpp"

// The theorems of contact through a proxy (firmware/firmtouch/scene/README.md), attacked: a hand
// drags spheres through a model, from place to place in its box, in turn at up to 10 m/s and at 1
// m/s, with budgets of 10 work units to unlimited and coefficients of friction of 0 to 2. Every
// move of the proxy is cast through the surface, exactly; one place in 64 is measured by brute
// force in double. Speeds are of a model of 0.15 m at 1 kHz; others are as if scaled to it.
namespace firmtouch::bench {
namespace {

using math::Vec3;

double wide(float a) { return static_cast<double>(a); }
double apart_m(Vec3 a, Vec3 b) {
  return std::hypot(wide(a.x) - wide(b.x), wide(a.y) - wide(b.y), wide(a.z) - wide(b.z));
}

// From place to place in 1.2 boxes, each way in steps of one length.
class Hand {
 public:
  Hand(const Model& model, uint64_t seed)
      : random_(seed), head_(model.view.head()), at_m_(place()) {}

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
    float p_m[3];
    for (int k = 0; k < 3; ++k) {
      const double low_m = wide(head_.low_m[k]), high_m = wide(head_.high_m[k]);
      p_m[k] =
          static_cast<float>((low_m + high_m) / 2 + random_.between(-0.6, 0.6) * (high_m - low_m));
    }
    return {p_m[0], p_m[1], p_m[2]};
  }

  tools::Random random_;
  const mesh::Head& head_;
  Vec3 at_m_, to_m_{};
  double step_m_ = 0;
};

struct Tool {
  const Model& model;
  scene::MeshObject object;
  mesh::Hint hint;
  scene::Proxy proxy;
  scene::ProxySettings settings;
  scene::ProxyMoved moved;

  explicit Tool(const Model& of) : model(of) { object.mesh = &of.view; }

  bool is_free() const { return proxy.phase == scene::Proxy::Phase::kFree; }

  // Result: how many moves of a certified proxy met the surface.
  uint32_t tick(Vec3 hand_m) {
    uint32_t crossings = 0;
    const scene::MeshTouched shape{object, hint};
    scene::ProxyMove move(settings, shape.size_m(), hand_m, proxy);
    const auto note = [&](bool was_free, Vec3 from_m) {
      if (!was_free || !(apart_m(from_m, proxy.position_m) > 0)) return;
      const mesh::Hit hit =
          mesh::any_crossing(model.view, from_m, proxy.position_m, query::kUnlimited);
      if (hit.hit || !hit.exact) ++crossings;
    };
    for (;;) {
      const bool was_free = is_free();
      const Vec3 from_m = proxy.position_m;
      const bool goes_on = move.aim();
      note(was_free, from_m);
      if (!goes_on) break;
      const Vec3 before_m = proxy.position_m;
      move.take(shape.near(move.query_m(), move.budget(), move.needed_m()));
      note(was_free && is_free(), before_m);
    }
    moved = move.finish();
    return crossings;
  }
};

struct Sums {
  uint64_t ticks = 0, crossings = 0, too_near = 0, longer = 0;
  double longer_m = 0;  // without friction, the worst
  // At 1 m/s, with the default budget and radii from 0.5 mm on:
  uint64_t usual = 0, queries = 0, most_queries = 0, optimal = 0, starved = 0;
};

void drag(const Model& model, uint64_t seed, uint64_t ticks, const BruteForce& brute, Sums& sums) {
  static const double kRadii_m[] = {0, 0.00002, 0.0005, 0.001, 0.003};
  static const float kFrictions[] = {0.0f, 0.05f, 0.3f, 1.0f, 2.0f};
  static const uint32_t kWork[] = {10, 40, 160, 640, UINT32_MAX};
  const double scale = model.diagonal_m() / 0.15;
  Tool tool(model);
  Hand hand(model, seed);
  tools::Random random(seed);
  // Half of the rides are usual ones, the others anything.
  const bool is_usual = seed % 2 == 0;
  const double radius_m = kRadii_m[is_usual ? 2 + random.below(3) : random.below(5)];
  tool.settings.radius_m = static_cast<float>(radius_m * scale);
  tool.settings.friction_static = tool.settings.friction_dynamic = kFrictions[random.below(5)];
  tool.settings.budget.work = is_usual ? 640 : kWork[random.below(5)];
  const double least_m = 2e-6 * model.diagonal_m();
  for (uint64_t i = 0; i < ticks; ++i) {
    if (i % 500 == 0)
      hand.set_step_m(scale * (is_usual ? 1e-3 : 1e-2 * std::pow(random.between(0, 1), 3)));
    const bool was_free = tool.is_free();
    const Vec3 from_m = tool.proxy.position_m, hand_m = hand.next();
    sums.crossings += tool.tick(hand_m);
    ++sums.ticks;
    if (was_free && tool.is_free()) {
      const double longer_m = apart_m(tool.proxy.position_m, hand_m) - apart_m(from_m, hand_m);
      if (tool.settings.friction_static > 0)
        sums.longer += longer_m > 0;
      else
        sums.longer_m = std::max(sums.longer_m, longer_m);
    }
    if (tool.is_free() && i % 64 == 0) {
      const tools::Point place = tools::to_point(tool.proxy.position_m);
      sums.too_near += brute.at(place).distance_m < wide(tool.proxy.radius_m) - least_m;
    }
    if (!is_usual || !was_free) continue;
    ++sums.usual;
    sums.queries += tool.moved.queries;
    sums.most_queries = std::max<uint64_t>(sums.most_queries, tool.moved.queries);
    sums.optimal += tool.moved.is_optimal;
    sums.starved += tool.moved.is_starved;
  }
}

// Presses the tool on the surface, then gives it 20 work units a tick and takes the hand away.
// Result: ticks until it is at the hand, or until 10 in a row are uncertain, which is a fault.
uint32_t ticks_to_let_go(const Model& model, uint64_t seed) {
  const double scale = model.diagonal_m() / 0.15;
  Tool tool(model);
  tool.settings.radius_m = static_cast<float>(0.003 * scale);
  Hand hand(model, seed);
  hand.set_step_m(3e-4 * scale);
  Vec3 hand_m = hand.next();
  for (uint32_t i = 0; i < 2000 && !(tool.is_free() && tool.proxy.is_loaded); ++i)
    tool.tick(hand_m = hand.next());
  if (!tool.is_free() || !tool.proxy.is_loaded) return 0;
  for (uint32_t i = 0; i < 3; ++i) tool.tick(hand_m = hand.next());
  tool.settings.budget.work = 20;
  const Vec3 out_m = tool.proxy.position_m - hand_m;
  uint32_t uncertain = 0;
  for (uint32_t i = 1; i <= 1000; ++i) {
    const float away = static_cast<float>(i) * 0.1f;
    tool.tick(hand_m + out_m * (away < 1.5f ? away : 1.5f));
    uncertain = tool.moved.is_starved ? uncertain + 1 : 0;
    // Somewhere else it may touch again.
    if (uncertain >= 10 || !tool.proxy.is_loaded || (away >= 1.5f && tool.moved.is_optimal))
      return i;
  }
  return UINT32_MAX;
}

void attack(const Model& model, bool is_long, Report& report) {
  const BruteForce brute(model.surface, false);
  const uint64_t rides = is_long ? 400 : 40, ticks = is_long ? 50000 : 5000;
  Sums sums;
  for (uint64_t seed = 0; seed < rides; ++seed) {
    report.stage("touching " + model.name + ": ride " + std::to_string(seed + 1) + " of " +
                 std::to_string(rides));
    drag(model, seed, ticks, brute, sums);
  }
  const std::string of = model.name, among = "of " + std::to_string(sums.ticks) + " ticks";
  const double usual = static_cast<double>(sums.usual);
  report.bar("moves that cross the surface", of, static_cast<double>(sums.crossings), "", 0, among);
  report.bar("places nearer than the radius", of, static_cast<double>(sums.too_near), "", 0,
             "one place in 64");
  report.bar("moves away from the hand, with friction", of, static_cast<double>(sums.longer), "",
             0);
  report.bar("the same without, the longest", of, sums.longer_m / model.diagonal_m(), "diagonals",
             1e-7);
  report.bar("queries a tick at 1 m/s", of, static_cast<double>(sums.queries) / usual, "", 1.3);
  report.bar("the most in a tick", of, static_cast<double>(sums.most_queries), "",
             scene::kMaxQueries);
  report.bar_at_least("ticks that end at the solution", of,
                      100 * static_cast<double>(sums.optimal) / usual, "%", 98);
  report.figure("ticks that are uncertain", of, 100 * static_cast<double>(sums.starved) / usual,
                "%");
  uint32_t worst = 0, contacts = 0;
  for (uint64_t seed = 0; seed < (is_long ? 1500u : 100u); ++seed) {
    const uint32_t took = ticks_to_let_go(model, seed);
    contacts += took != 0;
    worst = std::max(worst, took);
  }
  report.bar("ticks until a leaving hand is let go, or a fault", of, worst, "", 20,
             std::to_string(contacts) + " contacts at 20 work units a tick");
}

}  // namespace

void run_touch(const Options& options, Report& report) {
  for (const Model& model : load_models(options)) attack(model, options.is_long, report);
}

}  // namespace firmtouch::bench
