#include <cstdio>
#include <iostream>

#include "host_sim/commands/commands.hpp"
#include "host_sim/hand/hands.hpp"
#include "host_sim/hand/palm.hpp"
#include "json/json.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kFrequencies_Hz[] = {1, 3, 10, 30, 100};

struct Grip {
  const char* name;
  HandModel KnownHand::*model;
};
constexpr Grip kGrips[] = {
    {"weak", &KnownHand::weak}, {"mean", &KnownHand::mean}, {"firm", &KnownHand::firm}};

std::string json_of(const KnownHand& hand) {
  tools::Json all;
  all.add("name", tools::json_text(hand.name)).add("form", tools::json_text(hand.form));
  for (const Grip& grip : kGrips) {
    const HandModel& model = hand.*grip.model;
    tools::Json values;
    for (const HandKey& key : hand_keys()) values.add(key.name, model.*key.member);
    all.add(grip.name, values.object());
  }
  return all.add("assumed", tools::json_text(hand.assumed)).object();
}

int print_hands(const cli::Arguments& options) {
  if (options.has("--json")) {
    std::cout << tools::json_list(known_hands(), json_of) << "\n";
    return 0;
  }
  for (const KnownHand& hand : known_hands()) {
    std::printf("%s: %s\n", hand.name, hand.form);
    std::printf("  assumed: %s\n", hand.assumed);
    std::printf("  %-5s", "");
    for (const HandKey& key : hand_keys()) std::printf(" %18s", key.name);
    for (const double frequency_Hz : kFrequencies_Hz) std::printf(" %3.0f Hz", frequency_Hz);
    std::printf("\n");
    for (const Grip& grip : kGrips) {
      const HandModel& model = hand.*grip.model;
      std::printf("  %-5s", grip.name);
      for (const HandKey& key : hand_keys()) std::printf(" %18g", model.*key.member);
      for (const double frequency_Hz : kFrequencies_Hz)
        std::printf(" %6.0f", impedance_N_per_m(model, frequency_Hz));
      std::printf("\n");
    }
  }
  std::printf(
      "N/m, N*s/m, kg; the last columns: force over amplitude of a grip that moves by a sine, in "
      "N/m.\n"
      "What is assumed is of the publication's form, but not its figure.\n");
  return 0;
}

}  // namespace

cli::Command hands_command() {
  return {{"hands", "[options]", 0, 0, print_hands},
          "lists hands with a mass for scenarios, `hand NAME weak|mean|firm`, and their impedance",
          "A grip, spring and damper, between device and mass; another pair from the mass to the "
          "target.",
          {{"--json", nullptr, "for programs"}}};
}

}  // namespace firmtouch::host_sim
