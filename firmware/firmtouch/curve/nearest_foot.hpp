#pragma once
// The search for the closest point of straight segments: the module's inner loop, for .cpp files of
// this module only.

#include "firmtouch/curve/run_search.hpp"
#include "firmtouch/curve/segment.hpp"

namespace firmtouch::curve {

/// How an ascent from a segment ended: budget spent, top of the run, or safe subtree.
enum class Ascent : uint8_t { kSpent, kRun, kSafeSubtree };

/// Keeps the closest point of the runs that it is offered.
/// The inner loops know at compile time whether distances are compensated: a flag costs 8 %.
class NearestFoot {
 public:
  NearestFoot(const View& curve, math::Vec3 p_m, bool compensated)
      : samples_(curve.samples().data()),
        radii_(curve.radii().data()),
        levels_(curve.run_levels()),
        segment_count_(curve.segment_count()),
        p_m_(p_m),
        compensated_(compensated) {}

  const Foot& best() const { return best_; }
  float reach2_m2() const { return best_.distance2_m2; }

  /// The first sample.
  void begin_at_first() {
    const math::Vec3 from_m = p_m_ - vec(samples_[0]);
    best_.distance2_m2 = dot(from_m, from_m);
    if (compensated_)
      best_.distance2_m2 = compensated_distance2(p_m_, vec(samples_[0]), vec(samples_[0]), 0.0f);
    radius_m_ = math::square_root(best_.distance2_m2) * (1.0f + 0x1p-20f);
  }

  /// From a segment near by along the curve to one where the foot lies within it, or to where that
  /// no longer helps: by the segment's own line where that is not far, else by the straight line of
  /// the segments about it, whose spacing is evener. A few are looked at, whatever the curve.
  /// Result: the segment of the best point.
  template <bool kCompensated>
  uint32_t follow(uint32_t segment) {
    float before_m2 = FLT_MAX;
    for (uint32_t i = 0; i < kMaxJumps; ++i) {
      const float offset = look<kCompensated>(segment);
      if ((offset >= 0.0f && offset < 1.0f) || !(best_.distance2_m2 < before_m2)) break;
      before_m2 = best_.distance2_m2;
      const uint32_t to = offset >= -2.0f && offset <= 3.0f
                              ? clamped(static_cast<int32_t>(segment) +
                                        static_cast<int32_t>(offset) - (offset < 0.0f ? 1 : 0))
                              : beside(segment);
      if (to == segment) break;
      segment = to;
    }
    return segment_of(best_);
  }

  [[gnu::noinline]] float look_compensated(uint32_t segment) { return look_at<true>(segment); }

  /// More than the distance of the best point so far.
  float radius_m() const { return radius_m_; }
  float others_m() const { return others_m_; }
  /// Units taken beyond visits.
  uint32_t charged() const { return charged_; }

  /// The run of the best point so far: its part of the last level, then the sibling on each level
  /// up to the top, or up to the safe subtree and its neighbours.
  template <bool kHot>
  [[gnu::always_inline]] inline Ascent begin(uint32_t run, uint32_t safe_subtree, uint32_t& left) {
    const uint32_t found = segment_of(best_);
    const uint32_t node = run << (levels_ + 1), stop = safe_subtree - node;
    const uint16_t* const radii = radii_ + node;
    const uint32_t least = (1u << levels_) - 1;  // the first part of the last level
    uint32_t first = found - found % kPartSegments, size = kPartSegments;
    uint32_t part = (found / kPartSegments & least) + least;
    kHot ? take_each<false>(first, found) : take_segments(first, found);
    for (; part != stop; size *= 2) {
      if (part == 0) return Ascent::kRun;
      if (!take_sibling<kHot>(radii, part, first, size, (part & 1u) != 0, left))
        return Ascent::kSpent;
      if ((part & 1u) == 0) first -= size;
      part = parent_of(part);
    }
    // Its neighbours, unless it is the last or the first part of its level. In one place: 0.35 kB.
    for (uint32_t i = 0; i != 2; ++i) {
      const bool is_after = i == 0;
      const uint32_t border = is_after ? part + 1 : part;
      if ((border & (border + 1)) == 0) continue;
      if (!take_sibling<kHot>(radii, part, first, size, is_after, left)) return Ascent::kSpent;
    }
    return Ascent::kSafeSubtree;
  }

  /// Safe subtree: the part of the run around the best point whose ends are some motions apart.
  /// Everything except it and its two neighbours of the same size is certified to be at least
  /// safe_subtree_m from the query. None if the run is too short. Part k of run r is node r *
  /// (parts of a run + 1) + k. Pre: all other runs are at least `outside_m` away.
  void make_safe_subtree(uint32_t run, float motion_m, float spacing_m, float outside_m,
                         Hint& hint) const {
    const uint32_t segments = run_segments_of(levels_), run_first = run * segments;
    const float min_m = kSafeSubtreeMotions * motion_m;
    uint32_t size = kPartSegments, first = segment_of(best_);
    for (float mean_m = 4.0f * spacing_m; mean_m < min_m && size < segments; mean_m *= 2.0f)
      size *= 2;
    for (;; size *= 2) {
      if (size >= segments / 2) return;
      first &= 0u - size;
      if (first + size > segment_count_) return;
      const math::Vec3 along_m = vec(samples_[first + size]) - vec(samples_[first]);
      if (dot(along_m, along_m) >= min_m * min_m) break;
    }
    // The part of `size` segments from `first` is node before + (within + first) / size.
    const uint32_t before = (run << (levels_ + 1)) - 1, within = segments - run_first;
    hint.safe_subtree = before + (within + first) / size;
    // Parts of falling, then of rising size, from both ends to the neighbours.
    for (uint32_t to = first != run_first ? first - size : first; to != run_first;) {
      const uint32_t step = to & (0u - to);
      to -= step;
      const uint16_t radius = radii_[before + (within + to) / step];
      outside_m = smaller(outside_m, part_distance_m(radius, to, step));
    }
    const uint32_t last = run_first + segments;
    const uint32_t end = last < segment_count_ ? last : segment_count_;
    for (uint32_t from = first + 2 * size, step; from < end; from += step) {
      step = from & (0u - from);
      const uint16_t radius = radii_[before + (within + from) / step];
      outside_m = smaller(outside_m, part_distance_m(radius, from, step));
    }
    hint.safe_subtree_m = outside_m;
  }

  /// Out of line: the searches near and far share it.
  /// Result: false where the budget ended.
  [[gnu::noinline]] bool take(uint32_t run, uint32_t& left) {
    const uint32_t size = run_segments_of(levels_);
    const Cut whole{0, run * size};
    const uint16_t* const radii = radii_ + (run << (levels_ + 1));
    const float before_m = others_m_;
    others_m_ = 0.0f;
    if (may_hold(radii, whole, size, best_.sample > whole.first, is_second_))
      return take_part(radii, whole, size, left);
    others_m_ = smaller(before_m, part_distance_m(radii[0], whole.first, size));
    return true;
  }

 private:
  static constexpr uint32_t kMaxJumps = 4;
  static constexpr float kSafeSubtreeMotions = 8.0f;
  static constexpr uint32_t kAbout = 8;  // segments on either side
  // Units of the four segments of a part.
  static constexpr uint32_t kSegmentsWork = 2, kCompensatedWork = 10;

  uint32_t clamped(int32_t segment) const {
    const int32_t last = static_cast<int32_t>(segment_count_) - 1;
    return static_cast<uint32_t>(segment < 0 ? 0 : segment > last ? last : segment);
  }

  uint32_t beside(uint32_t segment) const {
    const uint32_t first = segment < kAbout ? 0 : segment - kAbout;
    const uint32_t after = segment + kAbout, last = after < segment_count_ ? after : segment_count_;
    const math::Vec3 a_m = vec(samples_[first]), along_m = vec(samples_[last]) - a_m;
    const float length2 = dot(along_m, along_m);
    const float progress = dot(p_m_ - a_m, along_m) * static_cast<float>(last - first);
    constexpr float kMax = 4194304.0f;  // samples that a curve may have
    const float offset =
        progress < kMax * length2 ? progress > -kMax * length2 ? progress / length2 : 0.0f : kMax;
    return clamped(static_cast<int32_t>(first) + static_cast<int32_t>(offset));
  }

  /// A part of a run and its first segment.
  struct Cut {
    uint32_t part;
    uint32_t first;
  };

  /// The part of this size after, or before, the one that begins with `first`.
  /// Result: false where the budget ended.
  [[gnu::always_inline]] inline bool take_beside(const uint16_t* radii, uint32_t part,
                                                 uint32_t first, uint32_t size, bool is_after,
                                                 uint32_t& left) {
    if (size >= kVisitSegments) {
      if (left == 0) return false;
      --left;
    }
    // From its end on this side.
    uint32_t near = first, far = first - size;
    if (is_after) {
      near = first + size;
      if (near >= segment_count_) return true;
      far = near + size < segment_count_ ? near + size : segment_count_;
    }
    const uint32_t beside = is_after ? part + 1 : part - 1;
    const float limit_m = radius_m_ + radius_m_of(radii[beside]);
    const Off off = off_chord(samples_[near], samples_[far]);
    if (!(off.distance2_m2 < limit_m * limit_m)) return true;
    is_second_ = !is_after;
    return take_part(radii, {beside, is_after ? near : far}, size, left);
  }

  [[gnu::noinline]] bool take_beside_cold(const uint16_t* radii, uint32_t part, uint32_t first,
                                          uint32_t size, bool is_after, uint32_t& left) {
    return take_beside(radii, part, first, size, is_after, left);
  }
  template <bool kHot>
  [[gnu::always_inline]] inline bool take_sibling(const uint16_t* radii, uint32_t part,
                                                  uint32_t first, uint32_t size, bool is_after,
                                                  uint32_t& left) {
    return kHot ? take_beside(radii, part, first, size, is_after, left)
                : take_beside_cold(radii, part, first, size, is_after, left);
  }

  /// Certified distance to the part of this radius that begins with `first`.
  [[gnu::noinline]] float part_distance_m(uint16_t radius, uint32_t first, uint32_t size) const {
    const uint32_t end = first + size, last = end < segment_count_ ? end : segment_count_;
    const float distance2_m2 = off_chord(samples_[first], samples_[last]).distance2_m2;
    return math::square_root(distance2_m2) * (1.0f - 0x1p-20f) - radius_m_of(radius);
  }
  static float smaller(float a, float b) { return a < b ? a : b; }

  /// A small part is a unit; units are charged at the end, and leave visits less.
  /// Result: false where a part is a visit and none is left.
  [[gnu::always_inline]] static inline bool spend(uint32_t size, uint32_t& units, uint32_t& left) {
    if (left <= units) return false;
    if (size < kVisitSegments)
      ++units;
    else
      --left;
    return true;
  }

  /// A part that may hold a nearer point, by halves, the one first on whose side the foot lies.
  /// Result: false where the budget ended.
  bool take_part(const uint16_t* radii, Cut cut, uint32_t size, uint32_t& left) {
    uint32_t units = 0, visits_left = left;
    const bool is_done = take_halves(radii, cut, size, units, visits_left);
    charge(units, visits_left, charged_);
    left = visits_left;
    return is_done;
  }
  [[gnu::always_inline]] inline bool take_halves(const uint16_t* radii, Cut cut, uint32_t size,
                                                 uint32_t& units, uint32_t& left) {
    struct Half {
      Cut cut;
      uint32_t size;
    };
    bool is_second = is_second_;
    Half pending[kMaxRunLevels + 1];
    Half* top = pending;
    for (;;) {
      if (size == kPartSegments) {
        take_segments(cut.first, kNoRun);
        units += compensated_ ? kCompensatedWork : kSegmentsWork;
      } else {
        size /= 2;
        const uint32_t second = is_second ? 1 : 0, low = first_child(cut.part);
        const uint32_t on = size & (0u - second);
        top->cut.part = low + 1 - second;  // one by one: an aggregate is built on the stack first
        top->cut.first = cut.first + size - on;
        top->size = size;
        ++top;
        cut.part = low + second;
        cut.first += on;
        if (!spend(size, units, left)) return false;
        if (may_hold(radii, cut, size, second == 0, is_second)) continue;
      }
      do {
        if (top == pending) return true;
        --top;
        cut.part = top->cut.part;
        cut.first = top->cut.first;
        size = top->size;
        if (!spend(size, units, left)) return false;
      } while (!may_hold(radii, cut, size, (cut.part & 1u) != 0, is_second));
    }
  }

  /// Whether a part of a run may hold a point nearer than the best. Computed from the end beyond
  /// which the query is expected: most parts are pruned without a division.
  bool may_hold(const uint16_t* radii, Cut cut, uint32_t size, bool from_last, bool& is_second) {
    if (cut.first >= segment_count_) return false;
    const uint32_t end = cut.first + size, last = end < segment_count_ ? end : segment_count_;
    const float limit_m = radius_m_ + radius_m_of(radii[cut.part]);
    const Off off = from_last ? off_chord(samples_[last], samples_[cut.first])
                              : off_chord(samples_[cut.first], samples_[last]);
    is_second = (off.t > 0.5f) != from_last;
    return off.distance2_m2 < limit_m * limit_m;
  }

  /// How far the query is from the straight line between two samples, and where on it, 0 to 1, the
  /// foot lies.
  struct Off {
    float distance2_m2, t;
  };
  Off off_chord(const Sample& near, const Sample& far) const {
    const math::Vec3 near_m = vec(near), from_m = p_m_ - near_m, along_m = vec(far) - near_m;
    const float progress = dot(from_m, along_m);
    if (!(progress > 0.0f)) return {dot(from_m, from_m), 0.0f};
    const float length2 = dot(along_m, along_m);
    const float t = progress < length2 ? progress / length2 : 1.0f;
    const math::Vec3 rest_m = from_m - along_m * t;
    return {dot(rest_m, rest_m), t};
  }

  /// With v = p - sample, the foot lies within a segment only where v . v' of its ends is less than
  /// both squares; rounding loses less than 8 u of these.
  static bool is_between(math::Vec3 from_m, math::Vec3 next_m, float from2_m2, float next2_m2) {
    const float across_m2 = dot(from_m, next_m) * (1.0f - 8.0f * 0x1p-24f);
    return across_m2 < from2_m2 && across_m2 < next2_m2;
  }

  /// The segments of a part of the last level, except one that is known.
  [[gnu::noinline]] void take_segments(uint32_t first, uint32_t but) {
    compensated_ ? take_each<true>(first, but) : take_each<false>(first, but);
  }
  template <bool kCompensated>
  void take_each(uint32_t first, uint32_t but) {
    const uint32_t after = first + kPartSegments;
    const uint32_t end = after < segment_count_ ? after : segment_count_;
    math::Vec3 from_m = p_m_ - vec(samples_[first]);
    float from2_m2 = dot(from_m, from_m);
    for (uint32_t segment = first;; ++segment) {
      if (from2_m2 < best_.distance2_m2 && !kCompensated) take_sample(segment, from2_m2);
      if (segment == end) return;
      const math::Vec3 next_m = p_m_ - vec(samples_[segment + 1]);
      const float next2_m2 = dot(next_m, next_m);
      if (segment != but && (kCompensated || is_between(from_m, next_m, from2_m2, next2_m2)))
        (void)look<kCompensated>(segment);
      from_m = next_m;
      from2_m2 = next2_m2;
    }
  }

  void take_sample(uint32_t sample, float distance2_m2) {
    best_.distance2_m2 = distance2_m2;
    best_.sample = sample;
    best_.neighbour = sample < segment_count_ ? sample + 1 : sample - 1;
    best_.t = 0.0f;
    radius_m_ = math::square_root(distance2_m2) * (1.0f + 0x1p-20f);
  }

  /// Result: where the foot would be on the segment's straight line, in lengths of the segment.
  template <bool kCompensated>
  [[gnu::always_inline]] inline float look_at(uint32_t segment) {
    const math::Vec3 a_m = vec(samples_[segment]), b_m = vec(samples_[segment + 1]);
    const math::Vec3 along_m = b_m - a_m;
    math::Vec3 from_m = p_m_ - a_m;
    const float length2_m2 = dot(along_m, along_m);
    const float offset = dot(from_m, along_m) / length2_m2;
    float t = offset;
    bool is_back = false;
    if (offset > 0.5f) {
      from_m = p_m_ - b_m;
      t = -dot(from_m, along_m) / length2_m2;
      is_back = true;
    }
    if (!(t > 0.0f)) t = 0.0f;
    const math::Vec3 rest_m = is_back ? from_m + along_m * t : from_m - along_m * t;
    float distance2_m2 = dot(rest_m, rest_m);
    if constexpr (kCompensated) {
      if (!(distance2_m2 <= best_.distance2_m2 * (1.0f + 0x1p-16f))) return offset;
      distance2_m2 = is_back ? compensated_distance2(p_m_, b_m, a_m, t)
                             : compensated_distance2(p_m_, a_m, b_m, t);
    }
    if (distance2_m2 < best_.distance2_m2) {
      best_.distance2_m2 = distance2_m2;  // one by one: an aggregate would be built aside first
      best_.sample = is_back ? segment + 1 : segment;
      best_.neighbour = is_back ? segment : segment + 1;
      best_.t = t;
      // Rounded up by more than the search loses in comparing squares.
      radius_m_ = math::square_root(distance2_m2) * (1.0f + 0x1p-20f);
    }
    return offset;
  }

  template <bool kCompensated>
  [[gnu::always_inline]] inline float look(uint32_t segment) {
    return kCompensated ? look_compensated(segment) : look_at<false>(segment);
  }

  const Sample* samples_;
  const uint16_t* radii_;
  uint32_t levels_;
  uint32_t segment_count_;
  math::Vec3 p_m_;
  bool compensated_;
  float radius_m_ = 0x1p62f;  // more than any distance that comes here
  float others_m_ = 0x1p62f;
  uint32_t charged_ = 0;
  bool is_second_ = false;
  Foot best_{FLT_MAX, 0, 1, 0.0f};
};

}  // namespace firmtouch::curve
