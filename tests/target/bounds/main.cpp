// The most instructions that what a header states a figure for takes, of many inputs. A row a
// figure, in the header's order:
//     HEADER INSTRUCTIONS
// tests/check/bounds.sh runs it, with an asset in the board's slot that has a mesh with three
// materials (plain, waves, height map) and a distance field, a curve and a spline surface.
#include "firmtouch/hal/board.hpp"
#include "target/bounds/asset.hpp"
#include "target/bounds/meter.hpp"

using namespace firmtouch;  // NOLINT: a program of the tests

int main() {
  hal::board_begin();
  if (!target::open_asset()) {
    hal::board_print("a part of the asset is missing, or refused\n");
    return 1;
  }
  target::measure_math();
  target::measure_mesh();
  target::measure_scene();
  target::measure_touch();
  target::measure_effects();
  hal::board_print("complete\n");
  return 0;
}
