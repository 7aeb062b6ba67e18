// Instructions of band queries (band: 1 % of the extent) on the mesh of the board's asset. A row a
// point:
//     KIND COLD WARM      cold query; warm-started query after a motion of a twentieth of the band
// KIND 0: anywhere in 1.5 boxes. 1: at and near the centre. 2: up to 1.3 bands from the middle of a
// face. 3: hill climbing from the most expensive of these. tools/bench/cortex-m7 --band runs it and
// adds up.
#include <stdint.h>

#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "target/count.hpp"
#include "target/scene_views.hpp"

using namespace firmtouch;  // NOLINT: a program of the tests
using math::Vec3;

namespace {

constexpr uint32_t kAnywhere = 4000, kAboutCentre = 3000, kBeside = 12000;
constexpr uint32_t kStarts = 72, kTries = 120;  // starting points of hill climbing, moves of each

class Random {
 public:
  /// Uniform in [-1, 1].
  float sign() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return static_cast<float>(static_cast<int32_t>(state_ >> 8) - (1 << 23)) * 0x1p-23f;
  }
  uint32_t below(uint32_t end) {
    return static_cast<uint32_t>((sign() * 0.5f + 0.5f) * static_cast<float>(end - 1));
  }
  Vec3 cube() {
    const float x = sign(), y = sign();
    return {x, y, sign()};
  }

 private:
  uint32_t state_ = 1;
};

struct Start {
  Vec3 point_m;
  uint32_t taken = 0;
};

class Bench {
 public:
  explicit Bench(const mesh::View& mesh) : mesh_(mesh) {
    const mesh::Head& head = mesh.head();
    const float sides_m[] = {head.high_m[0] - head.low_m[0], head.high_m[1] - head.low_m[1],
                             head.high_m[2] - head.low_m[2]};
    side_m_ = {sides_m[0], sides_m[1], sides_m[2]};
    for (const float side_m : sides_m) extent_m_ = side_m > extent_m_ ? side_m : extent_m_;
    centre_m_ = Vec3{head.low_m[0], head.low_m[1], head.low_m[2]} + side_m_ * 0.5f;
    budget_.band_m = 0.01f * extent_m_;
    empty_ = target::empty_work();
  }

  void run() {
    for (uint32_t i = 0; i < kAnywhere; ++i) {
      const Vec3 at = random_.cube();
      print(0, centre_m_ + Vec3{at.x * side_m_.x, at.y * side_m_.y, at.z * side_m_.z} * 0.75f);
    }
    print(1, centre_m_);
    float reach_m = 0.1f * extent_m_;
    for (uint32_t i = 0; i < kAboutCentre; ++i, reach_m *= 0.996f)
      print(1, centre_m_ + random_.cube() * reach_m);
    for (uint32_t i = 0; i < kBeside; ++i) print(2, beside());
    for (const Start& from : starts_) hill_climb(from);
  }

 private:
  Vec3 beside() {
    const mesh::Triangle<uint32_t> t = mesh_.triangle(random_.below(mesh_.head().triangle_count));
    const Vec3 a = mesh_.vertex(t.corner[0]), b = mesh_.vertex(t.corner[1]),
               c = mesh_.vertex(t.corner[2]);
    const Vec3 middle_m = (a + b + c) * (1.0f / 3.0f);
    const float per_m = 1.0f / extent_m_;
    const Vec3 normal = cross((b - a) * per_m, (c - a) * per_m);
    return middle_m + normal * (1.3f * random_.sign() * budget_.band_m / math::length(normal));
  }

  uint32_t measure(Vec3 p_m, mesh::Hint& hint) const {
    const uint32_t before = hal::clock_work();
    const mesh::Closest closest = mesh::closest_point(mesh_, p_m, budget_, hint);
    const uint32_t work = hal::clock_work() - before - empty_;
    if (!(closest.certificate.lower_m >= 0.0f)) hal::board_print("no bound\n");
    return target::instructions(work);
  }

  uint32_t print(uint32_t kind, Vec3 p_m) {
    mesh::Hint hint;
    const uint32_t cold = measure(p_m, hint);
    const uint32_t warm = measure(p_m + random_.cube() * (0.03f * budget_.band_m), hint);
    target::print(kind, " ");
    target::print(cold, " ");
    target::print(warm, "\n");
    if (kind < 3) keep(p_m, cold);
    return cold;
  }

  // Keeps the kStarts most expensive points.
  void keep(Vec3 p_m, uint32_t taken) {
    uint32_t cheapest = 0;
    for (uint32_t i = 1; i < kStarts; ++i)
      if (starts_[i].taken < starts_[cheapest].taken) cheapest = i;
    if (taken > starts_[cheapest].taken) starts_[cheapest] = {p_m, taken};
  }

  void hill_climb(Start from) {
    float reach_m = 0.5f * budget_.band_m;
    for (uint32_t i = 0; i < kTries; ++i, reach_m *= 0.97f) {
      const Vec3 p_m = from.point_m + random_.cube() * reach_m;
      const uint32_t taken = print(3, p_m);
      if (taken > from.taken) from = {p_m, taken};
    }
  }

  const mesh::View& mesh_;
  query::Budget budget_;
  Vec3 side_m_, centre_m_;
  float extent_m_ = 0;
  uint32_t empty_ = 0;
  Random random_;
  Start starts_[kStarts];
};

}  // namespace

int main() {
  hal::board_begin();
  const target::Views views = target::open_views(hal::board_asset());
  if (!views.verdict.ok() || !views.mesh.is_open()) {
    hal::board_print("no mesh in the asset, or a rule rejects it\n");
    return 1;
  }
  Bench(views.mesh).run();
  return 0;
}
