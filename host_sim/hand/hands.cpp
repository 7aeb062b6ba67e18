#include "host_sim/hand/hands.hpp"

#include <cmath>
#include <complex>

#include "host_sim/hand/palm.hpp"

namespace firmtouch::host_sim {
namespace {

HandModel made(double grip_N_per_m, double grip_N_s_per_m, double mass_kg, double arm_N_per_m,
               double arm_N_s_per_m) {
  HandModel model;
  model.stiffness_N_per_m = grip_N_per_m;
  model.damping_N_s_per_m = grip_N_s_per_m;
  model.mass_kg = mass_kg;
  model.arm_stiffness_N_per_m = arm_N_per_m;
  model.arm_damping_N_s_per_m = arm_N_s_per_m;
  return model;
}

}  // namespace

const std::vector<KnownHand>& known_hands() {
  static const std::vector<KnownHand> all = {
      {"pinch",
       "a mass with spring and damper, both of which rise with the grip (Hasser & Cutkosky 2002, "
       "System identification of the human hand grasping a haptic knob); its grip is stiff",
       "every value", made(3000, 3, 0.015, 150, 1), made(3000, 4, 0.02, 400, 3),
       made(3000, 6, 0.025, 1000, 6)},
      {"stylus",
       "one that yields in series with mass, spring and damper (Fu & Cavusoglu 2012, "
       "Human-arm-and-hand-dynamic model with variability analyses for a stylus-based haptic "
       "interface: 15 people, 1 to 3 N)",
       "every value", made(300, 2, 0.05, 80, 2), made(700, 4, 0.1, 200, 4),
       made(1500, 8, 0.15, 500, 8)},
      {"arm",
       "five parameters: grip, mass, arm (Speich, Shao & Goldfarb 2005, Modeling the human hand as "
       "it interacts with a telemanipulation system)",
       "every value", made(500, 5, 0.3, 80, 6), made(1200, 12, 0.6, 250, 15),
       made(3000, 25, 1.2, 700, 30)},
      {"handle",
       "mass, spring and damper of an arm that holds a handle (van Beek, Bergmann Tiest, Mugge & "
       "Kappers 2015, Haptic perception of force magnitude and its relation to postural arm "
       "dynamics in 3D, Sci. Rep. 5:18004, figure 3: one trial of one person); its grip is stiff",
       "the grip: hand_stiffness, hand_damping", made(1500, 8, 0.554, 135, 6.45),
       made(3000, 12, 0.554, 135, 6.45), made(6000, 25, 0.554, 135, 6.45)}};
  return all;
}

const HandModel* find_hand(const std::string& name, const std::string& grip) {
  for (const KnownHand& hand : known_hands()) {
    if (name != hand.name) continue;
    if (grip == "weak") return &hand.weak;
    if (grip == "mean") return &hand.mean;
    if (grip == "firm") return &hand.firm;
  }
  return nullptr;
}

std::string hand_names() {
  std::string names;
  for (const KnownHand& hand : known_hands())
    names += (names.empty() ? "" : ", ") + std::string(hand.name);
  return names;
}

const std::vector<HandKey>& hand_keys() {
  static const std::vector<HandKey> all = {
      {"hand_stiffness", "N/m", &HandModel::stiffness_N_per_m},
      {"hand_damping", "N*s/m", &HandModel::damping_N_s_per_m},
      {"hand_mass", "kg", &HandModel::mass_kg},
      {"hand_arm_stiffness", "N/m", &HandModel::arm_stiffness_N_per_m},
      {"hand_arm_damping", "N*s/m", &HandModel::arm_damping_N_s_per_m}};
  return all;
}

// Grip g = k + i w b against the mass, which the arm holds: g in series with a - m w^2.
double impedance_N_per_m(const HandModel& model, double frequency_Hz) {
  const double w = 2 * 3.14159265358979323846 * frequency_Hz;
  const std::complex<double> grip(model.stiffness_N_per_m, w * model.damping_N_s_per_m);
  if (!(model.mass_kg > 0)) return std::abs(grip);
  const std::complex<double> held(model.arm_stiffness_N_per_m - model.mass_kg * w * w,
                                  w * model.arm_damping_N_s_per_m);
  return std::abs(grip * held / (grip + held));
}

}  // namespace firmtouch::host_sim
