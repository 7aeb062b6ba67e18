#include "pressed_app.hpp"

#include "asset/small_file.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/scene/compose.hpp"
#include "servo_interrupt.hpp"
#include "text.hpp"

namespace firmtouch {
namespace target {

void press_wall(const ModelRequest& request, const params::Values& values, ModelResult& result) {
  scene::SurfacePoint surface;
  surface.distance_m = -0.002f;
  surface.normal = {0, 0, 1};
  surface.sign = -1;
  const scene::Material material{values[params::kContactStiffness],
                                 values[params::kContactDamping]};
  scene::add_contact(result.model, request.position_m, 0, surface, material);
}

bool open_nothing() {
  static asset_test::SmallFile file;
  for (uint32_t i = 0; i < file.kSections; ++i) file.word(file.entry_at(i), 0x7770 + i);
  file.repair();
  return app::controller.open(file.all()).ok();
}

void print(const char* name, uint32_t value) {
  hal::board_print(name);
  hal::board_print(decimal(value).text);
}

}  // namespace target

bool hal::encoders_read(int32_t (&counts)[3]) {
  for (int32_t& count : counts) count = 0;
  return true;
}

}  // namespace firmtouch
