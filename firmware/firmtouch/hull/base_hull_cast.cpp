#include "firmtouch/hull/base_hull_cast.hpp"

#include "firmtouch/hull/base_hull_segment.hpp"
#include "firmtouch/mesh/segment_frame.hpp"

namespace firmtouch::hull {
namespace {

using math::Vec3;

// The first crossing, or a time before which there is none. A face that floats cannot decide counts
// as crossed, no later than its plane: that is safe. The exact test takes 10,000 instructions; it
// decides only faces along the segment, whose plane gives no time.
class First {
 public:
  float limit = 1;
  BaseHullHit hit;

  First(Vec3 a_m, Vec3 b_m) : a_m_(a_m), b_m_(b_m), along_m_(b_m - a_m) {
    const float length2_m2 = dot(along_m_, along_m_);
    per_length2_ = length2_m2 > 1e-30f && length2_m2 < 1e30f ? 1.0f / length2_m2 : 0.0f;
  }

  bool take(const mesh::SegmentFrame& frame, const FacePoints& corner, uint32_t face) {
    mesh::Crossing reported;
    float early;
    bool is_decided = frame.decides(corner.p_m, corner.q_m, corner.r_m, reported, early);
    if (!is_decided) {
      const Range feet = feet_of(corner);
      if (feet.last < 0.0f || feet.first > 1.0f) return true;
      is_decided = !(reported.t > 0.0f);  // the plane gives no time
      reported.t = mesh::larger(feet.first, reported.t);
      if (is_decided)
        reported = mesh::exact_crossing(a_m_, b_m_, corner.p_m, corner.q_m, corner.r_m);
    }
    if (is_decided && reported.direction == 0) return true;
    const bool is_first =
        !hit.hit || reported.t < hit.t || (reported.t <= hit.t && face < hit.face);
    if (!is_first) return true;
    hit.hit = true;
    hit.t = reported.t;
    hit.face = face;
    hit.enters = reported.direction <= 0;
    hit.exact = is_decided || early <= kMaxEarly;
    // A box that is entered later in truth may hold a crossing with an earlier computed time.
    limit = mesh::smaller(reported.t + 2.0f * mesh::kTimeError, 1.0f);
    return true;
  }

 private:
  static constexpr float kMaxEarly = 0x1p-12f;
  struct Range {
    float first, last;
  };
  // A crossing lies between the corners' feet on the line. With u = 2^-24 a foot is off by 6 u of
  // the magnitudes summed.
  Range feet_of(const FacePoints& corner) const {
    const Range p = foot_of(corner.p_m), q = foot_of(corner.q_m), r = foot_of(corner.r_m);
    return {mesh::smaller(p.first, mesh::smaller(q.first, r.first)),
            mesh::larger(p.last, mesh::larger(q.last, r.last))};
  }
  Range foot_of(Vec3 corner_m) const {
    const Vec3 v = (corner_m - a_m_) * per_length2_;
    const float foot = dot(v, along_m_);
    const float off =
        0x1p-20f * (mesh::absolute(v.x * along_m_.x) + mesh::absolute(v.y * along_m_.y) +
                    mesh::absolute(v.z * along_m_.z));
    return {foot - off, foot + off};
  }

  Vec3 a_m_, b_m_, along_m_;
  float per_length2_;
};

// All crossings, each way, exactly.
class Turns {
 public:
  float limit = 1;
  int32_t sum = 0;
  bool is_starved = false;

  Turns(Vec3 a_m, Vec3 b_m, query::Work& work) : a_m_(a_m), b_m_(b_m), work_(work) {}
  bool take(const mesh::SegmentFrame& frame, const FacePoints& corner, uint32_t) {
    mesh::Crossing crossing;
    float early;
    if (!frame.decides(corner.p_m, corner.q_m, corner.r_m, crossing, early)) {
      is_starved = work_.left == 0;
      if (is_starved) return false;
      work_.charge(kExactWork);
      crossing = mesh::exact_crossing(a_m_, b_m_, corner.p_m, corner.q_m, corner.r_m);
    }
    sum += crossing.direction;
    return true;
  }

 private:
  static constexpr uint32_t kExactWork = 100;  // it takes about 12,000 instructions
  Vec3 a_m_, b_m_;
  query::Work& work_;
};

constexpr uint32_t kFaceWork = 5;  // of a face that is not passed by: 700 instructions

template <class Taker>
struct Faces {
  Faces(const BaseHull& of, const BaseHullSegment& along, Vec3 from_m, Vec3 to_m,
        query::Work& taken, Taker& to)
      : base_hull(of),
        segment(along),
        a_m(from_m),
        b_m(to_m),
        work(taken),
        taker(to),
        limit(along.until(to.limit)) {}
  const BaseHull& base_hull;
  const BaseHullSegment& segment;
  Vec3 a_m, b_m;
  query::Work& work;
  Taker& taker;
  int32_t limit;
  bool has_frame = false;  // most segments come near no face
  mesh::SegmentFrame frame;

  bool face(const BaseHull::Leaf& leaf, uint32_t n) {
    const BaseHullHead& head = base_hull.head();
    if (!has_frame) frame = mesh::SegmentFrame(head.low_m, head.high_m, a_m, b_m);
    has_frame = true;
    work.charge(kFaceWork);
    const bool is_wanted = taker.take(frame, points_of(base_hull, leaf, n), leaf.first_face + n);
    limit = segment.until(taker.limit);
    return is_wanted;
  }
};

template <class Taker>
bool search(const BaseHull& base_hull, Vec3 a_m, Vec3 b_m, query::Work& work, Taker& taker) {
  const BaseHullSegment segment(base_hull, a_m, b_m);
  Faces<Taker> faces(base_hull, segment, a_m, b_m, work, taker);
  return descend(base_hull, segment, work, faces);
}

}  // namespace

BaseHullHit cast_base_hull(const BaseHull& base_hull, Vec3 a_m, Vec3 b_m, query::Budget budget) {
  if (!(math::is_finite(a_m) && math::is_finite(b_m))) return {};
  First first(a_m, b_m);
  query::Work work(budget);
  const bool is_done = search(base_hull, a_m, b_m, work, first);
  BaseHullHit hit = first.hit;
  if (!is_done) {
    hit.hit = true;
    hit.t = 0.0f;
  }
  hit.exact = is_done && (hit.exact || !hit.hit);
  hit.steps = work.visits();
  return hit;
}

bool wind_around(const BaseHull& base_hull, Vec3 p_m, query::Work& work, int32_t& winding) {
  winding = 0;
  if (!math::is_finite(p_m)) return false;
  const BaseHullHead& head = base_hull.head();
  // Out by the nearer side along x.
  const float middle = head.low_m[0] * 0.5f + head.high_m[0] * 0.5f,
              side = head.high_m[0] - head.low_m[0];
  const float out = p_m.x < middle ? head.low_m[0] - side : head.high_m[0] + side;
  const bool is_beyond = p_m.x < head.low_m[0] || p_m.x > head.high_m[0];
  if (is_beyond) return true;
  const Vec3 out_m{out, p_m.y, p_m.z};
  Turns turns(p_m, out_m, work);
  const bool is_done = search(base_hull, p_m, out_m, work, turns) && !turns.is_starved;
  winding = is_done ? turns.sum : 0;
  return is_done;
}

}  // namespace firmtouch::hull
