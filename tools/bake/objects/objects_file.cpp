#include "bake/objects/objects_file.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <set>

#include "bake/objects/clauses.hpp"
#include "firmtouch/controller/mesh_objects.hpp"

namespace firmtouch::tools {
namespace {

using scene::ObjectLayout;

constexpr double kMaxTurn_rad = 1000;

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
    read_friction(words, scene::kMaxFriction, object.friction_static, object.friction_dynamic);
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
  const std::string name = read_name(words, "the object's name", object.name);
  words.expect("of");
  const std::string mesh = read_name(words, "the name of its mesh", object.mesh);
  if (std::find(meshes.begin(), meshes.end(), mesh) == meshes.end()) {
    std::string list;
    for (const std::string& known : meshes) list += (list.empty() ? "`" : ", `") + known + "`";
    words.refuse("object `" + name + "` is of mesh `" + mesh + "`, which is not baked with it; " +
                 (list.empty() ? "no mesh is" : "those are: " + list));
  }
  read_clauses(words, [&](const std::string& word) { read_clause(word, words, object); });
  return object;
}

}  // namespace

bool turns(const ObjectLayout& object) {
  float turn = 0;
  for (const float w : object.turn_rad_per_s) turn += std::fabs(w);
  for (size_t i = 0; i < 9; ++i) turn += std::fabs(object.rotation[i] - (i % 4 == 0 ? 1.0f : 0.0f));
  return turn > 0;
}

std::vector<ObjectLayout> read_objects(const std::string& file, const std::string& text,
                                       const std::vector<std::string>& meshes) {
  std::vector<ObjectLayout> objects;
  std::set<std::string> names, used;
  read_lines(file, text, [&](LineReader& words, int) {
    objects.push_back(read_line(words, meshes));
    if (!names.insert(objects.back().name).second)
      words.refuse("there are two objects `" + std::string(objects.back().name) +
                   "`; give each a name of its own");
    used.insert(objects.back().mesh);
    if (objects.size() > scene::kMaxObjects)
      words.refuse("a scene has at most " + std::to_string(scene::kMaxObjects) + " objects");
    if (used.size() > kMaxObjectMeshes)
      words.refuse("objects are of at most " + std::to_string(kMaxObjectMeshes) + " meshes");
  });
  if (objects.empty()) throw Refused(file + ": it has no object; write `object NAME of MESH`");
  return objects;
}

}  // namespace firmtouch::tools
