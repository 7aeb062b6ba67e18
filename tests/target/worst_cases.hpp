#pragma once
#include "target/random.hpp"

namespace firmtouch::target {

/// The sixteen cases of a search that took most, by a member of theirs: the next cases lie about
/// one of them.
template <class Case, auto kTaken>
class WorstCases {
 public:
  const Case& any(Random& random) const { return cases_[random.below(kSize)]; }
  /// Replaces the one that took least, if `tried` took more.
  void keep(const Case& tried) {
    Case* least = cases_;
    for (Case& one : cases_)
      if (one.*kTaken < least->*kTaken) least = &one;
    if (tried.*kTaken > least->*kTaken) *least = tried;
  }

  static constexpr uint32_t kSize = 16;

 private:
  Case cases_[kSize];
};

}  // namespace firmtouch::target
