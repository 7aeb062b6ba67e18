#include "bake/objects/tool_file.hpp"

#include "device/line_reader.hpp"

namespace firmtouch::tools {
namespace {

scene::SphereLayout read_line(LineReader& words) {
  words.expect("sphere");
  const Point at_m = words.vector("sphere", "m", double{scene::kMaxArm_m});
  words.expect("radius");
  const double radius_m = words.quantity("radius", "m", 0, 0.1);
  words.end();
  return {{static_cast<float>(at_m.x), static_cast<float>(at_m.y), static_cast<float>(at_m.z)},
          static_cast<float>(radius_m)};
}

}  // namespace

std::vector<scene::SphereLayout> read_tool(const std::string& file, const std::string& text) {
  std::vector<scene::SphereLayout> spheres;
  read_lines(file, text, [&](LineReader& words, int) {
    spheres.push_back(read_line(words));
    if (spheres.size() > scene::kMaxSpheres)
      words.refuse("a tool has at most " + std::to_string(scene::kMaxSpheres) + " spheres");
  });
  if (spheres.empty())
    throw Refused(file + ": it has no sphere; write `sphere X Y Z mm radius R mm`");
  return spheres;
}

}  // namespace firmtouch::tools
