#include "firmtouch/hull/shell_cast.hpp"

#include "firmtouch/hull/box_descent.hpp"
#include "firmtouch/mesh/crossing_takers.hpp"

namespace firmtouch::hull {
namespace {

using math::Vec3;

Box box_of(const ShellHead& head) {
  return {{head.low_m[0], head.low_m[1], head.low_m[2]},
          {head.high_m[0], head.high_m[1], head.high_m[2]}};
}

template <class Taker>
class Leaves {
 public:
  Leaves(const Shell& shell, Vec3 a_m, Vec3 b_m, Taker& taker)
      : limit(taker.limit),
        shell_(shell),
        frame_(shell.head().low_m, shell.head().high_m, a_m, b_m),
        taker_(taker) {}
  float limit;

  bool leaf(uint32_t leaf) {
    const uint32_t first = leaf * kLeafFaces, count = shell_.face_count();
    const uint32_t end = first + kLeafFaces < count ? first + kLeafFaces : count;
    for (uint32_t i = first; i < end; ++i) {
      const ShellFace& face = shell_.face(i);
      if (frame_.misses(sheared(face.corner[0]), sheared(face.corner[1]), sheared(face.corner[2])))
        continue;
      const mesh::Crossing crossing =
          frame_.crossing(vertex(shell_, face.corner[0]), vertex(shell_, face.corner[1]),
                          vertex(shell_, face.corner[2]));
      if (crossing.direction != 0 && !taker_.take(crossing, i)) return false;
    }
    limit = taker_.limit;
    return true;
  }

 private:
  // A vertex is met by three faces of a leaf: those met last are kept by the low bits of their
  // numbers.
  mesh::SegmentFrame::Sheared sheared(uint32_t i) {
    Met& met = met_[i % kMet];
    if (met.vertex != i) met = {i, frame_.sheared(vertex(shell_, i))};
    return met.at;
  }
  struct Met {
    uint32_t vertex = UINT32_MAX;
    mesh::SegmentFrame::Sheared at;
  };
  static constexpr uint32_t kMet = 16;

  const Shell& shell_;
  mesh::SegmentFrame frame_;
  Met met_[kMet];
  Taker& taker_;
};

struct Turns {
  float limit = 1;
  int32_t sum = 0;
  bool take(const mesh::Crossing& crossing, uint32_t) {
    sum += crossing.direction;
    return true;
  }
};

template <class Taker>
bool search(const Shell& shell, Vec3 a_m, Vec3 b_m, query::Budget budget, uint32_t& steps,
            Taker& taker) {
  Leaves<Taker> leaves(shell, a_m, b_m, taker);
  return descend(shell.boxes(), box_of(shell.head()), Slabs(a_m, b_m),
                 budget.steps == 0 ? 1 : budget.steps, steps, leaves);
}

}  // namespace

ShellHit cast_shell(const Shell& shell, Vec3 a_m, Vec3 b_m, query::Budget budget) {
  ShellHit hit;
  if (!(math::is_finite(a_m) && math::is_finite(b_m))) return hit;
  mesh::First first;
  hit.exact = search(shell, a_m, b_m, budget, hit.steps, first);
  hit.hit = first.hit.hit || !hit.exact;
  hit.t = hit.exact ? first.hit.t : 0.0f;
  hit.face = first.hit.triangle;
  hit.enters = first.hit.enters;
  return hit;
}

bool wind_around(const Shell& shell, Vec3 p_m, query::Budget budget, int32_t& winding,
                 uint32_t& steps) {
  winding = 0;
  if (!math::is_finite(p_m)) return false;
  const ShellHead& head = shell.head();
  // Out by the nearer side along x.
  const float middle = head.low_m[0] * 0.5f + head.high_m[0] * 0.5f,
              side = head.high_m[0] - head.low_m[0];
  const float out = p_m.x < middle ? head.low_m[0] - side : head.high_m[0] + side;
  const bool is_beyond = p_m.x < head.low_m[0] || p_m.x > head.high_m[0];
  if (is_beyond) return true;
  Turns turns;
  const bool is_done = search(shell, p_m, {out, p_m.y, p_m.z}, budget, steps, turns);
  winding = is_done ? turns.sum : 0;
  return is_done;
}

}  // namespace firmtouch::hull
