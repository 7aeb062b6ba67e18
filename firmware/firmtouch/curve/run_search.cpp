#include "firmtouch/curve/run_search.hpp"

namespace firmtouch::curve {

// Takes a box below `prune_`: while there are more than `best_first_`, the last, else the smallest.
// Result: false when there is none; the traversal is complete.
inline bool RunSearch::take_next() {
  while (count_ > best_first_) {
    now_ = pending_[--count_];
    if (now_.key < prune_) return true;
  }
  complete_ = true;
  if (count_ == 0) return false;
  uint32_t at = count_ - 1;
  for (uint32_t i = at; i-- > 0;) at = pending_[i].key < pending_[at].key ? i : at;
  now_ = pending_[at];
  pending_[at] = pending_[--count_];
  complete_ = now_.key >= prune_;
  return !complete_;
}

// From a run to the root. Result: false where nothing is left to visit.
template <class Bound>
inline bool RunSearch::ascend(const Bound& bound_at, uint32_t start) {
  const Bound bound = bound_at;  // in registers
  best_first_ = 0;
  uint32_t left = left_, least = kFarthest, count = 0;
  for (uint32_t box = leaves_ + runs_[start].leaf; box != 0; box = parent_of(box), --left) {
    if (left == 0) {  // nothing is known of the rest of the way
      left_ = 0, now_.key = 0;
      return false;
    }
    const uint32_t beside = ((box - 1) ^ 1u) + 1;
    const uint32_t key = bound.key(boxes_[beside].side);
    if (key < prune_)
      pending_[count++] = {key, beside};
    else
      least = key < least ? key : least;
  }
  left_ = left, least_ = least, count_ = count;
  complete_ = count == 0;
  if (complete_) return false;
  now_ = pending_[--count_];
  return true;
}

// From the box at hand to the next run.
template <class Bound>
inline uint32_t RunSearch::descend(const Bound& bound_at) {
  const Bound bound = bound_at;
  for (;;) {
    if (left_ == 0) return kNoRun;
    --left_;
    if (now_.box >= leaves_) return runs_[now_.box - leaves_].run;
    const uint32_t first = first_child(now_.box);
    const uint32_t key0 = bound.key(boxes_[first].side), key1 = bound.key(boxes_[first + 1].side);
    const uint32_t slot = key1 < key0 ? 1 : 0, far_key = slot ? key0 : key1;
    now_ = {slot ? key1 : key0, first + slot};
    if (far_key < prune_) {  // and so is the nearer
      pending_[count_++] = {far_key, first + 1 - slot};
      continue;
    }
    const bool goes_on = now_.key < prune_;
    const uint32_t left_out = goes_on ? far_key : now_.key;
    least_ = left_out < least_ ? left_out : least_;
    if (!goes_on && !take_next()) return kNoRun;
  }
}

uint32_t RunSearch::begin(uint32_t start, float reach2_m2) {
  reach2_m2_ = reach2_m2;
  prune_ = bound_.prune_key(reach2_m2);
  if (start == kNoRun)
    ++left_;
  else if (!(bound_.is_far ? ascend(bound_.far, start) : ascend(bound_.near, start)))
    return kNoRun;
  return bound_.is_far ? descend(bound_.far) : descend(bound_.near);
}

uint32_t RunSearch::next(float reach2_m2) {
  if (reach2_m2 < reach2_m2_) {
    reach2_m2_ = reach2_m2;
    prune_ = bound_.prune_key(reach2_m2);
    least_ = 0;  // what is pending may be dropped now
  }
  if (!take_next()) return kNoRun;
  return bound_.is_far ? descend(bound_.far) : descend(bound_.near);
}

Traversal RunSearch::result(float others_m) const {
  if (complete_) {
    const float boxes_m = bound_.distance_m(least_);
    return {allowed_ - left_, true, boxes_m < others_m ? boxes_m : others_m};
  }
  uint32_t least = now_.key;
  for (uint32_t i = 0; i < count_; ++i)
    least = pending_[i].key < least ? pending_[i].key : least;
  return {allowed_, false, bound_.distance_m(least)};
}

}  // namespace firmtouch::curve
