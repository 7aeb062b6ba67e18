#pragma once
// The search for the closest point of straight segments: the room's inner loop, for .cpp files of
// this room only.

#include "firmtouch/curve/run_search.hpp"
#include "firmtouch/curve/segment.hpp"

namespace firmtouch::curve {

/// Keeps the closest point of the runs that it is offered.
template <bool kCareful>
class NearestFoot {
 public:
  NearestFoot(const View& curve, math::Vec3 p_m)
      : samples_(curve.samples().data()),
        runs_(curve.runs().data()),
        segment_count_(curve.segment_count()),
        p_m_(p_m) {}

  const Foot& best() const { return best_; }
  float reach2_m2() const { return best_.distance2_m2; }

  /// The first sample.
  void begin_at_first() {
    const math::Vec3 from_m = p_m_ - vec(samples_[0]);
    best_.distance2_m2 = dot(from_m, from_m);
    if constexpr (kCareful)
      best_.distance2_m2 = careful_distance2(p_m_, vec(samples_[0]), vec(samples_[0]), 0.0f);
    radius_m_ = math::square_root(best_.distance2_m2) * (1.0f + 0x1p-20f);
  }

  /// From a segment near by along the curve to one where the foot lies within it, or to where that
  /// no longer helps: by the segment's own line where that is not far, else by the straight line of
  /// the segments about it, whose spacing is evener. A few are looked at, whatever the curve.
  /// Result: the segment of the best point.
  uint32_t follow(uint32_t segment) {
    for (uint32_t i = 0; i < kMaxJumps; ++i) {
      const float before_m2 = best_.distance2_m2, ahead = look_at(segment);
      if ((ahead >= 0.0f && ahead < 1.0f) || !(best_.distance2_m2 < before_m2)) break;
      const uint32_t to = ahead >= -2.0f && ahead <= 3.0f
                              ? clamped(static_cast<int32_t>(segment) +
                                        static_cast<int32_t>(ahead) - (ahead < 0.0f ? 1 : 0))
                              : beside(segment);
      if (to == segment) break;
      segment = to;
    }
    return segment_of(best_);
  }

  /// The run of the best point so far: its part of the last level, then, level by level, what lies
  /// beside.
  void begin(uint32_t run) {
    const uint32_t first_of_run = run * kRunSegments, found = segment_of(best_);
    uint32_t part = (found - first_of_run) / kPartSegments;
    uint32_t first = first_of_run + part * kPartSegments;
    part += kParts / 2;
    take_segments(first, found);
    const uint16_t* const radii = runs_[run].radius;
    for (uint32_t size = kPartSegments; size < kRunSegments; size *= 2) {
      if ((part & 1u) != 0) {
        const uint32_t after = first + size;
        if (after < segment_count_) {
          const uint32_t end = after + size, last = end < segment_count_ ? end : segment_count_;
          if (near_part(samples_[after], samples_[last], radii[part + 1]) >= 0.0f)
            take_part(run, {part + 1, after}, size);
        }
      } else {
        const uint32_t before = first - size;
        if (near_part(samples_[first], samples_[before], radii[part - 1]) >= 0.0f) {
          is_second_ = true;
          take_part(run, {part - 1, before}, size);
        }
        first = before;
      }
      part = parent_of(part);
    }
  }

  void take(uint32_t run) {
    const Cut whole{0, run * kRunSegments};
    if (may_hold(run, whole, kRunSegments, best_.sample > whole.first))
      take_part(run, whole, kRunSegments);
  }

 private:
  static constexpr uint32_t kMaxJumps = 4;
  static constexpr uint32_t kAbout = 8;  // segments on either side

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
    constexpr float kMost = 4194304.0f;  // samples that a curve may have
    const float ahead = progress < kMost * length2
                            ? progress > -kMost * length2 ? progress / length2 : 0.0f
                            : kMost;
    return clamped(static_cast<int32_t>(first) + static_cast<int32_t>(ahead));
  }

  /// A part of a run and its first segment.
  struct Cut {
    uint32_t part;
    uint32_t first;
  };

  /// A part that may hold a nearer point, by halves, the one first on whose side the foot lies.
  void take_part(uint32_t run, Cut cut, uint32_t size) {
    Cut pending[kRunLevels + 1];
    uint32_t count = 0;
    uint32_t level_size[kRunLevels + 1];
    for (;;) {
      if (size == kPartSegments) {
        take_segments(cut.first, kNoRun);
      } else {
        size /= 2;
        const Cut low{first_child(cut.part), cut.first};
        const Cut high{low.part + 1, low.first + size};
        const bool second = is_second_;
        pending[count] = second ? low : high;
        level_size[count++] = size;
        cut = second ? high : low;
        if (may_hold(run, cut, size, !second)) continue;
      }
      do {
        if (count == 0) return;
        cut = pending[--count];
        size = level_size[count];
      } while (!may_hold(run, cut, size, (cut.part & 1u) != 0));
    }
  }

  /// Whether a part of a run may hold a point nearer than the best. Reckoned from the end where the
  /// query is expected to lie beyond: most parts are left out without a division.
  bool may_hold(uint32_t run, Cut cut, uint32_t size, bool from_last) {
    if (cut.first >= segment_count_) return false;
    const uint32_t end = cut.first + size, last = end < segment_count_ ? end : segment_count_;
    const uint16_t radius = runs_[run].radius[cut.part];
    const float t = from_last ? near_part(samples_[last], samples_[cut.first], radius)
                              : near_part(samples_[cut.first], samples_[last], radius);
    is_second_ = (t > 0.5f) != from_last;
    return t >= 0.0f;
  }

  /// Where the foot lies on the straight line between two samples, 0 to 1; less than 0 where all
  /// within the radius of that line is farther than the best.
  float near_part(const Sample& near, const Sample& far, uint16_t radius) const {
    const math::Vec3 near_m = vec(near), from_m = p_m_ - near_m, along_m = vec(far) - near_m;
    const float limit_m = radius_m_ + radius_m_of(radius), limit2_m2 = limit_m * limit_m;
    const float progress = dot(from_m, along_m);
    if (!(progress > 0.0f)) return dot(from_m, from_m) < limit2_m2 ? 0.0f : -1.0f;
    const float length2 = dot(along_m, along_m);
    const float t = progress < length2 ? progress / length2 : 1.0f;
    const math::Vec3 rest_m = from_m - along_m * t;
    return dot(rest_m, rest_m) < limit2_m2 ? t : -1.0f;
  }

  /// With v = p - sample, the foot lies within a segment only where v . v' of its ends is less than
  /// both squares; rounding loses less than 8 u of these.
  static bool is_between(math::Vec3 from_m, math::Vec3 next_m, float from2_m2, float next2_m2) {
    const float across_m2 = dot(from_m, next_m) * (1.0f - 8.0f * 0x1p-24f);
    return across_m2 < from2_m2 && across_m2 < next2_m2;
  }

  /// The segments of a part of the last level, but for one that is known.
  void take_segments(uint32_t first, uint32_t but) {
    const uint32_t after = first + kPartSegments;
    const uint32_t end = after < segment_count_ ? after : segment_count_;
    math::Vec3 from_m = p_m_ - vec(samples_[first]);
    float from2_m2 = dot(from_m, from_m);
    for (uint32_t segment = first;; ++segment) {
      if (!kCareful && from2_m2 < best_.distance2_m2) take_sample(segment, from2_m2);
      if (segment == end) return;
      const math::Vec3 next_m = p_m_ - vec(samples_[segment + 1]);
      const float next2_m2 = dot(next_m, next_m);
      if (segment != but && (kCareful || is_between(from_m, next_m, from2_m2, next2_m2)))
        (void)look_at(segment);
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
  float look_at(uint32_t segment) {
    const math::Vec3 a_m = vec(samples_[segment]), b_m = vec(samples_[segment + 1]);
    const math::Vec3 along_m = b_m - a_m;
    math::Vec3 from_m = p_m_ - a_m;
    const float length2_m2 = dot(along_m, along_m);
    const float ahead = dot(from_m, along_m) / length2_m2;
    float t = ahead;
    bool is_back = false;
    if (ahead > 0.5f) {
      from_m = p_m_ - b_m;
      t = -dot(from_m, along_m) / length2_m2;
      is_back = true;
    }
    if (!(t > 0.0f)) t = 0.0f;
    const math::Vec3 rest_m = is_back ? from_m + along_m * t : from_m - along_m * t;
    float distance2_m2 = dot(rest_m, rest_m);
    if constexpr (kCareful) {
      if (!(distance2_m2 <= best_.distance2_m2 * (1.0f + 0x1p-16f))) return ahead;
      distance2_m2 =
          is_back ? careful_distance2(p_m_, b_m, a_m, t) : careful_distance2(p_m_, a_m, b_m, t);
    }
    if (distance2_m2 < best_.distance2_m2) {
      best_.distance2_m2 = distance2_m2;  // one by one: an aggregate would be built aside first
      best_.sample = is_back ? segment + 1 : segment;
      best_.neighbour = is_back ? segment : segment + 1;
      best_.t = t;
      // Rounded up by more than the search loses in comparing squares.
      radius_m_ = math::square_root(distance2_m2) * (1.0f + 0x1p-20f);
    }
    return ahead;
  }

  const Sample* samples_;
  const Run* runs_;
  uint32_t segment_count_;
  math::Vec3 p_m_;
  float radius_m_ = 0x1p62f;  // more than any distance that comes here
  bool is_second_ = false;
  Foot best_{FLT_MAX, 0, 1, 0.0f};
};

}  // namespace firmtouch::curve
