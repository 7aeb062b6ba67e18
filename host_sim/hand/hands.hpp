#pragma once
#include <string>
#include <vector>

#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {

/// A hand of the kind that a publication identified. Only the form of its model is from there:
/// every value is assumed, since none could be read in its source.
struct KnownHand {
  const char *name, *form;
  HandModel weak, mean, firm;  // of a grip; the spread of its source's people is not known here
};

const std::vector<KnownHand>& known_hands();

/// Name and grip: "pinch", "weak", "mean" or "firm". Result: null if there is none.
const HandModel* find_hand(const std::string& name, const std::string& grip);
/// "pinch, stylus, arm"
std::string hand_names();

/// The keys of a scenario that a hand stands for, with its values.
struct HandKey {
  const char *name, *unit;
  double HandModel::*member;
};
const std::vector<HandKey>& hand_keys();

}  // namespace firmtouch::host_sim
