#include "firmtouch/core/crc32.hpp"
#include "firmtouch/math/arithmetic_check.hpp"
#include "firmtouch/math/elementary.hpp"
#include "firmtouch/math/nearest_in_planes.hpp"
#include "firmtouch/math/sine_cosine.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/query/coherence.hpp"
#include "firmtouch/query/hint.hpp"
#include "firmtouch/record/ring.hpp"
#include "firmtouch/record/tick.hpp"
#include "target/bounds/meter.hpp"
#include "target/random.hpp"
#include "target/worst_cases.hpp"

namespace firmtouch::target {
namespace {

constexpr uint32_t kInputs = 4000;

float of_any_size(Random& random) { return random.sign() * random.scale(0x1p-40f, 80); }

template <class Function>
Worst worst_of(Random& random, float scale, const Function& function) {
  Worst worst;
  float result = 0;
  for (uint32_t i = 0; i < kInputs; ++i) {
    const float x = i % 2 == 0 ? scale * random.sign() : of_any_size(random);
    worst.of([&] { result = function(x); });
    asm volatile("" ::"r"(&result) : "memory");
  }
  return worst;
}

void measure_sine_cosine(Random& random) {
  Worst alone, further;
  for (uint32_t i = 0; i < kInputs; ++i) {
    float angle_rad[5];
    for (float& angle : angle_rad) angle = 120.0f * random.sign();
    math::SineCosine result[5];
    const uint32_t one = instructions_of([&] { result[0] = math::sine_cosine(angle_rad[0]); });
    const uint32_t five = instructions_of([&] {
      const math::SineTerms terms;
      for (uint32_t k = 0; k < 5; ++k) result[k] = math::sine_cosine(angle_rad[k], terms);
    });
    asm volatile("" ::"r"(result) : "memory");
    alone.take(one);
    further.take(five > one ? (five - one + 3) / 4 : 0);
  }
  print_figure("math/sine_cosine.hpp", alone);
  print_figure("math/sine_cosine.hpp", further);
}

void measure_crc32() {
  static uint8_t bytes[4096];
  uint32_t crc = 0;
  Worst all, last;
  all.take((instructions_of([&] {
              crc = core::crc32({bytes, sizeof bytes}, crc);
            }) +
            sizeof bytes - 1) /
           sizeof bytes);
  for (uint32_t count = 40; count < 80; ++count)
    last.take((instructions_of([&] {
                 crc = core::crc32({bytes, count}, crc);
               }) +
               count - 1) /
              count);
  asm volatile("" ::"r"(&crc) : "memory");
  print_figure("core/crc32.hpp", all);
  print_figure("core/crc32.hpp", last);
}

void measure_ring() {
  static record::Ring<record::TickRecord, 64> ring;
  static record::TickRecord record;
  Worst kept, dropped;
  for (uint32_t i = 0; i < 400; ++i) {
    const bool is_full = ring.waiting() == ring.kCapacity;
    (is_full ? dropped : kept).of([&] { ring.push(record); });
    if (i % 100 == 99) ring.release(ring.ready().size());
  }
  print_figure("record/ring.hpp", kept);
  print_figure("record/ring.hpp", dropped);
}

void measure_carry(Random& random) {
  Worst worst;
  query::HintBase hint;
  query::Carried carried;
  for (uint32_t i = 0; i < kInputs; ++i) {
    hint.position_m = random.cube();
    hint.lower_m = random.scale(1e-4f, 14);
    hint.sign = static_cast<int8_t>(random.below(3)) - 1;
    const math::Vec3 to_m = random.cube();
    worst.of([&] { carried = query::carry(hint, to_m); });
    asm volatile("" ::"r"(&carried) : "memory");
  }
  print_figure("query/coherence.hpp", worst);
}

// Planes through and behind the origin, and those whose solution took longest, changed a little.
struct Planes {
  math::HalfSpace plane[7];
  math::Vec3 goal_m;
  uint32_t taken = 0;
};

math::Vec3 unit(math::Vec3 v) {
  const float size = math::length(v);
  return size > 0.01f ? v * (1.0f / size) : math::Vec3{0, 0, 1};
}

void put_planes(Random& random, Planes& planes) {
  for (math::HalfSpace& plane : planes.plane) {
    plane.normal = unit(random.cube());
    plane.offset_m = random.below(3) == 0 ? 0 : -0.1f * random.scale(1e-6f, 20);
  }
  planes.goal_m = random.cube();
}

void change_planes(Random& random, Planes& planes) {
  const float by = random.scale(1e-4f, 12);
  const uint32_t k = random.below(8);
  if (k == 7) {
    planes.goal_m = planes.goal_m + random.cube() * by;
    return;
  }
  math::HalfSpace& plane = planes.plane[k];
  plane.normal = unit(plane.normal + random.cube() * by);
  const float offset_m = plane.offset_m + 0.1f * by * random.sign();
  plane.offset_m = offset_m < 0 ? offset_m : 0;
}

void measure_planes() {
  static WorstCases<Planes, &Planes::taken> worst;
  Random random(13);
  Worst all;
  math::NearestInPlanes nearest;
  for (uint32_t i = 0; i < 40000; ++i) {
    Planes now = worst.any(random);
    if (i < 1000 || random.below(3) == 0)
      put_planes(random, now);
    else
      change_planes(random, now);
    now.taken =
        instructions_of([&] { nearest = math::nearest_in_planes(now.plane, 7, now.goal_m); });
    asm volatile("" ::"r"(&nearest) : "memory");
    all.take(now.taken);
    worst.keep(now);
  }
  print_figure("math/nearest_in_planes.hpp", all);
}

}  // namespace

void measure_math() {
  Random random(1);
  Worst sines = worst_of(random, 10, [](float x) { return math::sine(x); });
  sines.take(worst_of(random, 10, [](float x) { return math::cosine(x); }).taken);
  print_figure("math/elementary.hpp", sines);
  Random other(2);
  print_figure("math/elementary.hpp",
               worst_of(random, 1, [&](float x) { return math::arc_tangent2(x, other.sign()); }));
  print_figure("math/elementary.hpp",
               worst_of(random, 1, [](float x) { return math::arc_cosine(x); }));
  print_figure("math/elementary.hpp", worst_of(random, 16, [](float x) { return math::decay(x); }));
  measure_sine_cosine(random);
  Worst check;
  check.of([] { (void)math::arithmetic_is_sound(); });
  print_figure("math/arithmetic_check.hpp", check);
  measure_carry(random);
  measure_planes();
  measure_crc32();
  measure_ring();
}

}  // namespace firmtouch::target
