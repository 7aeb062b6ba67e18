// Texture against closed forms in double, and the work of a hand on closed ways: the sum of force
// times way, which knows nothing of a potential.
#include "firmtouch/scene/relief.hpp"

#include "scene/materials_rig.hpp"
#include "surface/random.hpp"

using namespace firmtouch;              // NOLINT: a test file
using namespace firmtouch::scene_test;  // NOLINT

namespace {

constexpr double kTop_m = 0.003;  // of the tool's centre above a plate
constexpr double kTool_N_per_m = 1000, kPi = 3.14159265358979;
constexpr double kHigh_m = 0.1e-3, kEvery_m = 1e-3;

double wide(float a) { return static_cast<double>(a); }
Vec3 narrow(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

scene::TextureLayout grooves(double every_m = kEvery_m, double high_m = kHigh_m) {
  return {{{{static_cast<float>(1 / every_m), 0, 0}, static_cast<float>(high_m)}, {}}};
}
// Steepest at y = 2 mm where x = 0.
scene::TextureLayout aslant(double high_m) {
  return {{{{125, 125, 0}, static_cast<float>(high_m)}, {}}};
}
scene::TextureLayout grid() {
  const float high_m = static_cast<float>(kHigh_m / 2), per_m = static_cast<float>(1 / kEvery_m);
  return {{{{per_m, 0, 0}, high_m}, {{0, 0.6f * per_m, 0.8f * per_m}, high_m}}};
}

MaterialsRig plates(const scene::TextureLayout& left, const scene::TextureLayout& right,
                    float friction = 0) {
  return MaterialsRig(
      two_plates(), {material("left", 1e9f, friction, friction), material("right", 1e9f)},
      [](Vec3 at_m) { return at_m.x < 0 ? uint8_t{1} : uint8_t{2}; }, {left, right});
}

struct Height {
  double m = 0, slope[3] = {};
};

// Below the triangle, and its slope.
Height height_of(const scene::TextureLayout& texture, const double x_m[3]) {
  Height height;
  for (const scene::WaveLayout& wave : texture.wave) {
    double waves = 0;
    for (int k = 0; k < 3; ++k) waves += wide(wave.per_m[k]) * x_m[k];
    height.m += wide(wave.height_m) / 2 * (1 - std::cos(2 * kPi * waves));
    for (int k = 0; k < 3; ++k)
      height.slope[k] +=
          wide(wave.height_m) * kPi * wide(wave.per_m[k]) * std::sin(2 * kPi * waves);
  }
  return height;
}

// The sum of force times way along straight lines, by Simpson's rule, and the largest force.
struct Work {
  double given_J = 0, most_N = 0;
};
void add_line(MaterialsRig& rig, Vec3 from_m, Vec3 to_m, float step_m, Vec3& at_N, Work& work) {
  const float length_m = math::length(to_m - from_m);
  const int steps = 2 * static_cast<int>(0.5f * length_m / step_m) + 2;
  const Vec3 unit = (to_m - from_m) * (1 / length_m);
  double sum_N = wide(math::dot(at_N, unit));
  for (int i = 1; i <= steps; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(steps);
    at_N = rig.tick(i == steps ? to_m : from_m + (to_m - from_m) * share);
    sum_N += wide(math::dot(at_N, unit)) * (i == steps ? 1 : i % 2 == 1 ? 4 : 2);
    work.most_N = std::max(work.most_N, wide(math::length(at_N)));
  }
  work.given_J += sum_N * wide(length_m) / (3 * steps);
}

// The most and the least that closed ways about `middle_m` give, over the most that was stored.
struct Loops {
  double most, least;
};
Loops loops_of(MaterialsRig& rig, Vec3 middle_m, uint32_t count, float step_m) {
  tools::Random random(11);
  double most_J = -1, least_J = 0, stored_J = 0;
  for (uint32_t loop = 0; loop < count; ++loop) {
    Vec3 place[5];
    for (Vec3& each : place)
      each = middle_m + narrow(random.between(-0.004, 0.004), random.between(-0.003, 0.003),
                               random.between(-0.0025, 0.002));
    place[0] = middle_m + narrow(-0.006, 0, 0.007);
    Work work;
    Vec3 at_N = rig.tick(place[0]);
    for (int k = 0; k < 5; ++k) add_line(rig, place[k], place[(k + 1) % 5], step_m, at_N, work);
    most_J = std::max(most_J, work.given_J), least_J = std::min(least_J, work.given_J);
    stored_J = std::max(stored_J, work.most_N * work.most_N / (2 * kTool_N_per_m));
  }
  return {most_J / stored_J, least_J / stored_J};
}

// A hump a tile, of 1 mm; its samples are rounded to 8 bits.
MaterialsRig with_relief(const tools::Surface& surface, float friction) {
  scene::ReliefLayout relief = {{1000, 0, 0}, {0, 600, 800}, 8e-5f, 0, 0, 0, 16};
  std::vector<uint8_t> samples;
  for (int i = 0; i < 256; ++i)
    samples.push_back(static_cast<uint8_t>(std::lround(
        127.5 - 63.75 * (std::cos(kPi * (i % 16) / 8) + std::sin(kPi * (i / 16) / 8)))));
  const scene::ReliefBounds bounds = scene::bounds_of(relief, samples.data());
  relief.slope = bounds.slope, relief.per_m = bounds.per_m;
  return MaterialsRig(
      surface, {material("m", 1e9f, friction, friction)}, [](Vec3) { return uint8_t{1}; }, {},
      {relief}, samples);
}

MaterialsRig gridded(const tools::Surface& surface, float friction) {
  return MaterialsRig(surface, {material("m", 1e9f, friction, friction)},
                      [](Vec3) { return uint8_t{1}; }, {grid()});
}

}  // namespace

TEST(Texture_Cut_IsTheClosedForm) {
  tools::Random random(3);
  for (const scene::TextureLayout& texture : {grooves(), grooves(2e-5, 4e-6), grid()})
    for (int i = 0; i < 20000; ++i) {
      const Vec3 at_m =
          narrow(random.between(-0.1, 0.1), random.between(-0.1, 0.1), random.between(-0.1, 0.1));
      const double x_m[] = {wide(at_m.x), wide(at_m.y), wide(at_m.z)};
      const scene::Cut cut = scene::cut_at(texture, at_m);
      const Height wanted = height_of(texture, x_m);
      // As the header says: what x rounds by, over the length, times the height.
      const double rounds =
          0x1p-23 * kPi * 3 * 0.1 *
              wide(math::length(
                  {texture.wave[0].per_m[0], texture.wave[0].per_m[1], texture.wave[0].per_m[2]})) +
          1e-6;
      CHECK_LE(std::fabs(wide(cut.depth_m) - wanted.m), kHigh_m * rounds);
      const float slope[] = {cut.slope.x, cut.slope.y, cut.slope.z};
      for (int k = 0; k < 3; ++k) CHECK_LE(std::fabs(wide(slope[k]) - wanted.slope[k]), 2 * rounds);
      CHECK_GE(cut.depth_m, 0.0f);
    }
}

TEST(Texture_AnyPlace_IsFinite) {
  for (const float x_m : {0.0f, NAN, INFINITY, -INFINITY, 1e30f, -3e38f, 1e-40f}) {
    const scene::Cut cut = scene::cut_at(grid(), {x_m, 1, x_m});
    CHECK(math::is_finite(cut.slope) && cut.depth_m >= 0.0f && cut.depth_m <= 2e-4f);
  }
}

// Without friction: k (d - c) upwards, and as much times the slope aside.
TEST(Texture_ForceOnAFace_IsTheClosedForm) {
  for (const scene::TextureLayout& texture : {grooves(), grid()}) {
    MaterialsRig rig = plates(texture, grooves(5e-3, 1e-3));
    rig.contact.material.stiffness_N_per_m = 1000;
    for (const double deep_m : {0.3e-3, 1e-3, 2e-3}) {
      rig.go(narrow(-0.02, 0, 0.01), narrow(-0.02, 0, kTop_m - deep_m), 100);
      for (int i = 0; i < 1000; ++i) {
        const Vec3 hand_m = narrow(-0.02 + 1.3e-5 * i, 0.7e-5 * i, kTop_m - deep_m);
        const Vec3 force_N = rig.tick(hand_m);
        const double x_m[] = {wide(hand_m.x), wide(hand_m.y), wide(hand_m.z)};
        const Height height = height_of(texture, x_m);
        const double pressed_N = kTool_N_per_m * (kTop_m - wide(hand_m.z) - height.m);
        const double within_N = 0.005 * pressed_N;
        CHECK_LE(std::fabs(wide(force_N.z) - pressed_N * (1 + height.slope[2])), within_N);
        CHECK_LE(std::fabs(wide(force_N.x) - pressed_N * height.slope[0]), within_N);
        CHECK_LE(std::fabs(wide(force_N.y) - pressed_N * height.slope[1]), within_N);
      }
      rig.go(narrow(-0.007, 0.007, kTop_m - deep_m), narrow(-0.007, 0.007, 0.01), 100);
    }
  }
}

// At two rates servo holds the place of the model before while the next one is made.
TEST(Texture_ServoIsAModelBehind_GivesTheSameForce) {
  MaterialsRig rig = plates(grooves(), {}), late = plates(grooves(), {});
  tools::Random random(5);
  for (int i = 0; i < 1000; ++i) {
    late.is_late = i > 100;
    // Lifts off and presses again, too, at last from tick to tick.
    const double z_m = i < 500 ? kTop_m - 0.2e-3 + 1e-3 * std::cos(2 * kPi * i / 160.0)
                               : kTop_m + random.between(-0.6e-3, 0.1e-3);
    const Vec3 at_m = narrow(-0.02 + 1.3e-5 * i, 0, z_m);
    CHECK_LE(wide(math::length(rig.tick(at_m) - late.tick(at_m))), 1e-4);
    CHECK_GE(late.touch.proxy.position_m.z, 0.0029995f);
  }
}

// The texture is fixed to the mesh.
TEST(Texture_OfAMeshThatWasTurned_TurnsWithIt) {
  MaterialsRig rig = plates(grooves(), {}), turned = plates(grooves(), {});
  turned.object.pose = {{{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}, {0.01f, -0.02f, 0.03f}};
  for (int i = 0; i < 400; ++i) {
    const Vec3 at_m = narrow(-0.02 + 2e-5 * i, 0.001, i < 50 ? 0.004 - 4e-5 * i : kTop_m - 1e-3);
    const Vec3 plain_N = rig.tick(at_m);
    const Vec3 wanted_N = turned.object.pose.rotation * plain_N;
    const Vec3 force_N = turned.tick(math::apply(turned.object.pose, at_m));
    CHECK_LE(wide(math::length(force_N - wanted_N)), 0.005 * wide(math::length(plain_N)) + 1e-5);
  }
}

// Over 1 mm waves at 100 mm/s the force swings at 100 Hz, and nowhere else as much.
TEST(Texture_SlideOverWaves_SwingsAtSpeedOverLength) {
  MaterialsRig rig = plates(grooves(), {});
  rig.go(narrow(-0.03, 0, 0.01), narrow(-0.03, 0, kTop_m - 1e-3), 100);
  std::vector<double> force_N;
  for (int i = 0; i < 250; ++i)
    force_N.push_back(wide(rig.tick(narrow(-0.03 + 1e-4 * i, 0, kTop_m - 1e-3)).x));
  double most = 0, all = 0;
  int most_at = 0;
  for (int k = 1; k < 125; ++k) {  // of 4 Hz each
    double re = 0, im = 0;
    for (int i = 0; i < 250; ++i) {
      re += force_N[static_cast<size_t>(i)] * std::cos(2 * kPi * k * i / 250);
      im += force_N[static_cast<size_t>(i)] * std::sin(2 * kPi * k * i / 250);
    }
    const double power = re * re + im * im;
    all += power;
    if (power > most) most = power, most_at = k;
  }
  CHECK_EQ(most_at, 25);
  CHECK_GE(most, 0.99 * all);
}

// On a floor and in its corner with a wall, and over a convex edge. Where contact begins the force
// has a bend, which the rule takes for a curve: the steps are short.
TEST(Texture_ClosedLoops_GiveNoEnergy) {
  MaterialsRig corner = gridded(two_walls(), 0), edge = gridded(two_plates(), 0);
  CHECK_LE(loops_of(corner, {-0.004f, 0, 0.003f}, 50, 5e-7f).most, 1e-6);
  CHECK_LE(loops_of(edge, {0.041f, 0, 0.003f}, 50, 5e-7f).most, 1e-6);
}

TEST(Texture_ClosedLoopsOverARelief_GiveNoEnergy) {
  MaterialsRig corner = with_relief(two_walls(), 0), edge = with_relief(two_plates(), 0);
  CHECK_LE(loops_of(corner, {-0.004f, 0, 0.003f}, 50, 5e-7f).most, 1e-6);
  CHECK_LE(loops_of(edge, {0.041f, 0, 0.003f}, 50, 5e-7f).most, 1e-6);
  CHECK_GE(scene::bounds_of(corner.materials.reliefs()[0], corner.materials.samples().data()).slope,
           0.2f);
}

TEST(Texture_ClosedLoopsWithFriction_TakeEnergy) {
  MaterialsRig corner = gridded(two_walls(), 0.3f), edge = gridded(two_plates(), 0.3f);
  for (const Loops& loops : {loops_of(corner, {-0.004f, 0, 0.003f}, 100, 5e-6f),
                             loops_of(edge, {0.041f, 0, 0.003f}, 100, 5e-6f)}) {
    CHECK_LE(loops.most, 0);
    CHECK_LE(loops.least, -0.1);
  }
}

// From grooves to a smooth plate, to deeper ones and back: under load the force makes no step.
TEST(Texture_BorderUnderLoad_MakesNoStepOfTheForce) {
  for (const scene::TextureLayout& right : {scene::TextureLayout{}, aslant(0.5e-3)}) {
    MaterialsRig rig = plates(aslant(0.2e-3), right);
    const double deep = kTop_m - 1e-3;
    Vec3 before_N = rig.go(narrow(-0.01, 0.002, 0.01), narrow(-0.01, 0.002, deep), 100);
    double worst_N = 0;
    for (int i = 0; i <= 16000; ++i) {
      const double share = i < 8000 ? i / 8000.0 : 2 - i / 8000.0;
      const Vec3 force_N = rig.tick(narrow(-0.01 + 0.02 * share, 0.002, deep));
      worst_N = std::max(worst_N, wide(math::length(force_N - before_N)));
      before_N = force_N;
    }
    CHECK_LE(worst_N, 0.05);
    CHECK_GE(worst_N, 0.002);
    rig.go(narrow(-0.01, 0.002, deep), narrow(-0.01, 0.002, 0.01), 100);
    // The next contact has its own texture at once.
    const Vec3 force_N = rig.go(narrow(0.01, 0.002, 0.01), narrow(0.01, 0.002, deep), 100);
    const double x_m[] = {0.01, 0.002, deep};
    const double wanted_N = kTool_N_per_m * (1e-3 - height_of(right, x_m).m);
    CHECK_LE(std::fabs(wide(force_N.z) - wanted_N), 0.005 * wanted_N);
  }
}

// The hand stays above the trough, or hangs in it: there no force is made.
TEST(Texture_HandInATrough_HasNoForce) {
  MaterialsRig rig = plates(grooves(8e-3, 1e-3), {});
  const Vec3 force_N = rig.go(narrow(-0.012, 0, 0.01), narrow(-0.012, 0, kTop_m - 0.5e-3), 100);
  CHECK_EQ(math::length(force_N), 0.0f);
  CHECK_EQ(rig.model.spring.damping_N_s_per_m, 0.0f);
  CHECK(rig.model.spring.is_held);
  CHECK_GE(rig.tick(narrow(-0.012, 0, kTop_m - 1.1e-3)).z, 0.05f);
}
