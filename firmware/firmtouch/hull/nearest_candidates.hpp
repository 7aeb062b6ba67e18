#pragma once
// Pending crossings of a refinement, nearest first. For the library's own translation units.

#include "firmtouch/hull/box_descent.hpp"
#include "firmtouch/hull/refinement.hpp"

namespace firmtouch::hull {

// Candidate::what: bit 31, a triangle of the mesh; bit 30, the segment enters there; the triangle
// or the collapse that made the face.
constexpr uint32_t kOfMesh = 0x80000000u, kEnters = 0x40000000u, kIndex = 0x3FFFFFFFu;

static inline bool is_before(const Candidate& a, const Candidate& b) {
  return a.t < b.t || (a.t <= b.t && (a.what & kIndex) < (b.what & kIndex));
}

// Heap with the nearest candidate on top. If it is full, the farthest is dropped; `horizon` is the
// time of the nearest one dropped.
class Nearest {
 public:
  explicit Nearest(core::Span<Candidate> buffer) : buffer_(buffer) {}
  float horizon = Slabs::kNever;

  bool is_empty() const { return count_ == 0; }
  void push(const Candidate& candidate) {
    if (count_ == buffer_.size()) {
      uint32_t farthest = 0;
      for (uint32_t i = 1; i < count_; ++i)
        if (is_before(buffer_[farthest], buffer_[i])) farthest = i;
      const bool gives_way = is_before(candidate, buffer_[farthest]);
      const float lost = gives_way ? buffer_[farthest].t : candidate.t;
      if (lost < horizon) horizon = lost;
      if (gives_way) rise(farthest, candidate);
      return;
    }
    rise(count_++, candidate);
  }
  Candidate pop() {
    const Candidate top = buffer_[0], last = buffer_[--count_];
    uint32_t at = 0;
    while (2 * at + 1 < count_) {
      uint32_t child = 2 * at + 1;
      if (child + 1 < count_ && is_before(buffer_[child + 1], buffer_[child])) ++child;
      if (!is_before(buffer_[child], last)) break;
      buffer_[at] = buffer_[child];
      at = child;
    }
    if (count_ != 0) buffer_[at] = last;
    return top;
  }

 private:
  void rise(uint32_t at, const Candidate& candidate) {
    for (; at > 0 && is_before(candidate, buffer_[(at - 1) / 2]); at = (at - 1) / 2)
      buffer_[at] = buffer_[(at - 1) / 2];
    buffer_[at] = candidate;
  }
  core::Span<Candidate> buffer_;
  uint32_t count_ = 0;
};

}  // namespace firmtouch::hull
