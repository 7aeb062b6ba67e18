#pragma once
#include <cstdint>
#include <string>

#include "host_sim/bench/rig.hpp"

namespace firmtouch::host_sim {

/// What contact gave to hands that try to gain energy from it.
struct HandsGain {
  double worst_J = 0;  // of the hand's own work, from one tick without contact to a later one
  double ticks = 0;
  uint32_t hands = 0, touched = 0;
  uint32_t faulted = 0, overdrawn = 0;  // with any fault, with fault 15
  std::string worst;                    // which hand that was
};

/// The largest gain of a run between ticks without contact, and without the pull of a guide, in
/// which no spring holds energy, while the force is ramped in: what a force gives that a fault
/// ramps out is not counted.
double gain_J(const RigRun& run);

/// A hand that goes at random about a solid, in and out of it, while stiffness, damping, radius and
/// friction change. Its own stiffness and damping are random on a linkage (`machine`, as of Rig),
/// unless `settings` have a hand_mass.
RigRun random_run(const std::string& machine, double stiffest_N_per_m, uint64_t seed,
                  Lines settings);
/// The runs of seeds from 1.
HandsGain random_hands(const std::string& machine, double stiffest_N_per_m, uint32_t hands,
                       const Lines& settings);

enum class About { kGuide, kGuideInSolid };
/// The same of hands that go about a guide of random corners, which holds them all the time, while
/// its settings change; or about one that also pulls into a solid, whose settings change, too.
RigRun random_guided_run(const std::string& machine, double stiffest_N_per_m, uint64_t seed,
                         Lines settings, About about = About::kGuide);
HandsGain guided_hands(const std::string& machine, double stiffest_N_per_m, uint32_t hands,
                       const Lines& settings, About about = About::kGuide);

/// The same of hands with a mass (hand/hands.hpp) in turn, each grip of each.
HandsGain massive_hands(const std::string& machine, double stiffest_N_per_m, uint32_t hands,
                        const Lines& settings);

enum class Against { kPlate, kGuide };
/// Hands that knock on a plate, or go about a guide of four corners, changed from random ones to
/// the one that gains most: its aim, speed and impedance, stiffness and damping of contact or
/// guide, and the corners. On a linkage every start has its own pose.
HandsGain worst_hand(const std::string& machine, double stiffest_N_per_m, Against against,
                     uint32_t starts, uint32_t tries, const Lines& settings);

}  // namespace firmtouch::host_sim
