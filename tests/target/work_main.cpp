// Attacks the bound of a query's time: `work ROUNDS SEED FIXED PER_UNIT [guide|field|hull|way]` on
// the emulator's command line. A query of the board's asset (mesh, curve or spline; guide: a tick
// of the guide along it; field, hull, way: those of the mesh) must take at most FIXED + units used
// * PER_UNIT instructions, at every budget: anywhere, after jumps, from afar, led along, along the
// axes of a point of the shape, and hill climbing from the worst so far. Rows:
//     UNITS INSTRUCTIONS                 the worst seen of queries that used so many units, or more
//                                        and fewer than the next row's
//     ratio RATIO UNITS INSTRUCTIONS     the largest instructions / bound, in thousandths
// tools/bench/cortex-m7-work runs it.
#include <stdint.h>

#include "emulator/semihosting.hpp"
#include "firmtouch/asset/container.hpp"
#include "firmtouch/asset/loader.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/curve/guided_point.hpp"
#include "firmtouch/field/closest_point.hpp"
#include "firmtouch/field/loader.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hull/base_hull_distance.hpp"
#include "firmtouch/hull/loader.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/swept_sphere.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/guide/guided_point.hpp"
#include "target/count.hpp"
#include "target/random.hpp"
#include "target/scene_views.hpp"
#include "target/worst_cases.hpp"

using namespace firmtouch;  // NOLINT: a program of the tests
using math::Vec3;
using target::Random;

namespace {

constexpr uint32_t kBudgets[] = {0,  1,  2,   3,   5,   8,   13,   21,
                                 34, 55, 160, 320, 640, 640, 1280, UINT32_MAX};
constexpr float kReach = 1e-4f;  // of the extent: the least motion
constexpr float kFieldBand = 0.01f;
constexpr float kArcPenalty = 0.1f, kRelease = 0.1f;  // of a guide, as shares of length and extent

struct Settings {
  uint32_t rounds, seed, fixed, per_unit;
  char part;  // 'g': a guide, 'f': a field, 'h': a hull, 'w': a way; else the shape itself
};

// A shape that is queried, and what the last query left.
struct Answer {
  Vec3 point_m;
  query::Certificate certificate;
};
template <class View, class Hint>
struct Shape {
  using State = Hint;
  const View& view;
  Answer query(Vec3 p_m, query::Budget budget, State& state) const {
    const auto closest = closest_point(view, p_m, budget, state);
    return {closest.point_m, closest.certificate};
  }
};
template <class View, class Hold, class Following>
struct Guided {
  using State = Following;
  const View& view;
  Hold hold;
  Answer query(Vec3 p_m, query::Budget budget, State& state) const {
    const auto followed = follow(view, p_m, hold, budget, state);
    return {followed.closest.point_m, followed.closest.certificate};
  }
};
struct Field {
  struct State {
    mesh::Hint hint;
    Vec3 near_m;  // of the last mesh query
  };
  const field::View& view;
  const mesh::View& mesh;
  float band_m;
  Answer query(Vec3 p_m, query::Budget budget, State& state) const {
    const field::Answer answer = field::closest_point(view, mesh, p_m, band_m, budget, state.hint);
    if (!answer.is_far) state.near_m = answer.closest.point_m;
    return {state.near_m, answer.closest.certificate};
  }
};
struct Hull {
  struct State {};
  const hull::BaseHull& base_hull;
  Answer query(Vec3 p_m, query::Budget budget, State&) const {
    const hull::BaseHullDistance distance = hull::base_hull_distance(base_hull, p_m, budget);
    Answer answer{distance.point_m, {}};
    answer.certificate.work = distance.work;
    return answer;
  }
};
// A sphere on its way from the last query's place.
struct Way {
  struct State {
    Vec3 from_m;
  };
  const mesh::View& mesh;
  float extent_m;
  Answer query(Vec3 p_m, query::Budget budget, State& state) const {
    static const float kRadii[] = {4e-6f, 1e-3f, 1e-2f, 0.1f};
    const uint32_t bits = math::bits_of(p_m.x) ^ math::bits_of(p_m.y);
    query::SweptSphere sphere;
    sphere.from_m = state.from_m;
    sphere.along_m = p_m - state.from_m;
    sphere.radius_m = kRadii[bits % 4] * extent_m;
    sphere.axis[0] = {1, 0, 0}, sphere.axis[1] = {0, 1, 0}, sphere.axis[2] = {0, 0, 1};
    sphere.axes = 3;
    Answer answer{mesh.vertex(bits % mesh.head().vertex_count), {}};
    answer.certificate.work = mesh::sweep(mesh, sphere, budget).work;
    state.from_m = p_m;
    return answer;
  }
};

struct Box {
  Vec3 low_m, size_m;
  float extent_m;
};
template <class Head>
Box box_of(const Head& head) {
  const Vec3 low_m{head.low_m[0], head.low_m[1], head.low_m[2]};
  const Vec3 size_m = Vec3{head.high_m[0], head.high_m[1], head.high_m[2]} - low_m;
  return {low_m, size_m, math::length(size_m)};
}

template <class Subject>
class Attack {
 public:
  Attack(const Subject& subject, const Box& box, const Settings& settings)
      : subject_(subject), box_(box), settings_(settings), random_(settings.seed) {
    empty_ = target::empty_work();
  }

  void run() {
    for (uint32_t i = 0; i < settings_.rounds; ++i) {
      const uint32_t way = random_.below(8);
      if (way >= 5 && i > worst_.kSize) {
        const Case& from = worst_.any(random_);
        now_ = from;
        if (way == 5) now_.budget = a_budget();
        measure(from.p_m + random_.cube() * random_.scale(kReach * 0.01f * box_.extent_m, 12));
        continue;
      }
      now_.budget = a_budget();
      if (random_.below(4) == 0) now_.state = {};
      measure(way_to(way));
    }
    print();
  }

 private:
  static constexpr uint32_t kBins = 64;
  struct Case {
    typename Subject::State state;  // before the query
    Vec3 p_m;
    uint32_t budget = 0;
    float ratio = 0;
  };

  uint32_t a_budget() { return kBudgets[random_.below(sizeof kBudgets / sizeof kBudgets[0])]; }

  Vec3 way_to(uint32_t way) {
    const Vec3 off = random_.cube();
    switch (way) {
      case 0:
        return now_.p_m + off * random_.scale(kReach * box_.extent_m, 6);  // led
      case 1:
        return at_m_ + off * random_.scale(kReach * box_.extent_m, 10);  // near the shape
      case 2:
        return at_m_ + off * random_.scale(box_.extent_m, 14);  // far
      case 3: {                                                 // along the axes
        const Vec3 motion_m = off * (0.5f * box_.extent_m);
        const uint32_t axes = random_.below(7);
        return at_m_ + Vec3{(axes & 1) != 0 ? 0.0f : motion_m.x,
                            (axes & 2) != 0 ? 0.0f : motion_m.y,
                            (axes & 4) != 0 ? 0.0f : motion_m.z};
      }
      default: {
        const Vec3 half_m = box_.size_m * 0.5f;
        return box_.low_m + half_m +
               Vec3{off.x * half_m.x, off.y * half_m.y, off.z * half_m.z} * 1.5f;
      }
    }
  }

  void measure(Vec3 p_m) {
    Case tried = now_;
    tried.p_m = p_m;
    const uint32_t before = hal::clock_work();
    const Answer answer = subject_.query(p_m, query::Budget{now_.budget}, now_.state);
    const uint32_t taken = target::instructions(hal::clock_work() - before - empty_);
    const uint32_t units = answer.certificate.work;
    now_.p_m = p_m;
    at_m_ = answer.point_m;
    uint32_t& bin = most_[bin_of(units)];
    if (taken > bin) bin = taken;
    const float bound = static_cast<float>(settings_.fixed) +
                        static_cast<float>(units) * static_cast<float>(settings_.per_unit);
    tried.ratio = static_cast<float>(taken) / bound;
    if (tried.ratio > ratio_) ratio_ = tried.ratio, units_ = units, taken_ = taken;
    worst_.keep(tried);
  }

  // Up to 16 one by one, then four to an octave.
  static uint32_t bin_of(uint32_t units) {
    if (units < 16) return units;
    uint32_t octave = 0;
    for (; units >= 8; units >>= 1) ++octave;
    const uint32_t bin = 8 + octave * 4 + (units - 4);
    return bin < kBins ? bin : kBins - 1;
  }
  static uint32_t first_of(uint32_t bin) {
    return bin < 16 ? bin : (4 + (bin - 8) % 4) << ((bin - 8) / 4);
  }

  void print() {
    for (uint32_t bin = 0; bin < kBins; ++bin) {
      if (most_[bin] == 0) continue;
      target::print(first_of(bin), " ");
      target::print(most_[bin], "\n");
    }
    hal::board_print("ratio ");
    target::print(static_cast<uint32_t>(ratio_ * 1000.0f + 0.5f), " ");
    target::print(units_, " ");
    target::print(taken_, "\n");
  }

  const Subject& subject_;
  Box box_;
  Settings settings_;
  Random random_;
  uint32_t empty_ = 0;
  Case now_;
  Vec3 at_m_;  // the last answer's
  float ratio_ = 0;
  uint32_t units_ = 0, taken_ = 0;
  uint32_t most_[kBins] = {};
  target::WorstCases<Case, &Case::ratio> worst_;
};

template <class Subject>
void attack(const Subject& subject, const Box& box, const Settings& settings) {
  // Too large for the stack.
  static Attack<Subject> attack(subject, box, settings);
  attack.run();
}

using CurveGuide = Guided<curve::View, curve::Hold, curve::Following>;
using SplineGuide = Guided<spline::GuideView, spline::Hold, spline::Following>;

// A further part of the asset, which lies beside the part that is open.
class Asset {
 public:
  Asset() {
    const core::Bytes slot = hal::board_asset();
    is_open_ = asset::open({slot.data(), asset::stated_bytes(slot)}, file_).ok();
  }
  bool open(const spline::View& model, spline::GuideView& guide) const {
    return is_open_ && spline::open_guide(model,
                                          asset::find_sections<spline::GuideSections>(
                                              file_, name_of(spline::kHeadSection)),
                                          guide)
                           .ok();
  }
  bool open(const mesh::View& mesh, field::View& view) const {
    const char* const name = name_of(mesh::kHeadSection);
    return is_open_ &&
           field::open(asset::find_sections<field::Sections>(file_, name), mesh, view).ok();
  }
  bool open(hull::View& view) const {
    return is_open_ && asset::open_geometry(file_, name_of(mesh::kHeadSection), view).ok();
  }

 private:
  const char* name_of(uint32_t type) const { return file_.name(file_.next_of_type(type)); }
  asset::Container file_;
  bool is_open_;
};

bool run_mesh(const mesh::View& mesh, const Settings& settings) {
  const Box box = box_of(mesh.head());
  if (settings.part == 'f') {
    field::View view;
    if (!Asset().open(mesh, view)) return false;
    attack(Field{view, mesh, kFieldBand * box.extent_m}, box, settings);
  } else if (settings.part == 'h') {
    hull::View view;
    if (!Asset().open(view)) return false;
    attack(Hull{view.base_hull()}, box, settings);
  } else if (settings.part == 'w') {
    attack(Way{mesh, box.extent_m}, box, settings);
  } else {
    attack(Shape<mesh::View, mesh::Hint>{mesh}, box, settings);
  }
  return true;
}

bool run_curve(const curve::View& curve, const Settings& settings) {
  const Box box = box_of(curve.head());
  if (settings.part == 'g')
    attack(CurveGuide{curve, {kArcPenalty * curve.head().length_m, kRelease * box.extent_m}}, box,
           settings);
  else
    attack(Shape<curve::View, curve::Hint>{curve}, box, settings);
  return true;
}

bool run_spline(const spline::View& model, const Settings& settings) {
  const Box box = box_of(model.head());
  if (settings.part != 'g') {
    attack(Shape<spline::View, spline::Hint>{model}, box, settings);
    return true;
  }
  spline::GuideView guide;
  if (!Asset().open(model, guide)) return false;
  attack(SplineGuide{guide, {kArcPenalty * guide.length_m(), kRelease * box.extent_m}}, box,
         settings);
  return true;
}

bool run(const target::Views& views, const Settings& settings) {
  if (views.mesh.is_open()) return run_mesh(views.mesh, settings);
  if (views.curve.is_open()) return run_curve(views.curve, settings);
  return views.spline.is_open() && run_spline(views.spline, settings);
}

uint32_t number(const char*& text) {
  while (*text == ' ') ++text;
  uint32_t value = 0;
  for (; *text >= '0' && *text <= '9'; ++text)
    value = value * 10 + static_cast<uint32_t>(*text - '0');
  return value;
}

}  // namespace

int main() {
  hal::board_begin();
  char line[512];
  if (!hal::semihosting_command_line(line, sizeof line)) return 2;
  constexpr uint32_t kWord = 5;  // "work "
  const char* text = line + kWord;
  Settings settings;
  settings.rounds = number(text);
  settings.seed = number(text);
  settings.fixed = number(text);
  settings.per_unit = number(text);
  settings.part = *text == ' ' ? text[1] : ' ';
  const target::Views views = target::open_views(hal::board_asset());
  if (views.verdict.ok() && run(views, settings)) return 0;
  hal::board_print(
      "no mesh, curve or spline in the asset, no such part of it, or a rule rejects it\n");
  return 1;
}
