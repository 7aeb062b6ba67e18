#pragma once
// What a search of surfaces passes over becomes the next query's frontier, for .cpp files of this
// module only.
//
// A frontier says: all of the model lies in its parts or is at least `outside` units beyond base_m
// away, and each part is as far as it says. After a motion m everything is nearer by m at most, so
// that m taken off base_m keeps all of it true; what is then still beyond the limit is not looked
// at. A part that is looked at is left in the frontier with its new bound, or replaced by the parts
// of it that were passed over, which hold all of it. What a proof returned, as every distance
// computed here, may be off by what float32 loses of it, which certified() takes off: reported_m()
// is rounded down by more than that may differ from one query to the next.
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/spline/hint.hpp"
#include "firmtouch/spline/surface/patch_node.hpp"

namespace firmtouch::spline {

/// Parts that need not be looked at, each with a lower bound of its distance.
class FarNodes {
 public:
  struct Far {
    uint32_t node;
    float lower_m;
  };
  FarNodes() {}  // by hand: else all is cleared

  /// What is at least reach_m away is not kept.
  void start(float reach_m) {
    reach_m_ = reach_m;
    count_ = 0;
    is_all_ = true;
  }
  void pass(uint32_t node, float lower_m) {
    if (lower_m < reach_m_) keep(node, lower_m);
  }
  uint32_t count() const { return count_; }
  bool is_all() const { return is_all_; }
  /// What is not kept is at least so far away.
  float around_m() const { return reach_m_; }
  const Far* begin() const { return nodes_; }
  const Far* end() const { return nodes_ + count_; }

  static constexpr uint32_t kMax = Frontier::kMax;

 private:
  [[gnu::noinline]] void keep(uint32_t node, float lower_m) {
    if (count_ < kMax) {
      nodes_[count_++] = {node, lower_m};
    } else {
      reach_m_ = lower_m;
      is_all_ = false;
    }
  }

  float reach_m_ = 0.0f;
  uint32_t count_ = 0;
  bool is_all_ = true;
  Far nodes_[kMax];
};

/// A frontier, as one query uses it.
class FrontierUse {
 public:
  static constexpr uint32_t kAll = 255;

  explicit FrontierUse(Frontier& frontier) : frontier_(frontier) {}

  /// Of what is less beyond nothing is certain any more. Its quotient is rounded up by more than
  /// its three roundings.
  bool needs(float limit_m, uint32_t& needed) const {
    const float units = (limit_m - frontier_.base_m) / frontier_.unit_m;
    if (!(units < static_cast<float>(kAll) - 1.0f)) return false;
    needed = units > 0.0f ? static_cast<uint32_t>(units * (1.0f + 0x1p-20f)) + 1 : 1;
    return needed <= frontier_.outside && frontier_.count <= Frontier::kMax;
  }
  /// What is so far away need not be kept. Rounded up, by more than its roundings.
  float outside_m() const {
    const float up_m = static_cast<float>(frontier_.outside) * frontier_.unit_m;
    return frontier_.base_m + up_m * (1.0f + 0x1p-20f) +
           0x1p-21f * __builtin_fabsf(frontier_.base_m);
  }
  /// By how many units a distance is beyond: rounded down.
  uint8_t coded(float lower_m) const {
    const float units = (lower_m - frontier_.base_m) / frontier_.unit_m * (1.0f - 0x1p-20f);
    if (!(units > 0.0f)) return 0;
    return static_cast<uint8_t>(units < static_cast<float>(kAll) ? units
                                                                 : static_cast<float>(kAll));
  }

  void clear() {
    frontier_.unit_m = 0.0f;
    frontier_.count = frontier_.outside = 0;
  }
  void put(uint32_t k, const FarNodes::Far& far) {
    frontier_.node[k] = far.node;
    frontier_.beyond[k] = coded(far.lower_m);
  }
  /// Beside the parts that are left all that was passed over, or as much as there is room for.
  void add(const FarNodes& passed) {
    uint32_t outside = frontier_.outside;
    if (!passed.is_all() && coded(passed.around_m()) < outside) outside = coded(passed.around_m());
    if (frontier_.count + passed.count() > Frontier::kMax)
      outside = max_within(passed, outside, Frontier::kMax - frontier_.count);
    frontier_.outside = static_cast<uint8_t>(outside);
    for (const FarNodes::Far& far : passed)
      if (coded(far.lower_m) < outside) put(frontier_.count++, far);
  }
  /// All that was passed over, as far as it was kept.
  void renew(float limit_m, float reach_m, const FarNodes& passed) {
    frontier_.base_m = limit_m;
    frontier_.unit_m = (reach_m - limit_m) * (1.0f / 256.0f);
    if (!(frontier_.unit_m > 0.0f)) return clear();
    static_assert(FarNodes::kMax <= Frontier::kMax);
    const uint32_t outside = passed.is_all() ? kAll : coded(passed.around_m());
    frontier_.outside = static_cast<uint8_t>(outside);
    frontier_.count = 0;
    for (const FarNodes::Far& far : passed)
      if (coded(far.lower_m) < outside) put(frontier_.count++, far);
  }

 private:
  // The most units that no more parts than there is room for are less beyond than.
  uint32_t max_within(const FarNodes& passed, uint32_t most, uint32_t room) const {
    constexpr uint32_t kWide = 4;
    uint8_t counts[(kAll + 1) >> kWide] = {};
    for (const FarNodes::Far& far : passed) ++counts[coded(far.lower_m) >> kWide];
    uint32_t within = 0, i = 0;
    while (i < (most >> kWide) && within + counts[i] <= room) within += counts[i++];
    return i << kWide;
  }

  Frontier& frontier_;
};

}  // namespace firmtouch::spline
