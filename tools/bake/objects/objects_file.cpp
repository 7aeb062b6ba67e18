#include "bake/objects/objects_file.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <set>
#include <sstream>

#include "device/line_reader.hpp"
#include "firmtouch/controller/mesh_objects.hpp"

namespace firmtouch::tools {
namespace {

using scene::ObjectLayout;

constexpr double kMaxTurn_rad = 1000;

std::string name_of(LineReader& words, const char* what) {
  const std::string name = words.next(what);
  if (name.size() >= scene::kNameBytes)
    words.refuse("`" + name + "` is longer than " + std::to_string(scene::kNameBytes - 1) +
                 " bytes; shorten the name");
  return name;
}

void put(float (&to)[3], const Point& from) {
  to[0] = static_cast<float>(from.x);
  to[1] = static_cast<float>(from.y);
  to[2] = static_cast<float>(from.z);
}

// Rodrigues' formula.
void put_rotation(double angle_rad, const Point& about, ObjectLayout& object) {
  const double size = length(about), c = std::cos(angle_rad), s = std::sin(angle_rad);
  const double v[3] = {about.x / size, about.y / size, about.z / size};
  const double cross[3][3] = {{0, -v[2], v[1]}, {v[2], 0, -v[0]}, {-v[1], v[0], 0}};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      object.rotation[3 * i + k] =
          static_cast<float>((i == k ? c : 0) + s * cross[i][k] + (1 - c) * v[i] * v[k]);
}

void read_clause(const std::string& word, LineReader& words, ObjectLayout& object) {
  if (word == "at") {
    put(object.at_m, words.vector(word, "m", scene::kMaxObjectDistance_m));
  } else if (word == "turned") {
    const double angle_rad = words.quantity(word, "rad", -kMaxTurn_rad, kMaxTurn_rad);
    words.expect("about");
    const Point about = words.vector("about", "", 1e6);
    if (!(length(about) > 1e-6)) words.refuse("the axis after `about` has no direction");
    put_rotation(angle_rad, about, object);
  } else if (word == "stiffness") {
    object.stiffness_N_per_m = static_cast<float>(words.quantity(word, "N/m", 0, 1e9));
  } else if (word == "friction") {
    object.friction_static =
        static_cast<float>(words.quantity("friction", "", 0, double{scene::kMaxFriction}));
    object.friction_dynamic = object.friction_static;
    if (words.take("sliding"))
      object.friction_dynamic =
          static_cast<float>(words.quantity("sliding", "", 0, double{scene::kMaxFriction}));
  } else if (word == "moves") {
    put(object.velocity_mps, words.vector(word, "m/s", scene::kMaxObjectSpeed_mps));
  } else if (word == "turns") {
    put(object.turn_rad_per_s, words.vector(word, "rad/s", scene::kMaxObjectTurn_rad_per_s));
  } else {
    words.refuse("unknown word `" + word +
                 "`; an object has: at, turned, stiffness, friction, moves, turns");
  }
}

ObjectLayout read_line(LineReader& words, const std::vector<std::string>& meshes) {
  ObjectLayout object{};
  object.rotation[0] = object.rotation[4] = object.rotation[8] = 1;
  object.stiffness_N_per_m = FLT_MAX;
  words.expect("object");
  const std::string name = name_of(words, "the object's name");
  words.expect("of");
  const std::string mesh = name_of(words, "the name of its mesh");
  std::memcpy(object.name, name.c_str(), name.size());
  std::memcpy(object.mesh, mesh.c_str(), mesh.size());
  if (std::find(meshes.begin(), meshes.end(), mesh) == meshes.end()) {
    std::string list;
    for (const std::string& known : meshes) list += (list.empty() ? "`" : ", `") + known + "`";
    words.refuse("object `" + name + "` is of mesh `" + mesh + "`, which is not baked with it; " +
                 (list.empty() ? "no mesh is" : "those are: " + list));
  }
  std::set<std::string> given;
  while (words.more()) {
    const std::string word = words.next("a word");
    if (!given.insert(word).second) words.refuse("`" + word + "` is given twice; keep one");
    read_clause(word, words, object);
  }
  return object;
}

}  // namespace

std::vector<ObjectLayout> read_objects(const std::string& file, const std::string& text,
                                       const std::vector<std::string>& meshes) {
  std::vector<ObjectLayout> objects;
  std::set<std::string> names, used;
  std::istringstream lines(text);
  const std::vector<std::string> no_names;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    LineReader words(line, file + ":" + std::to_string(number), no_names, false);
    if (words.empty()) continue;
    objects.push_back(read_line(words, meshes));
    if (!names.insert(objects.back().name).second)
      words.refuse("there are two objects `" + std::string(objects.back().name) +
                   "`; give each a name of its own");
    used.insert(objects.back().mesh);
    if (objects.size() > scene::kMaxObjects)
      words.refuse("a scene has at most " + std::to_string(scene::kMaxObjects) + " objects");
    if (used.size() > kMaxObjectMeshes)
      words.refuse("objects are of at most " + std::to_string(kMaxObjectMeshes) + " meshes");
  }
  if (objects.empty()) throw Refused(file + ": it has no object; write `object NAME of MESH`");
  return objects;
}

}  // namespace firmtouch::tools
