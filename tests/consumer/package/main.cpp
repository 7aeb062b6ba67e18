// Touches the baked gem once, 15 mm above its top.
#include "firmtouch/asset/container.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/loader.hpp"
#include "firmtouch/version.hpp"

#ifdef __arm__
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/motors.hpp"
void firmtouch::hal::motors_off() {}
static void print(const char* text) { firmtouch::hal::board_print(text); }
#else
#include <cstdio>
static void print(const char* text) { std::fputs(text, stdout); }
#endif

using namespace firmtouch;

extern "C" const unsigned char scene_fta[];
extern "C" const unsigned scene_fta_size;

int main() {
#ifdef __arm__
  hal::board_begin();
#endif
  asset::Container file;
  mesh::View gem;
  if (!asset::open({scene_fta, scene_fta_size}, file).ok()) return 1;
  if (!asset::open_geometry(file, file.name(file.next_of_type(mesh::kHeadSection)), gem).ok())
    return 2;
  mesh::Hint hint;
  const mesh::Closest found = mesh::closest_point(gem, {0.04f, 0, 0.03f}, query::Budget{256}, hint);
  const bool is_good = found.certificate.exact && found.distance_m > 0.0149f &&
                       found.distance_m < 0.0151f && kVersion >= 100;
  print(is_good ? "ok    the gem is touched\n" : "FAIL  the gem is not touched\n");
  return is_good ? 0 : 3;
}
