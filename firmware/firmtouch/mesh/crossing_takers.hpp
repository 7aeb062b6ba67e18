#pragma once
// Policies of a segment search: which crossings it keeps. For the library's own translation units.

#include "firmtouch/mesh/segment_cast.hpp"
#include "firmtouch/mesh/segment_frame.hpp"

namespace firmtouch::mesh {

// limit: the largest t that is still of interest. take(): whether more are wanted.

struct OneHit {
  Hit& hit;
  float limit = 1;

  explicit OneHit(Hit& reported) : hit(reported) {}
  void set(const Crossing& crossing, uint32_t triangle) {
    hit.hit = true;
    hit.t = crossing.t;
    hit.triangle = triangle;
    hit.enters = crossing.direction < 0;
  }
};

struct First : OneHit {
  using OneHit::OneHit;

  bool take(const Crossing& crossing, uint32_t triangle) {
    const bool is_first =
        !hit.hit || crossing.t < hit.t || (crossing.t <= hit.t && triangle < hit.triangle);
    if (!is_first) return true;
    set(crossing, triangle);
    // t has an error, so a box that is entered later may hold a crossing with a smaller t.
    limit = smaller(crossing.t + 2.0f * kTimeError, 1.0f);
    return true;
  }
};

struct Any : OneHit {
  using OneHit::OneHit;

  bool take(const Crossing& crossing, uint32_t triangle) {
    set(crossing, triangle);
    return false;
  }
};

class All {
 public:
  explicit All(core::Span<SurfaceCrossing> buffer) : buffer_(buffer) {}
  float limit = 1;
  Crossings crossings;

  bool take(const Crossing& crossing, uint32_t triangle) {
    ++crossings.found;
    uint32_t at = crossings.reported;
    if (at < buffer_.size()) {
      ++crossings.reported;
    } else if (at == 0 || !is_before(crossing.t, triangle, buffer_[at - 1])) {
      return true;
    } else {
      --at;  // the last one is dropped
    }
    for (; at > 0 && is_before(crossing.t, triangle, buffer_[at - 1]); --at)
      buffer_[at] = buffer_[at - 1];
    buffer_[at] = {crossing.t, triangle, crossing.direction < 0};
    return true;
  }

 private:
  static bool is_before(float t, uint32_t triangle, const SurfaceCrossing& other) {
    return t < other.t || (t <= other.t && triangle < other.triangle);
  }
  core::Span<SurfaceCrossing> buffer_;
};

}  // namespace firmtouch::mesh
