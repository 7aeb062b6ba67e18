#include "firmtouch/spline/guide/nodes.hpp"

namespace firmtouch::spline {
namespace {

// Where a place of a piece lies among its parts, 0 to their number.
float among_intervals(const GuideView& guide, float s) {
  return 0.5f * (s + 1.0f) * static_cast<float>(guide.intervals());
}

constexpr uint32_t kRoot = 1;  // of the tree over leaves

float least_of(float a, float b) { return a < b ? a : b; }

}  // namespace

// Leaves follow each other along the curve: the first and the last say how far, by the ends of
// stored lengths about them, or within them.
GuideNodes::Stretch GuideNodes::stretch_of(const CurveLevels::Leaves& under, bool is_within) const {
  const View& model = guide_.model();
  uint32_t first = under.first, last = under.end - 1;
  if (curve_.piece_of(first) == kNoLeaf) ++first;
  if (curve_.piece_of(last) == kNoLeaf) --last;
  const uint32_t from = curve_.piece_of(first), to = curve_.piece_of(last);
  const uint32_t from_index = first - curve_.first_of(from),
                 to_end = last - curve_.first_of(to) + 1;
  const uint32_t from_level = model.pieces()[from].level_u, to_level = model.pieces()[to].level_u;
  const uint32_t intervals = guide_.intervals();
  const uint32_t low_more = is_within ? (1u << from_level) - 1 : 0;
  const uint32_t high_more = is_within ? 0 : (1u << to_level) - 1;
  const uint32_t low = (from_index * intervals + low_more) >> from_level;
  const uint32_t high = (to_end * intervals + high_more) >> to_level;
  return {guide_.arcs()[from * intervals + low], guide_.arcs()[to * intervals + high]};
}

uint32_t GuideNodes::node_around(uint32_t node, float reach_m) const {
  const float low_m = penalty_.at_m - reach_m, high_m = penalty_.at_m + reach_m;
  const Round& round = penalty_.round;
  if (round.is_closed && !(low_m >= round.first_m && high_m <= round.last_m)) return kRoot;
  while (node != kRoot) {
    const Stretch below = stretch_of(curve_.below(node), true);
    const bool holds_low = below.low_m <= low_m || !(below.low_m > 0.0f);
    const bool holds_high = below.high_m >= high_m || !(below.high_m < guide_.length_m());
    if (holds_low && holds_high) break;
    node = parent_of(node);
  }
  return node;
}

float GuideNodes::min_within(uint32_t piece, float low, float high) const {
  const auto first = static_cast<uint32_t>(among_intervals(guide_, low));
  const float end = among_intervals(guide_, high);
  auto last = static_cast<uint32_t>(end);
  if (static_cast<float>(last) < end) ++last;
  const uint32_t at = piece * guide_.intervals();
  return penalty_.least(guide_.arcs()[at + first], guide_.arcs()[at + last]);
}

// Where a range goes over the place without a penalty, or from one part to another.
bool GuideNodes::find_cut(uint32_t piece, const Range& range, float& at) const {
  at = penalty_.s;
  if (piece == penalty_.piece && range.low < at && at < range.high) return true;
  const float low = among_intervals(guide_, range.low), high = among_intervals(guide_, range.high);
  const auto first = static_cast<uint32_t>(low);
  auto last = static_cast<uint32_t>(high);
  if (static_cast<float>(last) < high) ++last;
  if (last - first < 2) return false;
  const uint32_t middle = (first + last) / 2;
  at = 2.0f * static_cast<float>(middle) / static_cast<float>(guide_.intervals()) - 1.0f;
  return range.low < at && at < range.high;
}

GuideNodes::Slopes GuideNodes::slopes_at(float t) const {
  const float per = 0.5f * static_cast<float>(guide_.intervals());
  Slopes arc;
  arc.first = (arcs_.cubic().from_m +
               t * (2.0f * arcs_.cubic().square_m() + 3.0f * t * arcs_.cubic().bow_m)) *
              per;
  arc.second = (2.0f * arcs_.cubic().square_m() + 6.0f * t * arcs_.cubic().bow_m) * (per * per);
  arc.third = 6.0f * arcs_.cubic().bow_m * (per * per * per);
  return arc;
}

// The ways that may be the shorter one somewhere in a range; the first is that of its middle.
uint32_t GuideNodes::ways_of(uint32_t piece, const Range& range, Way (&ways)[2]) const {
  const float middle = 0.5f * (range.low + range.high);
  const bool is_after = piece == penalty_.piece ? middle > penalty_.s : piece > penalty_.piece;
  const Way direct{0.0f, is_after ? penalty_.per_m : -penalty_.per_m};
  ways[0] = direct;
  if (!penalty_.round.goes_round(piece)) return 1;
  const float round_m = penalty_.round.length_m();
  const Way other{penalty_.per_m * round_m, -direct.per_m};
  float low_t, high_t;
  (void)interval_at(guide_, range.low, low_t);
  if (interval_at(guide_, range.high, high_t) != arcs_.interval()) high_t = 1.0f;
  const float low_m = arcs_.cubic().at_m(low_t) - penalty_.at_m,
              high_m = arcs_.cubic().at_m(high_t) - penalty_.at_m;
  const float near_m = is_after ? low_m : -high_m, far_m = is_after ? high_m : -low_m;
  if (far_m <= 0.5f * round_m) return 1;
  if (near_m >= 0.5f * round_m) {
    ways[0] = other;
    return 1;
  }
  const bool is_direct_first = near_m + far_m <= round_m;
  ways[0] = is_direct_first ? direct : other;
  ways[1] = is_direct_first ? other : direct;
  return 2;
}

// `outward`: 1 with rising s, -1 with falling. The third power of the way is at most its length
// times the second.
GuideNodes::Room GuideNodes::room_of(const Slopes& arc, const Way& way, float limit_m,
                                     float outward, float length) {
  Room room;
  room.first_m = limit_m;
  room.slope = -way.per_m * outward * arc.first;
  room.half_bend = -way.per_m * 0.5f * arc.second;
  const float turn = -way.per_m * outward * arc.third * 0.16666667f;
  if (turn > 0.0f) room.half_bend += turn * length;
  room.fall = 0.0f;
  if (way.per_m * outward > 0.0f) {
    const float bend = outward * arc.second, third = arc.third;
    const float least = arc.first + (bend < 0.0f ? bend * length : 0.0f) +
                        (third < 0.0f ? 0.5f * third * length * length : 0.0f);
    if (least > 0.0f) room.fall = way.per_m * outward * least * (1.0f - 0x1p-18f);
  }
  return room;
}

// No point has a cost below the limit if its squared distance is at least the square of what the
// penalty leaves of it. D^2 >= D0^2 + 2 g d + q d^2 there (curve_proof.hpp), and with slack m0 + m1
// d + m2 d^2
//     D^2 - slack^2 >= (D0^2 - m0^2) + 2 (g - m0 m1) d + (q - m1^2 - 2 m0 m2 - 2 m1 m2 l - m2^2
//     l^2) d^2
// over a length l, the third but last term where it takes away. Beyond where the slack ends nothing
// is to be shown. The limit is 16 units of the cost below the best, which is more than what is
// rounded of D0^2 - m0^2; what is rounded of the other terms is taken off them.
bool GuideNodes::is_side_done(const Expansion& f, float distance_m, float side, const Room& room,
                              float length) {
  const float m1 = room.slope, m2 = room.half_bend;
  const float most =
      room.first_m + (m1 > 0.0f ? m1 * length : 0.0f) + (m2 > 0.0f ? m2 * length * length : 0.0f);
  if (!(most > 0.0f)) return true;
  const float m0 = room.first_m > 0.0f ? room.first_m : 0.0f;
  if (room.fall > 0.0f) {
    const float enough = m0 / room.fall * (1.0f + 0x1p-18f);
    if (enough < length) length = enough;
  }
  const float product = m0 * m1, square = m1 * m1, both = 2.0f * m0 * m2;
  const float cubic = 2.0f * m1 * m2 * length, fourth = m2 * m2 * length * length;
  const float taken = square + fourth + math::larger(cubic, 0.0f) + both;
  const float size = square + fourth + math::larger(cubic, 0.0f) + (both < 0.0f ? -both : both);
  const float b = side * f.slope - f.slope_noise - product -
                  8.0f * kUnit * (product < 0.0f ? -product : product);
  const float q = f.bend_over(side, length) - taken - 16.0f * kUnit * size;
  const float c = (distance_m - m0) * (distance_m + m0);
  if (q > 0.0f && b < 0.0f && -b < q * length) return c - b * (b / q) >= 0.0f;
  return least_of(c, c + (2.0f * b + q * length) * length) >= 0.0f;
}

// The lengths of the part that a range lies in: false where there are no steps left for them.
bool GuideNodes::take_interval(uint32_t on, const Range& range, query::Work& work, Best& best) {
  float t;
  const uint32_t interval = interval_at(guide_, 0.5f * (range.low + range.high), t);
  if (arcs_.is_of(on, interval)) return true;
  if (!(work.visit() && work.visit())) return false;
  work.charge(2 * kEvaluationWork);
  best.evaluations += 2;
  arcs_.take(on, interval);
  return true;
}

// False: there is no step left for it.
bool GuideNodes::take_point(uint32_t on, uint32_t node, float s, query::Work& work, Best& best,
                            Seen& seen) const {
  const Piece& piece = guide_.model().pieces()[on];
  if (on == penalty_.piece && !(s < penalty_.s) && !(s > penalty_.s)) {
    seen.at = kink_;
  } else {
    if (!work.visit()) return false;
    work.charge(kEvaluationWork);
    ++best.evaluations;
    seen.at = evaluate(piece, guide_.model().coefficients().data(), s);
  }
  seen.r_m = seen.at.x - (p_m_ - vec3_at(piece.origin_m));
  seen.distance2_m2 = dot(seen.r_m, seen.r_m);
  seen.distance_m = math::square_root(seen.distance2_m2);
  seen.slope = dot(seen.r_m, seen.at.d1);
  seen.speed2 = dot(seen.at.d1, seen.at.d1);
  seen.bend = seen.speed2 + dot(seen.r_m, seen.at.d2);
  float t = among_intervals(guide_, s) - static_cast<float>(arcs_.interval());
  t = t > 0.0f ? (t < 1.0f ? t : 1.0f) : 0.0f;
  seen.arc_m = arcs_.cubic().at_m(t);
  seen.arc = slopes_at(t);
  seen.penalty_m = penalty_.of(on, seen.arc_m);
  if (take_cost(best, seen.distance_m + seen.penalty_m)) {
    best.distance2_m2 = seen.distance2_m2;
    best.node = node;
    best.s = s;
  }
  return true;
}

// Newton's step on the cost times the distance, the shorter way round. `gain` is what it promises
// of that.
float GuideNodes::step_from(const Seen& seen, const Way& way, float& gain_m2) {
  const float pull = way.per_m * seen.arc.first;
  const float down = seen.slope + seen.distance_m * pull;
  const float rise = seen.bend - pull * pull + seen.distance_m * (way.per_m * seen.arc.second);
  gain_m2 = rise > 0.0f ? down * (down / rise) : 0.0f;
  return rise > 0.0f ? -down / rise : down > 0.0f ? -FLT_MAX : FLT_MAX;
}

// Takes off a range what is proven on both sides of a point: nothing there costs less than the
// limit.
bool GuideNodes::prove(uint32_t on, const Seen& seen, float s, const Way* ways, uint32_t way_count,
                       Range& range, Sides& sides) const {
  const Expansion f = expand(seen.at, seen.r_m, seen.distance2_m2, seen.slope, seen.speed2,
                             seen.bend, curve_.bend_of(on), guide_.model().head().loss_m);
  const float below = s - range.low, above = range.high - s;
  sides = {true, true};
  for (uint32_t k = 0; k < way_count; ++k) {
    const float room_m =
        best_.limit_m - (ways[k].offset_m + ways[k].per_m * (seen.arc_m - penalty_.at_m));
    if (sides.below && below > 0.0f)
      sides.below = is_side_done(f, seen.distance_m, -1.0f,
                                 room_of(seen.arc, ways[k], room_m, -1.0f, below), below);
    if (sides.above && above > 0.0f)
      sides.above = is_side_done(f, seen.distance_m, 1.0f,
                                 room_of(seen.arc, ways[k], room_m, 1.0f, above), above);
  }
  if (sides.below) range.low = s;
  if (sides.above) range.high = s;
  return sides.below && sides.above;
}

Outcome GuideNodes::split(uint32_t on, const Range& range, float at, float lower_m,
                          Half<Range> (&halves)[2]) const {
  halves[0] = half(on, range.low, at, lower_m);
  halves[1] = half(on, at, range.high, lower_m);
  return Outcome::kSplit;
}

Outcome GuideNodes::solve(uint32_t node, Range& range, float lower_m, query::Work& work, Best& best,
                          Half<Range> (&halves)[2]) {
  const uint32_t on = piece_of(node);
  float cut;
  if (find_cut(on, range, cut)) {
    if (!work.visit()) return Outcome::kStopped;
    (void)split(on, range, cut, lower_m, halves);
    halves[0].range.start = halves[1].range.start = cut;
    return Outcome::kSplit;
  }
  if (!take_interval(on, range, work, best)) return Outcome::kStopped;
  Way ways[2];
  const uint32_t way_count = ways_of(on, range, ways);
  float s = range.start;
  for (uint32_t turn = 0; turn < kMaxTurns; ++turn) {
    Seen seen;
    if (!take_point(on, node, s, work, best, seen)) {
      range.start = s;
      return Outcome::kStopped;
    }
    float gain_m2;
    float next = s + step_from(seen, ways[0], gain_m2);
    const float room_m = best.limit_m - seen.penalty_m;
    const float shown_m2 = (seen.distance_m - room_m) * (seen.distance_m + room_m);
    if (next > range.low && next < range.high && turn + 1 < kMaxTurns && shown_m2 < gain_m2) {
      s = next;  // no proof can hold yet
      continue;
    }
    Sides sides;
    if (prove(on, seen, s, ways, way_count, range, sides)) return Outcome::kClosed;
    if (!(next > range.low)) next = range.low;
    if (!(next < range.high)) next = range.high;
    const float step = next - s;
    if (!(step > 0.0f || step < 0.0f)) {  // Newton goes no further, yet a side is not proven
      if (!sides.below && !sides.above) return split(on, range, s, lower_m, halves);
      next = 0.5f * (range.low + range.high);
    }
    s = next;
  }
  const float middle = 0.5f * (range.low + range.high);
  if (!(middle > range.low && middle < range.high)) return Outcome::kLost;
  return split(on, range, middle, lower_m, halves);
}

}  // namespace firmtouch::spline
