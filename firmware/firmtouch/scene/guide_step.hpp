#pragma once
// One tick of a guide, for curves of every kind. For the library's own translation units.

#include "firmtouch/scene/guide.hpp"

namespace firmtouch::scene {

/// A tick's query of a curve of any kind.
struct Found {
  bool is_new = false, is_held = false;
  bool is_closed = false;
  float moved_m = 0;                // since the last tick
  float length_m = 0;               // from end to end
  float behind_m = 0, ahead_m = 0;  // to the ends
  float size_m = 0;                 // of the curve: the scale of its rounding errors
  int end = 0;  // -1: past the first end of an open curve, 1: past the last, 0: beside it
};

/// The distance at which a guide releases: a release nearer than the snap would chatter.
float release_distance_m(const Guide& guide);

/// NaN gives 0, too.
float positive(float value);

/// Decides whether the guide holds the tool, and adds its pull and drive to the model.
/// Pre: touch.closest is the query's.
/// Result: the end at which the guide continues at the other one; 0: none.
int finish_guide(const Guide& guide, math::Vec3 p_m, const Found& found, GuideTouch& touch,
                 servo::LocalModel& model);

}  // namespace firmtouch::scene
