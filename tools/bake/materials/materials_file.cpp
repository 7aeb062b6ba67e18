#include "bake/materials/materials_file.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "bake/materials/height_map_file.hpp"
#include "bake/objects/clauses.hpp"
#include "firmtouch/scene/relief.hpp"
#include "surface/read/text_scan.hpp"

namespace firmtouch::tools {
namespace {

using scene::MaterialLayout;

constexpr double kMaxHeightPerLength = 0.238;
static_assert(kMaxHeightPerLength * 3.1416 < double{scene::kMaxTextureSlope});

// HEIGHT every LENGTH along X Y Z [and X Y Z]: grooves, or a grid of two waves of half the height.
scene::TextureLayout read_waves(LineReader& words) {
  const double height_m =
      words.quantity("waves", "m", 0, double{scene::kMaxTextureHeight_m} * (1 - 1e-6));
  words.expect("every");
  const double length_m = words.quantity("every", "m", 2.0 / double{scene::kMaxWaves_per_m}, 1);
  words.expect("along");
  std::vector<Point> along;
  do {
    along.push_back(words.vector(along.empty() ? "along" : "and", "", 1e6));
    if (!(length(along.back()) > 0))
      words.refuse("waves along 0 0 0 have no direction; write three numbers, not all 0");
  } while (along.size() < 2 && words.take("and"));
  scene::TextureLayout texture{};
  for (size_t i = 0; i < along.size(); ++i) {
    const Point per_m = along[i] * (1 / (length(along[i]) * length_m));
    texture.wave[i] = {
        {static_cast<float>(per_m.x), static_cast<float>(per_m.y), static_cast<float>(per_m.z)},
        static_cast<float>(height_m / static_cast<double>(along.size()))};
  }
  if (height_m > kMaxHeightPerLength * length_m)
    words.refuse("the waves are higher than 0.238 of their length; make them lower or longer");
  return texture;
}

// FILE HEIGHT every LENGTH along X Y Z and X Y Z: a tile, u to the right and v down the picture.
scene::ReliefLayout read_map(LineReader& words, const std::string& file,
                             std::vector<uint8_t>& samples) {
  const std::string name = words.next("a picture of the map");
  scene::ReliefLayout map{};
  map.height_m = static_cast<float>(
      words.quantity("map", "m", 0, double{scene::kMaxTextureHeight_m} * (1 - 1e-6)));
  words.expect("every");
  const double length_m = words.quantity("every", "m", 2.0 / double{scene::kMaxWaves_per_m}, 1);
  words.expect("along");
  const auto read_axis = [&](float(&per_m)[3]) {
    const Point along = words.vector("along", "", 1e6);
    if (!(length(along) > 0))
      words.refuse("a map along 0 0 0 has no direction; write three numbers, not all 0");
    const Point tiles = along * (1 / (length(along) * length_m));
    per_m[0] = static_cast<float>(tiles.x), per_m[1] = static_cast<float>(tiles.y);
    per_m[2] = static_cast<float>(tiles.z);
  };
  read_axis(map.u_per_m);
  words.expect("and");
  read_axis(map.v_per_m);
  const HeightMap read =
      read_height_map((std::filesystem::path(file).parent_path() / name).string());
  map.side = read.side;
  map.first = static_cast<uint32_t>(samples.size());
  samples.insert(samples.end(), read.samples.begin(), read.samples.end());
  const scene::ReliefBounds bounds = scene::bounds_of(map, samples.data());
  map.slope = bounds.slope, map.per_m = bounds.per_m;
  return map;
}

// What opening would reject.
void check_texture(LineReader& words, const scene::TextureLayout& texture,
                   const scene::ReliefLayout& map) {
  double height_m = static_cast<double>(map.height_m), slope = static_cast<double>(map.slope);
  for (const scene::WaveLayout& wave : texture.wave) {
    const Point per_m{double{wave.per_m[0]}, double{wave.per_m[1]}, double{wave.per_m[2]}};
    height_m += double{wave.height_m};
    slope += 3.1416 * double{wave.height_m} * length(per_m);
  }
  if (height_m > double{scene::kMaxTextureHeight_m} || slope > double{scene::kMaxTextureSlope})
    words.refuse("the texture is up to " + std::to_string(slope) + " steep and " +
                 std::to_string(height_m * 1e3) +
                 " mm high, more than 0.75 or 2 mm; make it lower, longer or smoother");
}

void read_clause(const std::string& word, LineReader& words, MaterialLayout& material,
                 scene::TextureLayout& texture) {
  if (word == "stiffness") {
    material.stiffness_N_per_m = static_cast<float>(
        words.quantity(word, "N/m", double{scene::kMinMaterialStiffness_N_per_m}, 1e9));
  } else if (word == "friction") {
    read_friction(words, scene::kMaxMaterialFriction, material.friction_static,
                  material.friction_dynamic);
  } else if (word == "viscous") {
    material.friction_viscous_N_s_per_m = static_cast<float>(
        words.quantity(word, "N*s/m", 0, double{scene::kMaxMaterialViscous_N_s_per_m}));
  } else if (word == "waves") {
    texture = read_waves(words);
  } else {
    words.refuse("unknown word `" + word +
                 "`; a material has: stiffness, friction, viscous, waves, map");
  }
}

void read_line(LineReader& words, Materials& materials) {
  MaterialLayout& material = materials.table.emplace_back();
  scene::TextureLayout& texture = materials.textures.emplace_back();
  scene::ReliefLayout& map = materials.reliefs.emplace_back();
  material.stiffness_N_per_m = FLT_MAX;
  words.expect("material");
  read_name(words, "the material's name", material.name);
  read_clauses(words, [&](const std::string& word) {
    if (word == "map") {
      map = read_map(words, materials.file, materials.samples);
    } else {
      read_clause(word, words, material, texture);
    }
  });
  check_texture(words, texture, map);
}

std::string names_of(const Materials& materials) {
  std::string list;
  for (size_t i = 0; i < materials.table.size() && i < 8; ++i)
    list += (i == 0 ? "" : ", ") + std::string(materials.table[i].name);
  return list + (materials.table.size() > 8 ? ", ..." : "");
}

[[noreturn]] void refuse_number(const std::string& where, const std::string& number,
                                const Materials& materials) {
  throw Refused(where + ": material " + number + " is not in " + materials.file + ", which has " +
                std::to_string(materials.table.size()) + " (" + names_of(materials) +
                "), counted from 1; 0 is none");
}

uint8_t number_of(const std::string& name, const std::string& model, const Materials& materials) {
  for (size_t i = 0; i < materials.table.size(); ++i)
    if (name == materials.table[i].name) return static_cast<uint8_t>(i + 1);
  throw Refused(model + ": material `" + name + "` is not in " + materials.file + ", which has " +
                names_of(materials) + "; add a line `material " + name + "` there");
}

}  // namespace

Materials read_materials(const std::string& file, const std::string& text) {
  Materials materials{file, {}};
  bool has_waves = false;
  std::set<std::string> names;
  read_lines(file, text, [&](LineReader& words, int) {
    read_line(words, materials);
    has_waves |= materials.textures.back().wave[0].height_m > 0.0f;
    if (!names.insert(materials.table.back().name).second)
      words.refuse("there are two materials `" + std::string(materials.table.back().name) +
                   "`; keep one");
    if (materials.table.size() > scene::kMaxMaterials)
      words.refuse("a mesh has at most " + std::to_string(scene::kMaxMaterials) + " materials");
  });
  if (!has_waves) materials.textures.clear();
  if (materials.samples.empty()) materials.reliefs.clear();
  if (materials.table.empty()) throw Refused(file + ": it has no material; write `material NAME`");
  return materials;
}

std::vector<uint8_t> triangle_materials(const std::string& model, const FileMaterials& named,
                                        const Materials& materials) {
  const auto names_none = [&] {
    return std::all_of(named.of.begin(), named.of.end(), [](uint32_t of) { return of == 0; });
  };
  if (names_none())
    throw Refused(model +
                  ": no triangle has a material: OBJ has `usemtl` or `g`, PLY a property "
                  "material_index of its faces; for other formats give --material-numbers FILE");
  std::vector<uint8_t> meant{0};  // by each number of the file
  for (const std::string& name : named.names) meant.push_back(number_of(name, model, materials));
  std::vector<uint8_t> of;
  for (size_t t = 0; t < named.of.size(); ++t) {
    const uint32_t number = named.of[t];
    if (named.names.empty() && number > materials.table.size())
      refuse_number(model + ": triangle " + std::to_string(t) + " (from 0)", std::to_string(number),
                    materials);
    of.push_back(named.names.empty() ? static_cast<uint8_t>(number) : meant[number]);
  }
  return of;
}

std::vector<uint8_t> read_triangle_materials(const std::string& file, std::string_view text,
                                             size_t triangles, const Materials& materials) {
  std::vector<uint8_t> of;
  TextScan scan(text);
  std::string_view word;
  while (scan.find_word(word)) {
    const std::string where = file + ":" + std::to_string(scan.line());
    int64_t number = 0;
    const char* wrong = read_integer(word, number);
    if (wrong != nullptr) throw Refused(where + ": `" + std::string(word) + "` " + wrong);
    if (number < 0 || number > static_cast<int64_t>(materials.table.size()))
      refuse_number(where, std::to_string(number), materials);
    of.push_back(static_cast<uint8_t>(number));
  }
  if (of.size() != triangles)
    throw Refused(file + ": has " + std::to_string(of.size()) + " numbers, the model " +
                  std::to_string(triangles) +
                  " triangles: write one for each, in the order of its file");
  return of;
}

}  // namespace firmtouch::tools
