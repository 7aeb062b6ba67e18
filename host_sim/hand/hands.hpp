#pragma once
#include <string>
#include <vector>

#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {

/// A hand of the kind that a publication identified. Where its values could not be read there, only
/// the form of its model is from it.
struct KnownHand {
  const char *name, *form;
  const char* assumed;         // which of the values
  HandModel weak, mean, firm;  // of a grip; the spread of its source's people is not known here
};

const std::vector<KnownHand>& known_hands();

/// Name and grip: "pinch", "weak", "mean" or "firm". Result: null if there is none.
const HandModel* find_hand(const std::string& name, const std::string& grip);
/// "pinch, stylus, arm, handle"
std::string hand_names();

/// The keys of a scenario that a hand stands for, with its values.
struct HandKey {
  const char *name, *unit;
  double HandModel::*member;
};
const std::vector<HandKey>& hand_keys();

}  // namespace firmtouch::host_sim
